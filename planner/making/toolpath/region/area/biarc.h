#pragma once

#include <optional>

#include "planner/making/toolpath/region/area/track.h"

namespace capstan::toolpath {

/// Two arcs with one tangent where they meet, from `a`, left in the unit direction `leave`, to `b`, met in
/// the unit direction `meet`. An arc that bends by less than kSmallestArc is a line. Nothing where one of
/// them would turn more than a right angle. Units  mm, both directions in the plane of the points. Source K.
/// M. Bolton, Biarc curves, Computer-Aided Design 7 (1975), p. 89: tangents of equal length.
[[nodiscard]] std::optional<Track> biarc(geometry::Vec2 a, geometry::Vec2 leave, geometry::Vec2 b,
                                         geometry::Vec2 meet);

}  // namespace capstan::toolpath
