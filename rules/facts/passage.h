#pragma once

#include "planner/geometry/region.h"

namespace capstan::rules {

/// Which cutters an area admits, by diameter, mm.
struct Passage {
  double widest_mm = 0.0;     ///< largest circle that fits anywhere
  double narrowest_mm = 0.0;  ///< largest cutter that reaches all of it, corners excepted
  double exact_mm = 0.0;      ///< largest cutter that reaches the corners, too; 0 when they are sharp
};

/// Estimated by offsets: a cutter of diameter D reaches offset(offset(area, -D/2), D/2). What that leaves
/// in pieces no larger than a corner of 60 degrees leaves, r^2 (cot 30 - (pi - pi/3)/2) = 0.685 r^2, counts
/// as a corner; anything larger is a passage too narrow for the cutter. A corner of radius R counts as
/// reached when a cutter leaves at most 0.01 r^2 of it (r below 1.03 R for a right angle); sharp ones never
/// are.
///
/// Accuracy   both to 1 % of the widest, on the small side.
/// Cost       a dozen offsets each, fewer where the first guess holds.
/// Source     derived.
[[nodiscard]] Passage passage_of(const geometry::Region& area);

}  // namespace capstan::rules
