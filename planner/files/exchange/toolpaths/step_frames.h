#pragma once

#include "planner/ground/base/result.h"
#include "planner/ground/geometry/placement.h"
#include "planner/model/plan/plan.h"

namespace capstan::exchange {

/// The frame of a step's toolpath coordinates, seen from the program of its set-up
/// (model/features/setup_place.h):
///
///     workingstep      workpiece's place in the program x orientations x the feature's placement
///     rapid movement   the set-up's turn in the program x orientations
///
/// The set-up is that of the innermost workplan around the step that has one. Orientations are the
/// toolpath_orientation of each workplan around the step, outermost first, then the step's own, which
/// replaces the feature's placement.
/// Source  ISO 14649-10 (feature placement); confirmed with the published toolkit's motion for example 1.
///         ISO 10303-238 (toolpath_orientation of workingstep and, cumulatively, workplan).
[[nodiscard]] Result<geometry::Placement> frame_of_step(const model::Plan& plan,
                                                        model::Ref<model::Executable> step);

/// The default frame of a feature's toolpaths, workpiece coordinates: its own placement, where its compound
/// or pattern puts that; the workpiece's own if it has none.
/// Fails  as `placement` and `coordinates_of`.
[[nodiscard]] Result<geometry::Placement> toolpath_frame(const model::Model& m, model::AnyRef feature);

}  // namespace capstan::exchange
