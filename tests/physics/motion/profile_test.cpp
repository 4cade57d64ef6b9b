#include "planner/physics/motion/profile.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace capstan::motion {
namespace {

/// Within four decades each, so that every kind of profile is met.
struct Random {
  std::mt19937 engine;
  double decade(double from, double to) {
    return std::pow(10.0, std::uniform_real_distribution<double>(from, to)(engine));
  }
  double share(double most) { return std::uniform_real_distribution<double>(0.0, most)(engine); }
};

Segment segment(double length_mm, double speed_mm_s, double a, double jerk = kNoJerk) {
  return {.length_mm = length_mm,
          .speed_mm_s = speed_mm_s,
          .acceleration_mm_s2 = a,
          .entry_mm_s = 0.0,
          .jerk_mm_s3 = jerk};
}

TEST(Trapezoid, SpeedsUpRunsAndBrakes) {
  // From 10 up to 50 at 100 mm/s2: 0.4 s, 12 mm; down to 30: 0.2 s, 8 mm; 30 mm at 50 between.
  const SegmentTime t = trapezoid(segment(50.0, 50.0, 100.0), 10.0, 30.0);
  EXPECT_NEAR(t.seconds, 0.4 + 0.6 + 0.2, 1e-12);
  EXPECT_EQ(t.peak_mm_s, 50.0);
  EXPECT_NEAR(t.at_peak_s, 0.6, 1e-12);
}

TEST(Trapezoid, OfNoLengthTakesNoTime) {
  EXPECT_EQ(trapezoid(segment(0.0, 50.0, 100.0), 0.0, 0.0).seconds, 0.0);
  EXPECT_EQ(s_curve(segment(0.0, 50.0, 100.0, 1e4), 0.0, 0.0).seconds, 0.0);
}

TEST(TrapezoidProperty, CoversItsLengthWithinItsSpeed) {
  Random random{.engine = std::mt19937(1)};
  int triangles = 0;
  for (int i = 0; i < 5000; ++i) {
    const Segment s = segment(random.decade(-2, 3), random.decade(0, 3), random.decade(1, 4));
    const double v0 = random.share(s.speed_mm_s);
    const double v1 = std::min({random.share(s.speed_mm_s), reachable(s, v0)});
    if (reachable(s, v1) < v0) continue;
    const SegmentTime t = trapezoid(s, v0, v1);
    EXPECT_LE(t.peak_mm_s, s.speed_mm_s * (1.0 + 1e-12));
    EXPECT_GE(t.peak_mm_s, std::max(v0, v1) * (1.0 - 1e-12));
    // Mean speed times time of each part.
    const double up_s = (t.peak_mm_s - v0) / s.acceleration_mm_s2;
    const double down_s = (t.peak_mm_s - v1) / s.acceleration_mm_s2;
    EXPECT_NEAR(
        0.5 * (v0 + t.peak_mm_s) * up_s + t.peak_mm_s * t.at_peak_s + 0.5 * (v1 + t.peak_mm_s) * down_s,
        s.length_mm, 1e-9 * s.length_mm);
    EXPECT_NEAR(up_s + t.at_peak_s + down_s, t.seconds, 1e-9 * t.seconds);
    triangles += t.at_peak_s == 0.0 ? 1 : 0;
  }
  EXPECT_GT(triangles, 500);
}

TEST(Reachable, IsTheEndOfAMoveThatOnlySpeedsUp) {
  // 0.6 s at 100 mm/s2 from 20 to 80 mm/s, 50 mm/s in the mean: 30 mm.
  EXPECT_NEAR(reachable(segment(30.0, 1e9, 100.0), 20.0), 80.0, 1e-12);
}

/// Seconds and way of a change of speed by jerk, walked in small steps: acceleration rises with the jerk to
/// at most a, as long as it can fall to zero again before the change is done.
struct Walked {
  double seconds = 0.0, way_mm = 0.0;
};
Walked walked(double v0, double v1, double a_most, double jerk) {
  Walked out;
  const double change = std::abs(v1 - v0);
  const double step = 1e-5 * (change / a_most + 2.0 * std::sqrt(change / jerk));
  double a = 0.0, done = 0.0;
  while (done < change) {
    const bool falls = done + 0.5 * a * a / jerk >= change;  // what still comes while a falls to zero
    a = falls ? std::max(a - jerk * step, 1e-6 * a_most) : std::min(a + jerk * step, a_most);
    done += a * step;
    out.seconds += step;
    out.way_mm += (v0 + (v1 > v0 ? done : -done)) * step;
  }
  return out;
}

TEST(Ramp, IsWhatSmallStepsOfJerkComeTo) {
  // 500 mm/s2 and 5000 mm/s3: a change of 50 mm/s just reaches the acceleration.
  for (const auto& [v0, v1] : {std::pair(0.0, 20.0), {10.0, 60.0}, {0.0, 150.0}, {150.0, 30.0}}) {
    const Walked w = walked(v0, v1, 500.0, 5000.0);
    EXPECT_NEAR(ramp_s(v1 - v0, 500.0, 5000.0), w.seconds, 0.01 * w.seconds) << v0 << " " << v1;
    EXPECT_NEAR(ramp_mm(v0, v1, 500.0, 5000.0), w.way_mm, 0.01 * w.way_mm) << v0 << " " << v1;
  }
}

TEST(Ramp, TakesAsLongUpAsDownAndJoinsWhereTheAccelerationIsReached) {
  EXPECT_EQ(ramp_s(40.0, 500.0, 5000.0), ramp_s(-40.0, 500.0, 5000.0));
  EXPECT_NEAR(ramp_s(50.0, 500.0, 5000.0), 2.0 * 500.0 / 5000.0, 1e-12);
  EXPECT_NEAR(ramp_s(50.0 * (1.0 + 1e-12), 500.0, 5000.0), 2.0 * 500.0 / 5000.0, 1e-9);
}

TEST(Reachable, SmoothlyIsTheInverseOfTheRamp) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> log_v(-2, 2), log_l(-4, 2), log_j(2, 7);
  for (int i = 0; i < 5000; ++i) {
    const double v = i % 10 == 0 ? 0.0 : std::pow(10.0, log_v(random));
    const double length = std::pow(10.0, log_l(random));
    const double jerk = std::pow(10.0, log_j(random));
    const double top = reachable_smoothly(v, length, 500.0, jerk);
    EXPECT_GT(top, v);
    EXPECT_NEAR(ramp_mm(v, top, 500.0, jerk), length, 1e-4 * length);  // v1 - v cancels
  }
  EXPECT_EQ(reachable_smoothly(3.0, 0.0, 500.0, 1e5), 3.0);
}

TEST(SCurveProfileProperty, CoversItsLengthWithinItsSpeedAndIsNoFasterThanWithoutJerk) {
  Random random{.engine = std::mt19937(2)};
  int short_ones = 0;
  for (int i = 0; i < 5000; ++i) {
    const Segment s =
        segment(random.decade(-2, 3), random.decade(0, 3), random.decade(1, 4), random.decade(2, 6));
    const double a = s.acceleration_mm_s2, j = s.jerk_mm_s3;
    const double v0 = random.share(s.speed_mm_s);
    const double v1 = std::min(random.share(s.speed_mm_s), reachable_smoothly(v0, s.length_mm, a, j));
    if (reachable_smoothly(v1, s.length_mm, a, j) < v0) continue;
    const SegmentTime t = s_curve(s, v0, v1);
    EXPECT_LE(t.peak_mm_s, s.speed_mm_s * (1.0 + 1e-12));
    EXPECT_NEAR(ramp_mm(v0, t.peak_mm_s, a, j) + t.peak_mm_s * t.at_peak_s + ramp_mm(t.peak_mm_s, v1, a, j),
                s.length_mm, 1e-6 * s.length_mm);
    EXPECT_GE(t.seconds, trapezoid(s, v0, v1).seconds * (1.0 - 1e-6));
    short_ones += t.peak_mm_s < 0.999 * s.speed_mm_s ? 1 : 0;
    // With so much jerk nothing is left of it.
    Segment stiff = s;
    stiff.jerk_mm_s3 = 1e14;
    EXPECT_NEAR(s_curve(stiff, v0, v1).seconds, trapezoid(s, v0, v1).seconds, 1e-4 * t.seconds);
  }
  EXPECT_GT(short_ones, 500);
}

}  // namespace
}  // namespace capstan::motion
