#pragma once

#include <string>

#include "planner/model/plan/plan.h"

namespace capstan::model {

/// A plan's file says twice in which order its steps come, and in which set-up: in the workplan, and by its
/// list of steps. Puts the steps, and the set-ups that they are in, as the workplan has them: it counts. What
/// the workplan does not list keeps its place. Gives what disagreed, with the first steps of it; empty:
/// nothing.
[[nodiscard]] std::string follow_workplan(Plan& plan);

}  // namespace capstan::model
