#pragma once

#include "planner/ground/geometry/mesh.h"
#include "planner/ground/geometry/region.h"

namespace capstan::piece {

/// Where the axis of a round nose stands while it touches the rim of a surface whose facets fall outwards
/// there: the box around the mesh, wider by what the nose then overhangs. Where an axis over the rim itself
/// would leave no more than `left_mm` there, it is not widened: of a surface that is level at its rim, or
/// rises to it, it is the mesh's box.
///
/// Units  mm; the cutter is a torus: its radius, and that of its corner (a ball: the same).
[[nodiscard]] geometry::Box2 box_of_axis(const geometry::Mesh& mesh, double radius_mm, double corner_mm,
                                         double left_mm);

}  // namespace capstan::piece
