#pragma once

#include <vector>

#include "planner/files/from_cad/nouns.h"
#include "planner/ground/geometry/mesh.h"
#include "planner/ground/geometry/region.h"

namespace capstan::from_cad {

/// What of a closed mesh stands above a height, seen along the z axis of a frame: the union of its surfaces
/// that look up, cut at that height.
///
/// leave_out   per triangle: not looked at; empty: all are.
/// Frame       the region's is that of `frame`. Units  mm.
/// Accuracy    that of the mesh.
/// Cost        n log n in the triangles that look up.
[[nodiscard]] geometry::Region shadow_above(const geometry::Mesh& mesh, const std::vector<bool>& leave_out,
                                            const geometry::Placement& frame, double height_mm);

/// A box as a closed mesh.
[[nodiscard]] geometry::Mesh mesh_of(const geometry::Box3& box);

/// A circle that walls of the part lie on, seen along their axis.
struct RoundWall {
  Vec2 centre;
  double radius_mm = 0.0;
};

/// An upright plane face of the part, seen along its walls: from one of its ends to the other.
struct FlatWall {
  Vec2 from, to;
};

/// A closed polygon as lines and arcs: points that lie one behind the other on one of the round walls become
/// its arc, unless they lie on a flat wall, points on a line are dropped. Edges on the boundary of the raw
/// piece are open.
///
/// chord_mm   what the polygon may leave the arcs by.
[[nodiscard]] std::vector<Piece> pieces_of(const geometry::Loop& loop, const geometry::Region& raw,
                                           const std::vector<RoundWall>& walls, double chord_mm,
                                           const std::vector<FlatWall>& flats = {});

}  // namespace capstan::from_cad
