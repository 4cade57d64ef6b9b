#include "planner/making/step/cut/thread_bound.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace capstan::step {
namespace {

/// M10 x 1.5, 15 mm deep, in a core of 8.5 mm.
model::FeatureShape m10() {
  model::FeatureShape s;
  s.kind = model::ShapeKind::kThread;
  s.thread_major_mm = 10.0;
  s.thread_pitch_mm = 1.5;
  s.thread_depth_mm = 15.0;
  s.diameter.nominal_mm = 8.5;
  return s;
}

model::Cutter mill(double diameter_mm, double rows_mm) {
  model::Cutter c;
  c.cutter_class = model::CutterClass::kThreadMill;
  c.cutting_diameter_mm = diameter_mm;
  c.maximum_depth_of_cut_mm = rows_mm;
  return c;
}

// By hand: R 4, the circle's radius 5 - 4 = 1, the core's 4.25; cos t = (18.0625 - 1 - 16) / 8 = 0.1328,
// ae = 4 (1 - 0.1328) = 3.469.
TEST(ThreadBound, IsTheArcFromTheWallToWhereTheCircleLeavesTheCore) {
  const ThreadBound b = thread_bound(mill(8.0, 1.5), m10());
  EXPECT_NEAR(b.ae_mm, 3.46875, 1e-12);
  EXPECT_EQ(b.ap_mm, 1.5);
}

// By hand: (10 - 8) / 10; of M20 and 13.8 mm (20 - 13.8) / 20.
TEST(ThreadBound, FeedsTheCentreSlowerThanTheEdgeByTheirCircles) {
  EXPECT_NEAR(thread_bound(mill(8.0, 1.5), m10()).centre_share, 0.2, 1e-12);
  model::FeatureShape m20 = m10();
  m20.thread_major_mm = 20.0;
  m20.thread_pitch_mm = 2.5;
  m20.diameter.nominal_mm = 17.5;
  EXPECT_NEAR(thread_bound(mill(13.8, 3.75), m20).centre_share, 0.31, 1e-12);
}

TEST(ThreadBound, IsAsDeepAsAllProfilesOrTheThread) {
  EXPECT_EQ(thread_bound(mill(8.0, 12.0), m10()).ap_mm, 12.0);
  EXPECT_EQ(thread_bound(mill(8.0, 25.0), m10()).ap_mm, 15.0);
  EXPECT_EQ(thread_bound(mill(8.0, 2.9), m10()).ap_mm, 1.5)
      << "less than two pitches of teeth are one profile";
}

TEST(ThreadBound, IsTheWholeWidthOfAMillThatFillsTheThread) {
  EXPECT_EQ(thread_bound(mill(10.0, 1.5), m10()).ae_mm, 10.0);
}

TEST(ThreadBound, StandsOnEveryArcThatCutsAndOnNothingElse) {
  model::CutterPath p;
  p.start({1.0, 0.0, 5.0});
  p.line({1.0, 0.0, 0.0}, model::MoveRole::kApproach);
  p.arc({-1.0, 0.0, 0.75}, {0.0, 0.0}, false, model::MoveRole::kCut);
  p.arc({1.0, 0.0, 1.5}, {0.0, 0.0}, false, model::MoveRole::kLink);
  p.line({0.0, 0.0, 1.5}, model::MoveRole::kCut);
  const auto samples = bound_samples({1.5, 3.0}, p);
  ASSERT_EQ(samples.size(), 1U);
  EXPECT_EQ(samples[0].move, 2U);
  EXPECT_NEAR(samples[0].csa_mm2, 4.5, 1e-12);
  const double flat = std::numbers::pi;  // half a turn of radius 1
  EXPECT_NEAR(samples[0].step_mm, std::hypot(flat, 0.75), 1e-9);
}

}  // namespace
}  // namespace capstan::step
