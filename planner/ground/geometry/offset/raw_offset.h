#pragma once

#include <cstddef>

#include "planner/ground/geometry/region.h"

/// @file How a region of many vertices is offset (region.h): in up to nine steps, each rounded to the grid,
/// that end before a curve becomes a corner. Beyond the arcs' tolerance it may lie away by half of that:
/// corners of small angles stay sharp, and vertices that say less are dropped where they would make a step
/// long.

namespace capstan::geometry {

/// A loop moved aside, corner by corner, before what lies too near to the old boundary is taken away: that is
/// where it turns round a point less than once (the positive rule). Points of it that count are |delta| from
/// the old boundary; chords of round corners come nearer by `tolerance_mm` at most, corners of so small an
/// angle that they are kept sharp lie beyond by a quarter of it at most.
struct RawOffset {
  Loop loop;
  std::size_t spikes =
      0;  ///< closing corners that are led through their old vertex: their edges are short, or all close
};

/// `delta_mm`  to the right of the loop's sense, that is, outwards of a region; negative: inwards
/// Cost        linear
[[nodiscard]] RawOffset raw_offset(const Loop& loop, double delta_mm, double tolerance_mm);

/// The farthest that all loops can be moved to this side (> 0: outwards) with so many spikes at most; 1e300
/// where there are no more closing corners than that.
[[nodiscard]] double reach_with_spikes(const Region& a, bool outwards, std::size_t spikes);

/// Without corners that close to this side and whose vertex lies `most_mm` at most from what stands instead.
/// An inset of what is left is smaller, a growth larger, by as much at most. Cost  linear.
[[nodiscard]] Loop without_small_corners(const Loop& loop, bool outwards, double most_mm);

}  // namespace capstan::geometry
