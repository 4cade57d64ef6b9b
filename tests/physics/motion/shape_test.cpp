#include "planner/physics/motion/shape.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "planner/physics/motion/s_curve.h"

namespace capstan::motion {
namespace {

using model::CutterPath;
using model::MoveRole;

// 12 m/min rapid, 6 m/min at feed, 500 mm/s2; z half of each.
model::Machine machine(double tolerance_mm = 0.0) {
  model::Machine m;
  for (std::size_t i = 0; i < 3; ++i) {
    const double share = i == 2 ? 0.5 : 1.0;
    m.axes[i].name = std::string(1, static_cast<char>('X' + i));
    m.axes[i].rapid_mm_min = 12000.0 * share;
    m.axes[i].feed_max_mm_min = 6000.0 * share;
    m.axes[i].acceleration_mm_s2 = 500.0 * share;
  }
  m.control.path_tolerance_mm = tolerance_mm;
  return m;
}

TEST(LimitsOfAMachine, AreInSecondsAndRefusedWithoutAnAcceleration) {
  const Limits l = limits_of(machine(0.05)).value();
  EXPECT_DOUBLE_EQ(l.rapid_mm_s[0], 200.0);
  EXPECT_DOUBLE_EQ(l.feed_mm_s[2], 50.0);
  EXPECT_DOUBLE_EQ(l.tolerance_mm, 0.05);
  EXPECT_FALSE(l.has_jerk);
  model::Machine m = machine();
  m.axes[1].feed_max_mm_min = 0.0;
  EXPECT_DOUBLE_EQ(limits_of(m)->feed_mm_s[1], 200.0) << "no feed of its own: as fast as its rapid";
  m.axes[1].acceleration_mm_s2 = 0.0;
  const auto none = limits_of(m);
  ASSERT_FALSE(none);
  EXPECT_EQ(none.error().code, "MOT-MACHINE");
  EXPECT_NE(none.error().message.find("axis Y"), std::string::npos);
}

// 3, 4 in x and z: z goes at 0.8 of the path's speed, so its 50 mm/s let the path go at 62.5, its 250 mm/s2
// let it speed up by 312.5; x alone would allow 100 / 0.6.
TEST(ShapeOfALine, GoesAsFastAsItsSlowestAxisLets) {
  CutterPath p;
  p.start({0, 0, 0});
  p.line({30, 0, 40}, MoveRole::kCut);
  const Shape s = shape_of(p, 1, 1000.0, limits_of(machine()).value());
  EXPECT_DOUBLE_EQ(s.segment.length_mm, 50.0);
  EXPECT_DOUBLE_EQ(s.segment.speed_mm_s, 62.5);
  EXPECT_DOUBLE_EQ(s.segment.acceleration_mm_s2, 312.5);
  EXPECT_NEAR(s.first.z, 0.8, 1e-15);
  EXPECT_EQ(shape_of(p, 1, 20.0, limits_of(machine()).value()).segment.speed_mm_s, 20.0);
}

// The quarter of a circle of 10 mm from (10, 0) to (0, 10) begins along +y and ends along -x. Turning takes
// cos 30 degrees of 500 mm/s2 over 10 mm: sqrt(0.866 x 500 x 10) = 65.8 mm/s.
TEST(ShapeOfAnArc, HasItsTangentsAndTheSpeedOfItsTurning) {
  CutterPath p;
  p.start({10, 0, 0});
  p.arc({0, 10, 0}, {0, 0}, false, MoveRole::kCut);
  const Shape s = shape_of(p, 1, 1000.0, limits_of(machine()).value());
  EXPECT_NEAR(s.segment.length_mm, 5.0 * std::numbers::pi, 1e-12);
  EXPECT_NEAR(s.first.y, 1.0, 1e-12);
  EXPECT_NEAR(s.last.x, -1.0, 1e-12);
  EXPECT_NEAR(s.segment.speed_mm_s, std::sqrt(std::sqrt(0.75) * 500.0 * 10.0), 1e-9);
}

TEST(JunctionOfMoves, IsFullSpeedStraightOnAndAStopBackOrWithoutTolerance) {
  CutterPath p;
  p.start({0, 0, 0});
  p.line({50, 0, 0}, MoveRole::kCut);
  p.line({90, 0, 0}, MoveRole::kCut);
  p.line({40, 0, 0}, MoveRole::kCut);
  p.line({40, 50, 0}, MoveRole::kCut);
  const Limits none = limits_of(machine()).value();
  const auto at = [&](std::size_t i, const Limits& l) {
    return junction(shape_of(p, i, 30.0, l), shape_of(p, i + 1, 30.0, l), l);
  };
  EXPECT_EQ(at(1, none).speed_mm_s, 30.0);
  EXPECT_EQ(at(2, none).speed_mm_s, 0.0);
  EXPECT_FALSE(at(2, none).by_tolerance) << "no tolerance rounds a way back";
  EXPECT_EQ(at(3, none).speed_mm_s, 0.0);
  EXPECT_TRUE(at(3, none).by_tolerance);
  // A square corner within 0.01 mm: an arc of r = 0.01 s / (1 - s), s = sin 45; in its plane every axis gives
  // 500 mm/s2, of which turning takes cos 30.
  const double s = std::sqrt(0.5);
  const double speed = std::sqrt(std::sqrt(0.75) * 500.0 * 0.01 * s / (1.0 - s));
  EXPECT_NEAR(at(3, limits_of(machine(0.01)).value()).speed_mm_s, speed, 1e-9);
}

TEST(Stops, AreBetweenRapidAndFeedAndAtTapping) {
  CutterPath p;
  p.start({0, 0, 5});
  p.rapid({10, 0, 5});
  p.line({10, 0, 0}, MoveRole::kCut);
  p.line({10, 0, -5}, MoveRole::kTap);
  EXPECT_TRUE(stops_between(p, 1, 2));
  EXPECT_TRUE(stops_between(p, 2, 3));
  EXPECT_FALSE(stops_between(p, 2, 2));
}

// From rest to rest over 100 mm, at most 50 mm/s and 500 mm/s2, with a jerk of 10000 mm/s3: each ramp takes
// 50 / 500 + 500 / 10000 = 0.15 s over half of 50 x 0.15 = 3.75 mm; 92.5 mm at 50 mm/s between.
TEST(SCurveWalk, IsWhereConstantJerkBringsIt) {
  const Segment s{.length_mm = 100.0, .speed_mm_s = 50.0, .acceleration_mm_s2 = 500.0, .jerk_mm_s3 = 10000.0};
  const SegmentTime t = s_curve(s, 0.0, 0.0);
  EXPECT_NEAR(t.seconds, 0.15 + 92.5 / 50.0 + 0.15, 1e-9);
  SCurve walk(s, 0.0, 0.0, t);
  // The first phase: j t^3 / 6 within 0.05 s; at 0.03 s, 0.045 mm and j t^2 / 2 = 4.5 mm/s.
  EXPECT_NEAR(walk.seconds_at(10000.0 * 0.03 * 0.03 * 0.03 / 6.0), 0.03, 1e-9);
  EXPECT_NEAR(walk.speed_there(), 4.5, 1e-6);
  EXPECT_NEAR(walk.seconds_at(3.75 + 25.0), 0.15 + 0.5, 1e-9);
  EXPECT_NEAR(walk.speed_there(), 50.0, 1e-6);
  EXPECT_NEAR(walk.seconds_at(100.0), t.seconds, 1e-6);
}

}  // namespace
}  // namespace capstan::motion
