#include "planner/files/exchange/conformance/faults.h"

#include <utility>

#include "planner/files/exchange/conformance/check.h"

namespace capstan::exchange::conformance {

bool Faults::wanted(const char* code) const {
  const auto found = counts_.find(code);
  return found == counts_.end() || found->second < kReportedFaultsPerCode;
}

void Faults::add(const p21::Instance& at, Fault f) {
  if (++counts_[f.code] > kReportedFaultsPerCode) return;
  job_.report({.code = f.code,
               .severity = std::string_view(f.code) == kOpenCode ? Severity::kWarning : Severity::kError,
               .message = std::move(f.message),
               .file = file_.name(),
               .line = at.line(),
               .instance = at.id(),
               .path = std::move(f.path),
               .expected = std::move(f.expected)});
}

void Faults::add(Fault f) {
  ++counts_[f.code];
  job_.report({.code = f.code,
               .message = std::move(f.message),
               .file = file_.name(),
               .expected = std::move(f.expected)});
}

std::size_t Faults::finish() {
  std::size_t all = 0;
  for (const auto& [code, n] : counts_) {
    const bool open = code == std::string_view(kOpenCode);
    if (!open) all += n;
    if (n <= kReportedFaultsPerCode) continue;
    job_.report(
        {.code = "SCH-MORE",
         .severity = open ? Severity::kWarning : Severity::kError,
         .message = "and " + std::to_string(n - kReportedFaultsPerCode) + " more faults of the kind " + code,
         .file = file_.name()});
  }
  return all;
}

}  // namespace capstan::exchange::conformance
