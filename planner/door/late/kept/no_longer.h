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
/// that a bind would open or look at anew, in the order machine, material, operations, tools. Nothing is
/// bound and nothing is checked. Not asked: values that were edited since, other choices than the plan was
/// made with (raw piece, tolerance, workholding), cases, conditions that were measured, lives. Of a plan that
/// is bound in part its bound steps count as cut, and are not asked either.
///
/// `tools`  what became of the loaded tools (parse_tool_states).
/// Fails    as material_of, match_loaded and take_tool_states: what they say no bind gets over.
[[nodiscard]] Result<std::vector<std::string>> no_longer_valid(const model::Plan& plan,
                                                               pipeline::Inputs inputs,
                                                               const std::vector<ToolState>& tools, Job& job);

}  // namespace capstan::late
