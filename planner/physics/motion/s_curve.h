#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include "planner/physics/motion/profile.h"

namespace capstan::motion {

/// Where a move of `s_curve` is at each time: seven phases of constant jerk, walked forward once.
///
/// Units   mm, s. Source  integration of constant jerk, derived.
class SCurve {
 public:
  SCurve(const Segment& s, double v0, double v1, const SegmentTime& t) : v_(v0), total_s_(t.seconds) {
    const double a = s.acceleration_mm_s2;
    const double j = s.jerk_mm_s3;
    ramp(t.peak_mm_s - v0, a, j, 1.0);
    add(t.at_peak_s, 0.0);
    ramp(t.peak_mm_s - v1, a, j, -1.0);
  }

  /// The time at which a length is passed; lengths must not fall from call to call.
  double seconds_at(double length_mm) {
    while (phase_ < n_ && x_ + way(phases_[phase_].seconds) < length_mm) {
      const Phase& p = phases_[phase_];
      const double t = p.seconds;
      x_ += way(t);
      v_ += (a_ + 0.5 * p.jerk * t) * t;
      a_ += p.jerk * t;
      t_ += t;
      ++phase_;
    }
    if (phase_ == n_) return total_s_;
    double lo = 0.0;
    double hi = phases_[phase_].seconds;
    // The way rises with time: Newton, kept within what is known.
    const double asked = length_mm - x_;
    double t = std::min(hi, v_ > 0.0 ? asked / v_ : hi);
    for (int i = 0; i < 50 && hi - lo > 1e-13; ++i) {
      const double error = way(t) - asked;
      (error < 0.0 ? lo : hi) = t;
      const double v = speed(t);
      double next = v > 0.0 ? t - error / v : 0.5 * (lo + hi);
      if (!(next > lo && next < hi)) next = 0.5 * (lo + hi);
      if (std::abs(next - t) < 1e-13) break;
      t = next;
    }
    here_mm_s_ = speed(t);
    return t_ + t;
  }

  /// At the length last asked for, before the end.
  [[nodiscard]] double speed_there() const { return here_mm_s_; }

 private:
  struct Phase {
    double seconds = 0.0, jerk = 0.0;
  };

  void add(double seconds, double jerk) {
    if (seconds > 0.0) phases_[n_++] = {seconds, jerk};
  }
  void ramp(double change, double a, double j, double sign) {
    if (change * j <= a * a) {
      const double t = std::sqrt(std::max(0.0, change) / j);
      add(t, sign * j);
      add(t, -sign * j);
      return;
    }
    add(a / j, sign * j);
    add(change / a - a / j, 0.0);
    add(a / j, -sign * j);
  }
  [[nodiscard]] double way(double t) const {
    return (v_ + (0.5 * a_ + phases_[phase_].jerk * t / 6.0) * t) * t;
  }
  [[nodiscard]] double speed(double t) const { return v_ + (a_ + 0.5 * phases_[phase_].jerk * t) * t; }

  std::array<Phase, 7> phases_{};
  std::size_t n_ = 0, phase_ = 0;
  double v_ = 0.0, a_ = 0.0, x_ = 0.0, t_ = 0.0, total_s_ = 0.0, here_mm_s_ = 0.0;
};

}  // namespace capstan::motion
