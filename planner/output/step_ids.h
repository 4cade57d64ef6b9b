#pragma once

#include <string>
#include <vector>

#include "planner/model/plan.h"

namespace capstan::output {

/// `model::step_id` of every step, in order, in one pass.
[[nodiscard]] std::vector<std::string> step_ids(const model::Plan& plan);

}  // namespace capstan::output
