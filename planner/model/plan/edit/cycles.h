#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "planner/model/plan/plan.h"

namespace capstan::model {

/// What an edit of `cycles` may say, as the control's option of that name does.
inline constexpr std::string_view kFeatureCycles = "feature", kExplicitMoves = "explicit";
/// As feature cycles, and pockets as the control's cycles too, whose path is not the planned one.
inline constexpr std::string_view kPocketCycles = "pocket";

/// By step of the plan: what the edits that it was made with say of its cycles, one of the words above;
/// empty: none says anything, and the machine's option holds.
[[nodiscard]] std::vector<std::string> cycles_by_step(const Plan& plan);

/// Whether a step's pocket is asked for as the control's cycle: by an edit, `of_step` of the above, or, where
/// that is empty, by the machine's option.
[[nodiscard]] bool asks_for_pocket_cycle(const Machine& machine, std::string_view of_step);

}  // namespace capstan::model
