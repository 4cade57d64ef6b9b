#pragma once

#include <cstddef>

#include "planner/ground/geometry/mesh.h"

namespace capstan::geometry {

/// A mesh whose triangles face the same way as their neighbours.
struct TurnedAlike {
  Mesh mesh;
  std::size_t turned = 0;  ///< triangles whose corners run the other way now
  Vec3 first;              ///< the middle of the first of them
};

/// Turns the triangles of each connected piece that face against those that cover more of it. Pieces are
/// connected where an edge, its corners welded, is of two triangles. A piece that has no two sides (a Moebius
/// strip) stays as it is. Cost  n log n.
[[nodiscard]] TurnedAlike turned_alike(Mesh mesh);

}  // namespace capstan::geometry
