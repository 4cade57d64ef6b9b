#pragma once

#include <utility>
#include <vector>

#include "planner/model/plan/plan.h"

namespace capstan::draft {

/// Tools, results, machine and material of the plan as it was read.
struct Recorded {
  std::vector<model::Cutter> cutters;
  std::vector<model::StepResult> steps;
  model::Machine machine;        ///< for which the steps were planned,
  model::WorkMaterial material;  ///< and the material
  std::vector<std::pair<model::Ref<model::Setup>, model::Workholding>> holdings;
};

}  // namespace capstan::draft
