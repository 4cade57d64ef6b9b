#pragma once

#include "planner/ground/vocabulary/operation.h"
#include "planner/making/toolpath/path_job.h"

namespace capstan::toolpath {

// One function per kind of 2.5D work; `generate` chooses. All fail as `generate` does.

/// Faces: straight passes that overrun the boundary, or rings from the outside in.
[[nodiscard]] Result<GeneratedPath> face_path(const PathJob& task, Job& job);
/// Pockets, steps, wide slots, bored discs: all of an area between walls, rough or finish.
[[nodiscard]] Result<GeneratedPath> area_path(const PathJob& task, Job& job);
/// Around an outside contour.
[[nodiscard]] Result<GeneratedPath> outside_path(const PathJob& task, Job& job);
/// Along a slot's spine: cutters as wide as the slot, and form cutters.
[[nodiscard]] Result<GeneratedPath> slot_path(const PathJob& task, Job& job);
/// Chamfers and rounds along the upper edge of a closed pocket, a hole or an outside contour.
[[nodiscard]] Result<GeneratedPath> edge_path(const PathJob& task, Job& job);
/// The bevel of a cone along a feature's own upper edge, as deep as `axial_depth_mm`.
[[nodiscard]] Result<GeneratedPath> broken_edge_path(const PathJob& task, Job& job);
/// The cone at the top of a hole, by a cone of its angle along the wall of the hole below it.
[[nodiscard]] Result<GeneratedPath> cone_of_hole_path(const PathJob& task, Job& job);

/// Whether the operation is one that finishes.
/// The unit direction of straight passes in the set-up: given, else along the longer side of the area.
[[nodiscard]] geometry::Vec2 pass_direction(const PathJob& task, const geometry::Region& area);

}  // namespace capstan::toolpath
