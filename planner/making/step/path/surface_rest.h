#pragma once

#include <optional>

#include "planner/making/step/plan_so_far.h"
#include "planner/physics/stock/height_map.h"

// What roughing leaves on a surface where the next step would bite too deep: the rests that a smaller mill
// roughs.

namespace capstan::step {

/// Rests on a surface, seen along the tool axis.
struct SurfaceRest {
  /// Of the cells of the stock's map: up to this height above its floor material may stay.
  stock::HeightMap may_stay;
  double mm3 = 0.0;         ///< of material above that
  double deepest_mm = 0.0;  ///< of it, along the tool axis
};

/// What stands on the plan's mesh by more than the next step over it may bite: higher than the mesh grown by
/// twice the allowance of `step` and what that next step leaves. Rests too small to be worth a way may stay
/// where they are not deep, and so does what lies beside the mesh where its outline is not cut free.
///
/// `map` is the stock, set-up's frame. Needs a mesh. Nothing if no finish of the same feature follows.
/// Accuracy  half a cell: a cell has the height of its middle.
[[nodiscard]] std::optional<SurfaceRest> surface_rest(const PlanSoFar& p, const draft::StepDraft& step,
                                                      const stock::HeightMap& map);

/// What stands higher than may stay, mm3. Needs maps of the same cells.
[[nodiscard]] double mm3_above(const stock::HeightMap& map, const stock::HeightMap& may_stay);

/// Of a step that roughs the rests of a surface, proposed or recorded so, the mill of the last kept one
/// before it; null: it roughs all of its surface.
[[nodiscard]] const model::Cutter* roughed_before(const PlanSoFar& p, const draft::StepDraft& step);

}  // namespace capstan::step
