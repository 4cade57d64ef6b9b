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

/// All rings, each inset from the one before; a parent precedes its children. With a step of at most the
/// cutter's radius, nothing between two rings or within the last stays uncut: every centre that is not in the
/// next inset lies within one step of this ring.
/// Cost  linear in rings times vertices (each ring is made from the last, simplified).
[[nodiscard]] std::vector<Ring> rings(const geometry::Region& centres, double step_mm);

/// Order in which every ring comes after all rings inside it, sub-trees together.
[[nodiscard]] std::vector<std::size_t> inside_out(const std::vector<Ring>& all);

/// A point of the piece as far from its boundary as can be (to a percent), and that distance.
struct Deepest {
  geometry::Vec2 point;
  double distance_mm = 0.0;
};
[[nodiscard]] Deepest deepest(const geometry::Region& piece);

}  // namespace capstan::toolpath
