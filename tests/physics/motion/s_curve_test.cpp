#include "planner/physics/motion/s_curve.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace capstan::motion {
namespace {

// 500 mm/s2 and 5000 mm/s3: the acceleration is reached after 0.1 s and a change of 25 mm/s.
constexpr double kA = 500.0, kJerk = 5000.0;
constexpr double kNear = 1e-7;

Segment segment(double length_mm, double speed_mm_s) {
  return {.length_mm = length_mm,
          .speed_mm_s = speed_mm_s,
          .acceleration_mm_s2 = kA,
          .entry_mm_s = 0.0,
          .jerk_mm_s3 = kJerk};
}

TEST(SCurve, OfALongMovePassesEachPhaseWhenItsFormulaSays) {
  // 0 to 50 mm/s: 0.1 s of rising and 0.1 s of falling acceleration over 5 mm; 90 mm at 50 mm/s; the same
  // down.
  const Segment s = segment(100.0, 50.0);
  const SegmentTime t = s_curve(s, 0.0, 0.0);
  ASSERT_NEAR(t.seconds, 0.2 + 1.8 + 0.2, kNear);
  SCurve at(s, 0.0, 0.0, t);
  const double first_mm = kJerk * 0.1 * 0.1 * 0.1 / 6.0;
  EXPECT_NEAR(at.seconds_at(first_mm), 0.1, kNear);
  EXPECT_NEAR(at.speed_there(), 25.0, 1e-5);
  EXPECT_NEAR(at.seconds_at(50.0), 0.2 + 45.0 / 50.0, kNear);
  EXPECT_NEAR(at.speed_there(), 50.0, 1e-5);
  EXPECT_NEAR(at.seconds_at(100.0 - first_mm), t.seconds - 0.1, kNear);
  EXPECT_NEAR(at.speed_there(), 25.0, 1e-5);
  EXPECT_EQ(at.seconds_at(101.0), t.seconds) << "past its end: at its end";
}

TEST(SCurve, OfALargeChangeOfSpeedHoldsTheAccelerationBetween) {
  // 0 to 100 mm/s: 0.1 s up to 500 mm/s2, 0.1 s at it (25 to 75 mm/s), 0.1 s down: 15 mm in all.
  const Segment s = segment(200.0, 100.0);
  SCurve at(s, 0.0, 0.0, s_curve(s, 0.0, 0.0));
  const double first_mm = kJerk * 1e-3 / 6.0;
  EXPECT_NEAR(at.seconds_at(first_mm + 0.05 * 25.0 + 0.5 * kA * 0.05 * 0.05), 0.15, kNear);
  EXPECT_NEAR(at.speed_there(), 50.0, 1e-5);
  EXPECT_NEAR(at.seconds_at(15.0), 0.3, 1e-6);
}

TEST(SCurve, OfAShortMoveIsFourPartsOfOneJerk) {
  // Rest to rest over 0.5 mm, neither speed nor acceleration reached: quarters of T = 4 (L / 2 j)^(1/3).
  const Segment s = segment(0.5, 1000.0);
  SCurve at(s, 0.0, 0.0, s_curve(s, 0.0, 0.0));
  const double quarter = std::cbrt(0.5 / (2.0 * kJerk));
  EXPECT_NEAR(at.seconds_at(kJerk * std::pow(quarter, 3) / 6.0), quarter, 1e-6);
  EXPECT_NEAR(at.seconds_at(0.25), 2.0 * quarter, 1e-6);
  EXPECT_NEAR(at.speed_there(), kJerk * quarter * quarter, 1e-3);
}

TEST(SCurveProperty, RunsBackwardsAsItRunsForwards) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> share(0.0, 1.0), log_length(-1.0, 2.0);
  for (int i = 0; i < 500; ++i) {
    const Segment s = segment(std::pow(10.0, log_length(random)), 10.0 + 90.0 * share(random));
    const double v0 = s.speed_mm_s * share(random);
    const double v1 = std::min(s.speed_mm_s * share(random), reachable_smoothly(v0, s.length_mm, kA, kJerk));
    if (reachable_smoothly(v1, s.length_mm, kA, kJerk) < v0) continue;
    const SegmentTime t = s_curve(s, v0, v1);
    const double x = s.length_mm * share(random);
    SCurve forwards(s, v0, v1, t), backwards(s, v1, v0, t);
    EXPECT_NEAR(forwards.seconds_at(x), t.seconds - backwards.seconds_at(s.length_mm - x), 1e-5 * t.seconds);
    EXPECT_NEAR(forwards.speed_there(), backwards.speed_there(), 1e-3 * t.peak_mm_s);
  }
}

TEST(SCurveProperty, ItsSpeedIsTheSlopeOfItsWayAndWithinItsPeak) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> share(0.0, 1.0), log_length(-1.0, 2.0);
  for (int i = 0; i < 200; ++i) {
    const Segment s = segment(std::pow(10.0, log_length(random)), 10.0 + 90.0 * share(random));
    const SegmentTime t = s_curve(s, 0.0, 0.0);
    SCurve at(s, 0.0, 0.0, t);
    double time = 0.0, speed = 0.0;
    for (int k = 1; k < 1000; ++k) {
      const double now = at.seconds_at(s.length_mm * k / 1000.0);
      EXPECT_GT(now, time);
      EXPECT_LE(at.speed_there(), t.peak_mm_s * (1.0 + 1e-6));
      // Between the first and the last hundredth, where the speed changes little from piece to piece.
      if (k > 10 && k < 990) {
        EXPECT_NEAR(s.length_mm / 1000.0 / (now - time), 0.5 * (speed + at.speed_there()),
                    0.01 * t.peak_mm_s);
      }
      time = now;
      speed = at.speed_there();
    }
  }
}

}  // namespace
}  // namespace capstan::motion
