#pragma once

#include <optional>
#include <string_view>

#include "planner/model/plan/plan.h"

// What the report and `explain` both show of a plan's tools and steps.

namespace capstan::report {

/// What a plan asks of one of its tools.
struct ToolUse {
  std::optional<double> least_z_mm =
      {};                        ///< of its tip, in the frames of the set-ups; nothing: it has no path
  double used_min = 0.0;         ///< cutting in this plan
  double used_before_min = 0.0;  ///< as its library or the control says
  double life_min = 0.0;         ///< the shortest of the steps' and its own; 0: not known
};
[[nodiscard]] ToolUse use_of(const model::Plan& plan, const model::Cutter& cutter);

/// "through", "flood", "mist" or "dry".
[[nodiscard]] std::string_view coolant_text(const model::StepResult& step);

}  // namespace capstan::report
