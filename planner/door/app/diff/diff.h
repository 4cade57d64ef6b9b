#pragma once

#include <string>

#include "planner/model/plan/plan.h"

namespace capstan::app {

struct Difference {
  bool same = true;
  std::string text;  ///< for people, by section; "the plans say the same" when they do
};

/// Differences between two plans: what changed, who decided it, and the change of time. Compares inputs,
/// tools, features, steps (removed, added, moved), and in each common step the values, binders, reasons and
/// the path. Steps are matched by their persistent id, features by kind and name.
///
/// Values that an ISO 14649 file cannot hold (planned paths, data of the machine) are compared if both plans
///        have them. The time of steps is computed by motion if both have paths, else it is what the plans
///        state. Same plans, same bytes.
[[nodiscard]] Difference diff(const model::Plan& before, const model::Plan& after);

}  // namespace capstan::app
