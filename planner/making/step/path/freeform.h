#pragma once

#include <optional>

#include "planner/ground/base/job.h"
#include "planner/ground/base/result.h"
#include "planner/making/step/plan_so_far.h"
#include "planner/making/toolpath/path_job.h"
#include "planner/physics/stock/height_map.h"

// Freeform steps: a surface given as a mesh, roughed in levels and finished in passes.

namespace capstan::step {

/// What a freeform step leaves on its surface, square to it; 0 for other steps. `steps` are those of the
/// plan.
[[nodiscard]] double freeform_allowance(const model::Model& m, const std::vector<draft::StepDraft>& steps,
                                        const draft::StepDraft& step);
/// What the finish of the same feature after a step leaves; nothing: no finish follows.
[[nodiscard]] std::optional<double> left_by_next_mm(const PlanSoFar& p, const draft::StepDraft& step);
/// How high, square to the surface, material may stand after a step so that the next over it bites no deeper
/// than twice what this one is to leave; nothing: no finish follows.
[[nodiscard]] std::optional<double> most_for_next_mm(const PlanSoFar& p, const draft::StepDraft& step);
/// The plan's mesh in a set-up's frame. Needs a mesh.
[[nodiscard]] geometry::Mesh mesh_in_setup(const PlanSoFar& p, std::size_t setup);
/// Gives a freeform feature the extent of the plan's mesh; leaves others alone.
void shape_from_mesh(const PlanSoFar& p, const draft::StepDraft& step, toolpath::PathJob& job);
/// What stands on the plan's mesh where the next step over it would bite too deep: more than twice what
/// `step` leaves, square to the surface, beside what that next step leaves itself. Places steeper than 60
/// degrees are left out. Of what stands at a cell, as much is not counted as the surface rises over half of
/// it: a coarse map tells of no bite that may be its own cells.
struct TooMuch {
  double mm3 = 0.0;         ///< of it, above that height
  double share = 0.0;       ///< of the surface, seen from above
  double deepest_mm = 0.0;  ///< the deepest bite
  double most_mm = 0.0;     ///< what a bite may be
};
/// `map` is what stands after the step, set-up's frame. Needs a mesh. Nothing if no finish of the same
/// feature follows.
[[nodiscard]] std::optional<TooMuch> too_much_for_next(const PlanSoFar& p, const draft::StepDraft& step,
                                                       const stock::HeightMap& map);
/// The path of a freeform operation over the plan's mesh; `map` is what stands.
/// Fails  PIP-SURFACE without a mesh; as the paths over a surface do.
[[nodiscard]] Result<toolpath::GeneratedPath> freeform_path(const PlanSoFar& p, const draft::StepDraft& step,
                                                            const toolpath::PathJob& path,
                                                            const optimise::CutAnswer& cut,
                                                            const stock::HeightMap& map, Job& job);

}  // namespace capstan::step
