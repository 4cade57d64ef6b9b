#pragma once

namespace capstan::model::shape {

/// How far beyond an open side the reach of a feature goes: room for a cutter to enter, mm. What is cut out
/// to the edge of the raw piece (a step, an outside) is cut as wide as this at least. Default, unsourced.
inline constexpr double kOpenReach = 100.0;
/// Sine of the least angle, 10 degrees, at which a wall may lean over the mouth of an open side and be made
/// to its end beyond it. Default, unsourced.
inline constexpr double kLeastMouthSine = 0.17;

}  // namespace capstan::model::shape
