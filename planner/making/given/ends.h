#pragma once

#include <vector>

#include "planner/making/draft/draft.h"
#include "planner/model/plan/plan.h"

// How steps follow each other: which tool carries out a rapid movement, and how paths that a file gives,
// which may begin and end anywhere, are reached from the security plane and left to it.

namespace capstan::given {

/// A rapid movement without a tool is carried out by the one in the spindle; before the first tool, by the
/// one that comes next.
[[nodiscard]] std::vector<draft::StepDraft> carry_tools(const model::Model& m,
                                                        std::vector<draft::StepDraft> steps);

/// The results of the plan's steps. Given paths are reached from the security plane, and left to it, where
/// they do not go on from each other.
[[nodiscard]] std::vector<model::StepResult> joined_paths(const model::Plan& plan,
                                                          const std::vector<draft::SetupDraft>& setups);

}  // namespace capstan::given
