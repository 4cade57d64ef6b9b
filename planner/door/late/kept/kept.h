#pragma once

#include <optional>

#include "planner/door/pipeline/pipeline.h"
#include "planner/model/plan/plan.h"

namespace capstan::late {

/// A plan that was bound to its end, with its tools as they are measured now (`inputs.library`, after
/// given::match_loaded): pockets, lengths and stick-outs of the tool table. Nothing is planned: paths, feeds
/// and steps are those of the plan, and the check says whether they hold.
///
/// Nothing  where something is open, was edited or is not planned; where machine, material, raw piece or
///          choices are others than the plan was made with; or a tool has another shape, or would not reach.
/// `window`: of these steps only; it is the plan of them.
/// `material`: material_now of the plan that was brought.
/// Needs    that match_loaded re-opened nothing, and that `job` has what reading said of the plan.
[[nodiscard]] std::optional<model::Plan> as_it_is(const model::Plan& plan, const pipeline::Inputs& inputs,
                                                  const std::optional<model::WorkMaterial>& material,
                                                  std::optional<pipeline::Window> window, Job& job);

}  // namespace capstan::late
