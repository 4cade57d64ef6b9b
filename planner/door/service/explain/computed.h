#pragma once

#include <string>
#include <vector>

#include "planner/door/service/explain/step_view.h"

namespace capstan::service {

/// Decimals of what planning computed, as it is told.
inline constexpr int kDecimals = 4;

/// A value that planning computed beside the nouns: its name, the value with its unit, how it came about.
struct Computed {
  std::string name, value, how;
};

/// What was computed of a planned step, in the order in which it is told; empty where it is not planned.
[[nodiscard]] std::vector<Computed> computed_of(const model::Plan& plan, const StepView& v);

}  // namespace capstan::service
