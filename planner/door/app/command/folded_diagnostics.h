#pragma once

#include <vector>

#include "planner/ground/base/result.h"

namespace capstan::app {

/// Drops diagnostics that repeat the text of an earlier one about the same line or instance.
[[nodiscard]] std::vector<Diagnostic> without_repeats(const std::vector<Diagnostic>& all);

/// Diagnostics for a person. One text about several operations, steps or features is shown once, at its first
/// place, with their number and names; an identical diagnostic is shown once, with its count.
[[nodiscard]] std::vector<Diagnostic> folded_diagnostics(const std::vector<Diagnostic>& all);

}  // namespace capstan::app
