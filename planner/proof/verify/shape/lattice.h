#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "planner/ground/geometry/mesh.h"

namespace capstan::verify {

/// The corners of a triangle.
[[nodiscard]] inline std::array<geometry::Vec3, 3> corners(const geometry::Mesh& mesh, std::size_t i) {
  const auto& [a, b, c] = mesh.triangles[i];
  return {mesh.vertices[a], mesh.vertices[b], mesh.vertices[c]};
}

/// Points over the raw piece, workpiece frame, mm, about 250,000.
struct Lattice {
  geometry::Vec3 lo;
  double step_mm = 0.0;
  std::array<int, 3> n{};
  std::vector<char> asked, gone;  ///< per point: in the shape; removed
  [[nodiscard]] std::size_t index(int i, int j, int k) const {
    return column(i, j) * static_cast<std::size_t>(n[2]) + static_cast<std::size_t>(k);
  }
  [[nodiscard]] std::size_t column(int i, int j) const {
    return static_cast<std::size_t>(i) * static_cast<std::size_t>(n[1]) + static_cast<std::size_t>(j);
  }
  [[nodiscard]] geometry::Vec3 at(int i, int j, int k) const {
    return lo + step_mm * geometry::Vec3{i + 0.5, j + 0.5, k + 0.5};
  }
  [[nodiscard]] geometry::Box3 box() const {
    return {lo, lo + step_mm * geometry::Vec3{static_cast<double>(n[0]), static_cast<double>(n[1]),
                                              static_cast<double>(n[2])}};
  }
};

[[nodiscard]] Lattice lattice_over(const geometry::Box3& raw);
/// Marks the points in the shape: those above which more of its surfaces look up than down.
void mark_asked(const geometry::Mesh& mesh, Lattice& lattice);

/// Triangles by the columns of the lattice that they are near to.
class Surface {
 public:
  Surface(const geometry::Mesh& mesh, const Lattice& lattice, double near_mm);
  /// Whether a point of the lattice is nearer to the surface than the distance it was made for.
  [[nodiscard]] bool near(int x, int y, int z) const;

 private:
  const geometry::Mesh& mesh_;
  const Lattice& lattice_;
  double near_mm_;
  std::vector<std::vector<std::uint32_t>> columns_;
};

/// The point of the lattice that lies farthest from the surface. Distances change by no more than the way
/// between two points: along a column most points need not be measured.
class Deepest {
 public:
  Deepest(const geometry::Mesh& mesh, double most) : mesh_(mesh), most_(most) {}
  void look_at(geometry::Vec3 p);
  [[nodiscard]] double deepest_mm() const { return deepest_mm_; }
  [[nodiscard]] geometry::Vec3 at() const { return at_; }

 private:
  const geometry::Mesh& mesh_;
  double most_;
  double deepest_mm_ = 0.0;
  geometry::Vec3 at_;
  bool known_ = false;
  geometry::Vec3 there_;  ///< the last point that was measured
  double distance_there_ = 0.0;
};

}  // namespace capstan::verify
