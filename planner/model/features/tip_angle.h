#pragma once

namespace capstan::model {

/// The tip_angle of a CONICAL_HOLE_BOTTOM is the full angle of the point. Files also give the flank's angle
/// against the plane (20 degrees for a point of 140; example 2 of ISO 14649-11: 30 for 120), or half of the
/// point's (70 for 140). Points of drills have 90 to 150 degrees, so that the three do not overlap: up to
/// kFlankTipDegrees a tip_angle is read as the flank's, up to kHalfTipDegrees as half of the point's. A point
/// as sharp as that has no tip_angle that is read as its own.
inline constexpr double kFlankTipDegrees = 45.0;
inline constexpr double kHalfTipDegrees = 75.0;

}  // namespace capstan::model
