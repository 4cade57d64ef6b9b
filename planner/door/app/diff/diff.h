#pragma once

#include <string>

#include "planner/model/plan/plan.h"

namespace capstan::app {

struct Difference {
  bool same = true;
  std::string text;  ///< for people, by section; "the plans say the same" when they do
};

/// What changed from one plan to another, who decided it, and what it costs in time: inputs, set-ups (work
/// offset, security plane, workholding), tools, features, steps (removed, added, moved), and in each step
/// that both have the values, binders and reasons, loads, exceeded limits and the path. Steps are matched by
/// their persistent id, features by kind and name, set-ups by their place.
///
/// Values that an ISO 14649 file cannot hold (planned paths, data of the machine) are compared if both plans
///        have them. The time of steps is computed by motion if both have paths, else it is what the plans
///        state. Same plans, same bytes.
[[nodiscard]] Difference diff(const model::Plan& before, const model::Plan& after);

}  // namespace capstan::app
