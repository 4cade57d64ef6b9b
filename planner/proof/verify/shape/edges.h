#pragma once

#include <vector>

#include "planner/ground/geometry/mesh.h"

namespace capstan::verify {

/// Places just inside the sharp edges of a shape, mesh frame: `inside_mm` within both faces that meet there, in the
/// middle of pieces of the edges, at most `most` in all. What cuts there breaks an edge that is to stay sharp: between
/// the points of a lattice a chamfer of their distance is not seen.
///
/// Sharp: the faces turn by 30 degrees or more, with the material inside.
[[nodiscard]] std::vector<geometry::Vec3> inside_sharp_edges(const geometry::Mesh& mesh, double inside_mm,
                                                             std::size_t most);

}  // namespace capstan::verify
