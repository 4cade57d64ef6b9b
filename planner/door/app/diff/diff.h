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
/// What an ISO 14649 file cannot hold (paths as planned, data of the machine) is compared where both plans
/// have it. Time of steps is motion's where both hold paths, else what the plans state. Same plans, same
/// bytes.
[[nodiscard]] Difference diff(const model::Plan& before, const model::Plan& after);

}  // namespace capstan::app
