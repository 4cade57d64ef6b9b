#pragma once

#include <vector>

#include "planner/door/pipeline/pipeline.h"

namespace capstan::pipeline {

/// What the checker says of a plan, and of the program that its machine's control gets of it.
[[nodiscard]] std::vector<model::Finding> findings_of(const model::Plan& plan, Job& job);
/// The same, where the plan is checked already.
[[nodiscard]] std::vector<model::Finding> findings_of(const Checked& checked, Job& job);

}  // namespace capstan::pipeline
