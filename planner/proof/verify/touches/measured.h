#pragma once

#include <map>
#include <vector>

#include "planner/model/plan/plan.h"

namespace capstan::verify {

/// The measurements of the piece that precede each step of the plan, in the order of the workplan, elements
/// within elements; of no step those that follow the last.
[[nodiscard]] std::map<model::AnyRef, std::vector<model::AnyRef>> touches_before(const model::Plan& plan);

}  // namespace capstan::verify
