#include "planner/door/service/ending/repeats.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <string_view>
#include <system_error>

namespace capstan::service {
namespace {

/// Whether two sentences say the same with the same numbers, but for the digits that a program rounds: of
/// decimals, for names and counts are whole.
bool same_but_for_rounding(std::string_view a, std::string_view b) {
  constexpr double kRounded = 1e-3;  // of a number, and
  constexpr double kMost = 0.1;      // of any: a program has its speeds to 0.1 1/min; default, unsourced
  const auto number = [](std::string_view& text, double& value) {
    const auto read =
        std::from_chars(text.data(), text.data() + text.size(), value, std::chars_format::fixed);
    if (read.ec != std::errc()) return false;
    text.remove_prefix(static_cast<std::size_t>(read.ptr - text.data()));
    return true;
  };
  while (!a.empty() && !b.empty()) {
    double x = 0.0, y = 0.0;
    std::string_view rest_a = a, rest_b = b;
    if (number(rest_a, x) && number(rest_b, y)) {
      const auto decimal = [](std::string_view all, std::string_view rest) {
        return all.substr(0, all.size() - rest.size()).find('.') != std::string_view::npos;
      };
      const double apart = decimal(a, rest_a) || decimal(b, rest_b)
                               ? std::min(kMost, kRounded * std::max(std::abs(x), std::abs(y)))
                               : 0.0;
      if (!(std::abs(x - y) <= apart)) return false;
      a = rest_a;
      b = rest_b;
      continue;
    }
    if (a.front() != b.front()) return false;
    a.remove_prefix(1);
    b.remove_prefix(1);
  }
  return a.empty() && b.empty();
}

}  // namespace

bool Repeats::is_new(const FileFinding& f) {
  if (!f.program) {
    if (of_plan_.empty()) plan_file_ = f.file;
    if (f.file == plan_file_) of_plan_.push_back(f.finding);
    return true;
  }
  if (verb_ == Verb::kCheck && f.finding.move > 0) return true;
  return std::none_of(of_plan_.begin(), of_plan_.end(), [&](const model::Finding& known) {
    return known.code == f.finding.code && known.severity == f.finding.severity &&
           known.step == f.finding.step && same_but_for_rounding(known.message, f.finding.message);
  });
}

}  // namespace capstan::service
