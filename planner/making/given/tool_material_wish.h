#pragma once

#include <optional>
#include <string>
#include <vector>

#include "planner/model/plan/assumed_tool_material.h"

namespace capstan::given {

/// What the caller, or the plan that is planned again, takes unstated tool materials to be.
struct ToolMaterialWish {
  std::optional<model::Substrate> assumed;               ///< of all of them
  std::string assumed_by;                                ///< "--assume tool-material=carbide"
  std::vector<model::AssumedToolMaterial> of_plan = {};  ///< what it took before, by tool
};

}  // namespace capstan::given
