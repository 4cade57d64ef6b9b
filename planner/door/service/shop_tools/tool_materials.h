#pragma once

#include <vector>

#include "planner/model/plan/plan.h"

namespace capstan::service {

/// Tools of the plan that the machine's library or tool table states to be of another material, found by
/// their number, without one by their id: CHK-TOOL-MATERIAL. An error where the plan cuts with carbide and
/// the tool is of HSS, for such an edge burns at carbide's speed; a warning the other way round. What is not
/// stated contradicts nothing; nor does carbide where the plan only assumed HSS, the slower one.
[[nodiscard]] std::vector<model::Finding> other_tool_materials(const model::Plan& plan,
                                                               const std::vector<model::Cutter>& loaded);

}  // namespace capstan::service
