#pragma once

#include <cstddef>
#include <vector>

#include "planner/ground/geometry/region.h"

namespace capstan::toolpath {

/// One connected piece of the n-th inset of a region: its loops are one ring of a contour-parallel pattern.
struct Ring {
  geometry::Region piece;
  int depth = 0;                      ///< insets made so far; 0 is the wall
  std::size_t parent = 0;             ///< the ring around this one; its own index at depth 0
  std::vector<std::size_t> children;  ///< what became of it one inset later
};

/// All rings, each inset from the one before; a parent precedes its children. Two rings are `step_mm` apart
/// where a cutter that cuts `cover_mm` to each side of its centre leaves nothing between them or within the
/// last, and nearer where it would: at most by `cover_mm`, which always leaves nothing, for every centre that
/// is not in the next inset lies within that of this ring. In a corner of angle a, rings as far apart as
/// cover x (1 + sin(a / 2)) leave nothing: a point on its bisector, t from the outer corner, is t sin(a / 2)
/// from the outer ring and step / sin(a / 2) - t from the inner corner. It is tested by areas, so that ends
/// of limbs are told, too. Cost  linear in rings times vertices (each ring is made from the last,
/// simplified).
[[nodiscard]] std::vector<Ring> rings(const geometry::Region& centres, double step_mm, double cover_mm);

/// Order in which every ring comes after all rings inside it, sub-trees together.
[[nodiscard]] std::vector<std::size_t> inside_out(const std::vector<Ring>& all);

/// A point of the piece as far from its boundary as can be (to a percent), and that distance.
struct Deepest {
  geometry::Vec2 point;
  double distance_mm = 0.0;
};
[[nodiscard]] Deepest deepest(const geometry::Region& piece);

}  // namespace capstan::toolpath
