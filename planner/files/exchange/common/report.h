#pragma once

#include <cstddef>
#include <map>
#include <string>

#include "planner/ground/base/job.h"
#include "planner/model/nouns/arena/model.h"

namespace capstan::exchange {

/// Passes diagnostics about one file on, with their place, and at most `kPerCode` of each code: a file with
/// a million faults of one kind is reported once, with a count.
class Reporter {
 public:
  static constexpr std::size_t kPerCode = 100;  // default, unsourced: what a person can still read

  Reporter(Job& job, std::string file) : job_(job), file_(std::move(file)) {}

  void report(Diagnostic d) {
    if (d.severity == Severity::kError) {
      ++errors_;
      if (first_error_.empty()) first_error_ = d.message;
    }
    tell(std::move(d));
  }
  /// As `report`; an error does not count: the file is read all the same.
  void tell(Diagnostic d) {
    d.file = file_;
    auto& n = count_[d.code];
    if (++n > kPerCode) return;
    job_.report(std::move(d));
  }
  /// About an object: its instance and line are filled in.
  void about(const model::Model& m, model::AnyRef at, Diagnostic d) {
    d.instance = m.origin(at).instance;
    d.line = m.origin(at).line;
    report(std::move(d));
  }
  [[nodiscard]] std::size_t errors() const { return errors_; }
  /// The failure of a reader that has reported errors: how many, and the first. Needs  errors() > 0.
  [[nodiscard]] Diagnostic failure(std::string code) const {
    return {.code = std::move(code),
            .message = std::to_string(errors_) + (errors_ == 1 ? " fault" : " faults") +
                       " in the plan; the first: " + first_error_,
            .file = file_};
  }
  /// Says how many were left out.
  void finish() {
    for (const auto& [code, n] : count_) {
      if (n <= kPerCode) continue;
      job_.report({.code = code,
                   .severity = Severity::kNote,
                   .message = "and " + std::to_string(n - kPerCode) + " more of these",
                   .file = file_});
    }
    count_.clear();
  }

 private:
  Job& job_;
  std::string file_;
  std::map<std::string, std::size_t> count_;
  std::size_t errors_ = 0;
  std::string first_error_;
};

/// "#77 CLOSED_POCKET.its_boss" without the number, which diagnostics carry apart.
[[nodiscard]] inline std::string attribute_name(model::AnyRef at, std::string_view attribute) {
  return std::string(model::noun_type(at.type).keyword) + "." + std::string(attribute);
}

}  // namespace capstan::exchange
