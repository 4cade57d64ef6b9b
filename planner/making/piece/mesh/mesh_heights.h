#pragma once

#include <vector>

#include "planner/ground/geometry/mesh.h"
#include "planner/ground/geometry/vec.h"

namespace capstan::piece {

/// The highest surface of a mesh over the middles of the cells of a grid, seen along z; nothing stands at
/// kNone. Units mm. Frame: the mesh's.
struct MeshHeights {
  static constexpr double kNone = -1e300;
  geometry::Vec2 lo;
  double cell = 1.0;
  int nx = 1, ny = 1;
  std::vector<double> z;  ///< rows of y
  [[nodiscard]] double at(int x, int y) const {
    if (x < 0 || y < 0 || x >= nx || y >= ny) return kNone;
    return z[static_cast<std::size_t>(y) * static_cast<std::size_t>(nx) + static_cast<std::size_t>(x)];
  }
};
/// Of the triangles that face up, where `sign` is 1, or down, where it is -1 (a mesh that is inside out).
[[nodiscard]] MeshHeights heights_of(const geometry::Mesh& mesh, double sign);

/// How deep a surface lies, at most, below the highest of it within a radius, mm: how far the face of a
/// holder of that radius has to be from the tip of a slender cutter that goes everywhere on it. Accuracy  a
/// cell; upright walls count with their height.
[[nodiscard]] double depth_beside(const geometry::Mesh& mesh, double radius_mm);

}  // namespace capstan::piece
