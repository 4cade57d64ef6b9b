#pragma once

#include <vector>

#include "planner/ground/geometry/mesh.h"

namespace capstan::geometry {

/// A concave edge of a surface that is seen from above, mm.
struct MeshCrease {
  Vec3 a, b;               ///< its ends
  double turn_rad = 0.0;   ///< of the normal, from one facet to the other
  double across_mm = 0.0;  ///< of the narrower facet, square to the edge
  bool alone = false;      ///< none beside it turns about as much: it is part of no curve

  /// Radius of the curve that it is part of; infinite where it draws none: it is alone, or turns sharply
  /// (kSharpTurnRad), and how round it is to be the mesh does not say.
  [[nodiscard]] double curve_mm() const;
};

/// The creases of a mesh, by the order of its vertices: between two facets that face up, or one that does and
/// an upright one of a solid; an end mill makes the foot of a wall on a level floor square, which is none.
/// Facets of a solid that face down do not count; a sheet is turned up. Edges that the rounding of
/// coordinates to 24 bits may have bent, and turns of less than half a degree, are none.
/// Cost  n log n.
[[nodiscard]] std::vector<MeshCrease> creases(const Mesh& mesh);

}  // namespace capstan::geometry
