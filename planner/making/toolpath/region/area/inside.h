#pragma once

#include <vector>

#include "planner/ground/geometry/region.h"

namespace capstan::toolpath {

/// A region prepared for many questions: its edges in strips of equal height.
/// Cost of a question: the edges in the strips that it touches.
class Inside {
 public:
  explicit Inside(const geometry::Region& region);
  [[nodiscard]] bool contains(geometry::Vec2 p) const;
  /// Whether the straight line from a to b stays within the region.
  [[nodiscard]] bool contains(geometry::Vec2 a, geometry::Vec2 b) const;
  /// Whether any boundary lies within `radius` of p.
  [[nodiscard]] bool boundary_within(geometry::Vec2 p, double radius_mm) const;
  /// Whether the disc lies wholly outside the region.
  [[nodiscard]] bool clear_of(geometry::Vec2 centre, double radius_mm) const {
    return !contains(centre) && !boundary_within(centre, radius_mm);
  }
  /// Whether the disc does so all the way as its centre goes straight from a to b.
  [[nodiscard]] bool clear_along(geometry::Vec2 a, geometry::Vec2 b, double radius_mm) const;

 private:
  struct Edge {
    geometry::Vec2 a, b;
  };
  [[nodiscard]] int strip(double y) const;
  double y0_ = 0.0, height_ = 1.0;
  std::vector<std::vector<Edge>> strips_;
};

}  // namespace capstan::toolpath
