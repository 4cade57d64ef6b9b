#pragma once

#include <vector>

#include "planner/ground/base/result.h"

namespace capstan::app {

/// Without what is said again in the same words of the same line or instance.
[[nodiscard]] std::vector<Diagnostic> without_repeats(const std::vector<Diagnostic>& all);

/// Diagnostics for a person: what is said of several operations, steps or features in the same words is said
/// once, where it was said first, with how many there are and their names; what is said again word for word,
/// with how often.
[[nodiscard]] std::vector<Diagnostic> folded_diagnostics(const std::vector<Diagnostic>& all);

}  // namespace capstan::app
