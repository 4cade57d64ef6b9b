#pragma once

#include <optional>

#include "planner/making/toolpath/region/area/inside.h"
#include "planner/making/toolpath/region/area/track.h"

namespace capstan::toolpath {

/// A way from the end of one ring onto the next, tangent to both, so that the cutter does not stop at either
/// end of it, as it does with a straight step.
///
/// Two arcs that meet in a common tangent (a biarc: Bolton, Computer-Aided Design 7 (1975) 29), with tangents
/// of equal length at both ends. The second ring is met ahead, by the distance of the rings or, past a
/// corner, by more.
struct Crossing {
  Track way;
  Spot onto;  ///< of the ring, where the way meets it
};
/// From `at`, cutting along `heading` (of length 1), onto the closed track `to`. Nothing where the track does
/// not run the same way anywhere near, or where the way leaves `inside`.
[[nodiscard]] std::optional<Crossing> crossing(geometry::Vec2 at, geometry::Vec2 heading, const Track& to,
                                               const Inside& inside);

}  // namespace capstan::toolpath
