#pragma once

#include <cstdint>
#include <vector>

#include "planner/making/toolpath/freeform/drop_cutter.h"

namespace capstan::toolpath::freeform {

/// How finely a way must be probed so that a cutter, clear at the probes when grown by `margin_mm`, is clear
/// everywhere between them: a ball of radius r moved by s lies in the two balls of radius r + margin at the
/// ends when (s / 2)^2 <= (r + margin)^2 - r^2. `ball_mm` holds the allowance already.
/// Source  derived; a bull nose is a disc plus a ball, so the same holds.
[[nodiscard]] double probe_spacing(double ball_mm, double margin_mm);

/// A cutter led over a surface.
struct Follower {
  const DropCutter* drop = nullptr;
  MillEnd cutter;
  double allowance_mm = 0.0;
  double tolerance_mm = 0.01;
  double bottom_z_mm = -1e300;
  bool beside_is_free = false;

  /// The tip's way over the straight line from a to b: pieces, broken where there is no surface under the
  /// cutter (unless that is free). Lies between surface + allowance and tolerance above, clear between its
  /// points too; steep steps go straight up or down.
  [[nodiscard]] std::vector<std::vector<geometry::Vec3>> over(geometry::Vec2 a, geometry::Vec2 b) const;
};

/// The points that are needed so that all others lie within `within_mm` of the line through them.
[[nodiscard]] std::vector<geometry::Vec3> thinned(const std::vector<geometry::Vec3>& line, double within_mm);

}  // namespace capstan::toolpath::freeform
