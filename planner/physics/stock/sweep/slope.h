#pragma once

#include "planner/physics/stock/sweep.h"

namespace capstan::stock {

/// From the middle of a cell to its corner, in cells; rounded up.
inline constexpr double kHalfDiagonal = 0.70711;

/// A straight track that rises or falls, and the cells it may touch.
struct Slope {
  geometry::Vec2 a, b;  ///< ends of the track
  double reach;         ///< of the capsule around the chord that holds all touched cells
  double radius;        ///< of the cutter
  double base;          ///< lowest tip height above the map's floor
  bool half = false;    ///< only cells ahead of a, in direction `ahead`
  geometry::Vec2 ahead;
  geometry::Vec2 unit;                           ///< of the feed in the plane
  double length = 0.0, start = 0.0, rise = 0.0;  ///< start: height of the tip at a above the map's floor
};

/// Takes away what the cutter passes through on it, by the envelope of its outline.
void sweep_slope(HeightMap& map, const geometry::CutterProfile& profile, const Slope& slope, Tally& tally);

}  // namespace capstan::stock
