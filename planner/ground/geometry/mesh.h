#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "planner/ground/geometry/vec.h"

namespace capstan::geometry {

/// A triangle mesh, mm; counter-clockwise seen from outside. May be dirty: holes, folds, duplicates.
struct Mesh {
  std::vector<Vec3> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

[[nodiscard]] Box3 bounds(const Mesh& mesh);

}  // namespace capstan::geometry
