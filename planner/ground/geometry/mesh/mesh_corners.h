#pragma once

#include <vector>

#include "planner/ground/geometry/mesh.h"
#include "planner/ground/geometry/region.h"

namespace capstan::geometry {

/// Corners of walls are sharp from this turn on; arcs are drawn by smaller ones. Default, unsourced.
inline constexpr double kSharpTurnRad = 0.349065850398866;  // 20 degrees
/// Facets whose normals turn by less lie in one plane: the rounding of coordinates. Default, unsourced.
inline constexpr double kFlatTurnRad = 0.00872664625997165;  // half a degree

/// An upright inside edge of a solid at which two walls meet at a sharp corner: no mill makes it.
struct MeshCorner {
  Vec2 at;
  Vec2 into;              ///< unit vector out of the solid, halfway between the walls
  double half_rad = 0.0;  ///< half the angle between the walls, as seen from outside the solid
  double low = 0.0, high = 0.0;

  /// Whether a mill of this radius, along both walls, leaves the place; `more` mm added all round.
  [[nodiscard]] bool keeps(Vec2 p, double radius_mm, double more) const;
};

/// The corners, those above one another made one; seen along z. `inside_out`: as form_of() says.
[[nodiscard]] std::vector<MeshCorner> sharp_corners(const Mesh& mesh, bool inside_out);

/// What of a solid is higher than z, seen from above; overhangs hide what lies under them.
[[nodiscard]] Region higher_than(const Mesh& mesh, bool inside_out, double z);

}  // namespace capstan::geometry
