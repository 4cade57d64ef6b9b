#pragma once

#include <cmath>

namespace capstan::motion {

/// One move as the acceleration scan sees it. Units: mm, mm/s, mm/s2.
struct Segment {
  double length_mm = 0.0;
  double speed_mm_s = 0.0;          ///< never exceeded
  double acceleration_mm_s2 = 0.0;  ///< along the path, also when braking
  double entry_mm_s = 0.0;          ///< in: limit of the speed at its start; out: the speed there
};

/// What a move does between two speeds.
struct SegmentTime {
  double seconds = 0.0;
  double peak_mm_s = 0.0;
};

/// Constant acceleration from v0, at most to the segment's speed, then braking to v1:
///
///     v_peak^2 = a L + (v0^2 + v1^2) / 2      t = (2 v_peak - v0 - v1) / a        (triangle)
///     and, past the speed limit, a stretch at that speed between the ramps          (trapezoid)
///
/// Needs   v0, v1 <= speed, and each reachable from the other over the length.
/// Source  uniformly accelerated motion, derived.
[[nodiscard]] inline SegmentTime trapezoid(const Segment& s, double v0, double v1) {
  if (s.length_mm <= 0.0) return {};
  const double a = s.acceleration_mm_s2;
  const double mean_square = 0.5 * (v0 * v0 + v1 * v1);
  const double peak = std::sqrt(a * s.length_mm + mean_square);
  if (peak <= s.speed_mm_s) {
    return {(2.0 * peak - v0 - v1) / a, peak};
  }
  const double v = s.speed_mm_s;
  const double ramps_mm = (v * v - mean_square) / a;
  return {(2.0 * v - v0 - v1) / a + (s.length_mm - ramps_mm) / v, v};
}

/// The speed reachable over a segment when starting (or, backwards, ending) at v.
[[nodiscard]] inline double reachable(const Segment& s, double v) {
  return std::sqrt(v * v + 2.0 * s.acceleration_mm_s2 * s.length_mm);
}

}  // namespace capstan::motion
