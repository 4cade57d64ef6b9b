#pragma once

#include <string>
#include <vector>

#include "planner/door/late/tools/tool_state.h"
#include "planner/door/pipeline/pipeline.h"
#include "planner/ground/base/job.h"
#include "planner/ground/base/result.h"
#include "planner/model/plan/plan.h"

namespace capstan::late {

/// What of a plan no longer holds with machine, material and tools as they are now: a sentence for each thing
/// that a bind would open or look at anew, in the order machine, material, operations, tools. Nothing is bound
/// and nothing is checked; empty: a bind of the plan changes nothing that was bound, unless its check condemns it.
///
/// `tools`  what became of the loaded tools (parse_tool_states).
/// Fails    as match_loaded and take_tool_states: what they say no bind gets over.
[[nodiscard]] Result<std::vector<std::string>> no_longer_valid(const model::Plan& plan,
                                                               pipeline::Inputs inputs,
                                                               const std::vector<ToolState>& tools, Job& job);

}  // namespace capstan::late
