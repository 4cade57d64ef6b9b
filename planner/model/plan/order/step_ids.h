#pragma once

#include <string>
#include <vector>

#include "planner/model/plan/plan.h"

namespace capstan::model {

/// `step_id` of every step, in order, in one pass.
[[nodiscard]] std::vector<std::string> step_ids(const Plan& plan);

}  // namespace capstan::model
