#pragma once

#include <optional>
#include <vector>

#include "planner/ground/base/result.h"
#include "planner/making/toolpath/region/adaptive/tracer.h"
#include "planner/making/toolpath/region/area/track.h"

namespace capstan::toolpath {

/// A cut at one height, and how the cutter comes to it.
struct ClearingPass {
  /// From the end of the pass before, through cleared ground; empty: the pass begins where the cutter is.
  std::vector<geometry::Vec2> way;
  bool over = false;  ///< no such way: over the retract plane
  Track track;
};

/// Where the cutter stands on cleared ground before the first pass.
struct ClearingStart {
  geometry::Vec2 at, heading;
};

/// What no pass reaches: the middle of the largest such place, and the area of centres there.
struct Unreached {
  geometry::Vec2 at;
  double area_mm2 = 0.0;
};

/// Passes that clear what the cutter reaches from one connected piece of centres, material on the right of
/// the travel, by at most the bite's arc of contact, and at last what the passes left along the boundary.
///
/// `cleared`  ground that is free at this height, the air outside the material included
/// `start`    nothing: the first pass is reached from above
/// Fails where the search found no end.
[[nodiscard]] tl::expected<std::vector<ClearingPass>, Unreached> clearing_passes(
    const geometry::Region& centres, const Bite& bite, const geometry::Region& cleared,
    const std::optional<ClearingStart>& start);

/// Between the cutter and what stands beside a way, mm.
inline constexpr double kBesideWay = 0.1;

}  // namespace capstan::toolpath
