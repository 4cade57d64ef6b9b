#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "planner/ground/geometry/region.h"

namespace capstan::toolpath {

/// One connected piece of the n-th inset of a region: its loops are one ring of a contour-parallel pattern.
struct Ring {
  geometry::Region piece;
  /// What the cutter follows: the piece, its inner corners rounded where that leaves nothing; at the wall as
  /// it is.
  geometry::Region followed;
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

/// Loops of a ring, by what they go round.
enum class Loops : std::uint8_t { kAll, kIslands, kOutside };
/// A ring in its turn.
struct Turn {
  std::size_t ring = 0;
  bool inwards = false;  ///< it comes after the ring around it, else after all inside it
  Loops loops = Loops::kAll;
};
/// Every ring after all rings inside it, sub-trees together; but of the limbs into which a ring falls apart
/// those that `from_outside` says come after it, from there inwards: where they begin within `near_mm` of its
/// loops round islands, before its loop round the outside, which then meets less of the solid. The largest
/// limb never comes after the ring around it.
[[nodiscard]] std::vector<Turn> turns(const std::vector<Ring>& all, double near_mm,
                                      const std::function<bool(const Ring& limb)>& from_outside);

/// A point of the piece as far from its boundary as can be (to a percent), and that distance.
struct Deepest {
  geometry::Vec2 point;
  double distance_mm = 0.0;
};
[[nodiscard]] Deepest deepest(const geometry::Region& piece);

}  // namespace capstan::toolpath
