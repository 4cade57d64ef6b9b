#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "casebase/record/case.h"

/// The cases that a correction leans on, as people read them.
namespace capstan::casebase::tune {

/// Cases that are named in one line. As kLeanedShown of recall/advice.h.
inline constexpr std::size_t kCasesNamed = 8;

/// Digits of an id that are enough to find a case.
[[nodiscard]] std::string short_id(std::string_view id);

/// "1f0c53c2b77a, 2b77a901f3c5 and 16 more".
[[nodiscard]] std::string named(const std::vector<std::string>& cases);

/// A case and what came of it: "1f0c53c2b77a (good, 12.6 s for 10 s)"; `doubted`: it lies so far from the
/// others that it hardly counts. `observed`: empty where it is not to be told.
[[nodiscard]] std::string with_outcome(const Case& c, const std::string& observed, bool doubted);

}  // namespace capstan::casebase::tune
