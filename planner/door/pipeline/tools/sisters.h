#pragma once

#include <vector>

#include "planner/ground/base/job.h"
#include "planner/model/plan/edit/edit.h"
#include "planner/model/plan/plan.h"

namespace capstan::pipeline {

/// Whether `other` may take the place of `tool` between two steps: both loaded under their own numbers, of
/// one class and of the same sizes by what the library or the machine's table says (diameters as near as
/// those are measured), `other` with a measured length and life left. Their lengths may differ: each has its
/// own offset.
[[nodiscard]] bool is_sister(const model::Cutter& other, const model::Cutter& tool);

/// From the step in which a loaded tool would come to the end of its life, those of its steps that planning
/// chose it for get a sister of it that `library` has loaded and the plan does not use: of several that with
/// the lowest number whose life lasts for the step, and behind it the next. Its life is what is stated of it
/// and not used, else what the steps record of their edges (StepLoads::tool_life_min). The sister becomes a
/// cutter of the plan whose `sisters` names the tool. A step that `restrictions` keep off a sister does not
/// get it.
///
/// A tool is not changed within a step: a fresh one whose first step is longer than its life keeps it. Where
/// no sister's life lasts, one that is less worn takes the place of a tool that has cut a step before. Where
/// none is loaded nothing changes, and the check says so (CHK-TOOL-LIFE, CHK-EDGES).
///
/// Notes  PIP-SISTER for each change: the step, both tools, and the minutes.
void share_among_sisters(model::Plan& plan, const std::vector<model::Cutter>& library,
                         const std::vector<model::Edit>& restrictions, Job& job);

}  // namespace capstan::pipeline
