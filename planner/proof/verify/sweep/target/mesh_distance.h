#pragma once

#include <cstdint>
#include <vector>

#include "planner/ground/geometry/mesh.h"
#include "planner/ground/geometry/vec.h"

namespace capstan::verify {

/// How far places lie from a mesh: exact, by the nearest of its triangles.
///
/// Units mm. Frame: the mesh's.
class MeshDistance {
 public:
  /// `mesh` is kept by the caller.
  explicit MeshDistance(const geometry::Mesh& mesh);

  struct Nearest {
    double mm = 0.0;
    geometry::Vec3 at;  ///< on the mesh
  };
  /// The nearest place of the mesh; `within_mm` and p itself where none is nearer than that.
  [[nodiscard]] Nearest from(geometry::Vec3 p, double within_mm) const;

 private:
  [[nodiscard]] int bin(double at, double begin, int most) const;

  const geometry::Mesh& mesh_;
  geometry::Vec2 lo_;
  double bin_mm_ = 1.0;
  int nx_ = 1, ny_ = 1;
  std::vector<std::uint32_t> begin_, triangles_;  ///< by bins, seen from above, in rows of x
};

/// The nearest place to p on a triangle: its foot on the plane where that lies within, else on the nearest of
/// the three edges.
[[nodiscard]] geometry::Vec3 nearest_on_triangle(geometry::Vec3 p, geometry::Vec3 a, geometry::Vec3 b,
                                                 geometry::Vec3 c);

}  // namespace capstan::verify
