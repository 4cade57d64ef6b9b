#pragma once

#include <vector>

#include "planner/door/pipeline/pipeline.h"

namespace capstan::pipeline {

/// Findings of the check on a plan and on the program that its machine's control gets.
[[nodiscard]] std::vector<model::Finding> findings_of(const model::Plan& plan, Job& job);
/// The same for a plan that is checked already.
[[nodiscard]] std::vector<model::Finding> findings_of(const Checked& checked, Job& job);

}  // namespace capstan::pipeline
