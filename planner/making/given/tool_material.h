#pragma once

#include <vector>

#include "planner/ground/base/job.h"
#include "planner/making/draft/draft.h"
#include "planner/making/given/tool_material_wish.h"
#include "planner/model/plan/plan.h"
#include "tooling/library/nouns/tool_material.h"

// What tools are made of whose file or list does not say it.

namespace capstan::given {

/// What tells of the tool of `step`, which was read as `cutter`. A loaded tool that states its material
/// settles it; then the wish; then the speeds that the file gives to any of the tool's operations.
[[nodiscard]] tooling::ToolMaterialHints hints_of(const model::Plan& plan, const draft::StepDraft& step,
                                                  const model::Cutter& cutter,
                                                  const std::vector<model::Cutter>& library,
                                                  const ToolMaterialWish& wish);

/// Takes the cutters of a library whose material nobody states as the caller wishes.
void assume_materials(std::vector<model::Cutter>& library, const ToolMaterialWish& wish);

/// What is assumed of the materials of the plan's cutters, as rows of provenance. Reports it once
/// (PIP-TOOL-MATERIAL).
[[nodiscard]] std::vector<model::Provenance> assumed_materials_of(const model::Plan& plan, Job& job);

}  // namespace capstan::given
