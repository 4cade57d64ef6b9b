#pragma once

#include "planner/model/plan/cutter/cutter.h"
#include "planner/model/plan/resources/material.h"

namespace capstan::model {

/// Steepest ramp where neither cutter nor material says more, rad.
/// Source  Harvey Performance, In the Loupe, "Ramping to success": 1 to 3 degrees to begin with in hard and
///         ferrous materials; the upper end.
inline constexpr double kUsualRampRad = 3.0 * 3.14159265358979323846 / 180.0;

/// How far from its axis, of the radius, a cutter cuts badly or not at all. Default, unsourced.
inline constexpr double kMiddleOfRadius = 0.3;

/// Deepest slot that a cutter mills in one level in any material, in diameters.
/// Source  slots no deeper than 1.5 D (there at half speed and feed; 0.5 D at full): Dormer Pramet, milling
///         catalogue 2021-22, p. 114, solid carbide mills, correction factors.
inline constexpr double kDeepestSlotRatio = 1.5;

/// How a cutter goes down into solid material on a slope.
struct Ramp {
  double angle_rad = 0.0;  ///< 0: it must not ramp
  /// Of the feed that its flanks would have in a slot of the same depth, at most.
  double feed_share = 1.0;
  /// Deepest slot milled in one level: chips must come out of it. Also of a cutter that must not ramp.
  double slot_depth_mm = 0.0;
  /// Deepest bore along a helix. Also of a cutter that must not ramp.
  double bore_depth_mm = 0.0;
};

/// The angle is that which the cutter's maker or the shop states; else that of the table by substrate and ISO
/// 513 group, and no more than the cutter's own.
///
/// Source  the rows in ramp.cpp.
[[nodiscard]] Ramp ramp_of(const Cutter& c, const WorkMaterial& m);

}  // namespace capstan::model
