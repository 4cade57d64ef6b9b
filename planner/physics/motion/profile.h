#pragma once

#include <algorithm>
#include <cmath>

namespace capstan::motion {

/// Of an axis that states no jerk.
inline constexpr double kNoJerk = 1e300;

/// One move as the scans see it. Units: mm, mm/s, mm/s2, mm/s3.
struct Segment {
  double length_mm = 0.0;
  double speed_mm_s = 0.0;          ///< never exceeded
  double acceleration_mm_s2 = 0.0;  ///< along the path, also when braking
  double entry_mm_s = 0.0;          ///< in: limit of the speed at its start; out: the speed there
  double jerk_mm_s3 = kNoJerk;
};

/// Time of a move between two speeds.
struct SegmentTime {
  double seconds = 0.0;
  double peak_mm_s = 0.0;
  double at_peak_s = 0.0;  ///< of the seconds: at constant speed
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
    return {(2.0 * peak - v0 - v1) / a, peak, 0.0};
  }
  const double v = s.speed_mm_s;
  const double ramps_mm = (v * v - mean_square) / a;
  const double flat_s = (s.length_mm - ramps_mm) / v;
  return {(2.0 * v - v0 - v1) / a + flat_s, v, flat_s};
}

/// The speed reachable over a segment when starting (or, backwards, ending) at v.
[[nodiscard]] inline double reachable(const Segment& s, double v) {
  return std::sqrt(v * v + 2.0 * s.acceleration_mm_s2 * s.length_mm);
}

/// Seconds of a change of speed that begins and ends without acceleration, with jerk j and at most a:
///
///     dv <= a^2 / j:  2 sqrt(dv / j)          else  dv / a + a / j          (S-curve)
///
/// By symmetry its mean speed is (v0 + v1) / 2. Source: constant jerk, derived.
[[nodiscard]] inline double ramp_s(double change_mm_s, double a, double j) {
  const double dv = std::abs(change_mm_s);
  return dv * j <= a * a ? 2.0 * std::sqrt(dv / j) : dv / a + a / j;
}

[[nodiscard]] inline double ramp_mm(double v0, double v1, double a, double j) {
  return 0.5 * (v0 + v1) * ramp_s(v1 - v0, a, j);
}

/// The speed reached over a length by one such ramp, the inverse of `ramp_mm`:
///
///     j s^3 + 2 v s = L,  v1 = v + j s^2                        while a is not reached
///     dv^2 / a + dv (2 v / a + a / j) + 2 v a / j = 2 L         beyond
///
/// Source  Cardano's formula for the one real root of the cubic; derived.
[[nodiscard]] inline double reachable_smoothly(double v, double length_mm, double a, double j) {
  if (!(length_mm > 0.0)) return v;
  const double full = a * a / j;  // change of speed at which a is just reached
  if (length_mm >= 0.5 * (2.0 * v + full) * 2.0 * (a / j)) {
    const double b = v + 0.5 * full;
    const double c = 2.0 * (v * full - a * length_mm);
    return v + std::sqrt(std::max(0.0, b * b - c)) - b;
  }
  const double p = 2.0 * v / j;  // s^3 + p s = q
  const double q = length_mm / j;
  double s = 0.0;
  if (p > 0.0) {
    const double k = std::sqrt(p / 3.0);
    s = 2.0 * k * std::sinh(std::asinh(1.5 * q / (p * k)) / 3.0);
  } else {
    s = std::cbrt(q);
  }
  return v + j * s * s;
}

/// From v0 up by one ramp, on at constant speed where the length allows, and down to v1 by another.
/// Needs   v0, v1 <= speed, and each reachable smoothly from the other over the length.
[[nodiscard]] inline SegmentTime s_curve(const Segment& s, double v0, double v1) {
  if (s.length_mm <= 0.0) return {};
  const double a = s.acceleration_mm_s2;
  const double j = s.jerk_mm_s3;
  const auto ramps = [&](double peak) { return ramp_mm(v0, peak, a, j) + ramp_mm(peak, v1, a, j); };
  const auto timed = [&](double peak) {
    const double flat_s = std::max(0.0, s.length_mm - ramps(peak)) / peak;
    return SegmentTime{ramp_s(peak - v0, a, j) + ramp_s(peak - v1, a, j) + flat_s, peak, flat_s};
  };
  if (ramps(s.speed_mm_s) <= s.length_mm) return timed(s.speed_mm_s);
  double lo = std::max(v0, v1);
  double hi = s.speed_mm_s;
  if (!(ramps(lo) <= s.length_mm)) {  // by rounding only: straight from the one to the other
    return {2.0 * s.length_mm / std::max(v0 + v1, 1e-9), lo, 0.0};
  }
  constexpr double kNear = 1e-9;
  for (int i = 0; i < 60 && hi - lo > kNear * hi; ++i) {
    const double mid = 0.5 * (lo + hi);
    (ramps(mid) <= s.length_mm ? lo : hi) = mid;
  }
  return timed(std::max(lo, 1e-9));
}

}  // namespace capstan::motion
