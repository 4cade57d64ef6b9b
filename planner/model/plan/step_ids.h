#pragma once

#include <string>
#include <vector>

#include "planner/model/plan/plan.h"

namespace capstan::model {

/// `step_id` of each of the plan's steps, in their order.
///
/// Cost  n log n, where that of one step looks at all before it.
[[nodiscard]] std::vector<std::string> step_ids(const Plan& plan);

}  // namespace capstan::model
