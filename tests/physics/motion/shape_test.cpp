#include "planner/physics/motion/shape.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

namespace capstan::motion {
namespace {

using geometry::Vec2;
using geometry::Vec3;
using model::CutterPath;
using model::MoveRole;
using std::numbers::pi;

constexpr double kNear = 1e-9;
constexpr double kFeed = 40.0;  // mm/s, below what the axes give

/// X gives 100 mm/s and 500 mm/s2, Y half of both, Z a fifth; rapids are twice as fast.
model::Machine machine() {
  model::Machine m;
  const double share[] = {1.0, 0.5, 0.2};
  for (std::size_t i = 0; i < 3; ++i) {
    m.axes[i].name = std::string(1, static_cast<char>('X' + i));
    m.axes[i].rapid_mm_min = 12000.0 * share[i];
    m.axes[i].feed_max_mm_min = 6000.0 * share[i];
    m.axes[i].acceleration_mm_s2 = 500.0 * share[i];
  }
  m.control.path_tolerance_mm = 0.05;
  m.control.block_time_s = 0.002;
  return m;
}
/// All axes as X.
model::Machine even_machine() {
  model::Machine m = machine();
  for (auto& axis : m.axes) {
    axis.rapid_mm_min = 12000.0;
    axis.feed_max_mm_min = 6000.0;
    axis.acceleration_mm_s2 = 500.0;
  }
  return m;
}
Limits limits(const model::Machine& m = machine()) { return limits_of(m).value(); }

CutterPath line(Vec3 from, Vec3 to) {
  CutterPath p;
  p.start(from);
  p.line(to, MoveRole::kCut);
  return p;
}
CutterPath arc(Vec3 from, Vec3 to, Vec2 centre, bool clockwise) {
  CutterPath p;
  p.start(from);
  p.arc(to, centre, clockwise, MoveRole::kCut);
  return p;
}
void expect_near(Vec3 a, Vec3 b) { EXPECT_LT(norm(a - b), kNear) << a.x << " " << a.y << " " << a.z; }

// --- What the machine gives ---

TEST(LimitsOf, AreInSecondsAndTakeRapidsWhereNoFeedIsStated) {
  model::Machine m = machine();
  m.axes[1].feed_max_mm_min = 0.0;
  m.axes[2].jerk_mm_s3 = 3e4;
  const Limits l = limits(m);
  EXPECT_EQ(l.rapid_mm_s, (std::array{200.0, 100.0, 40.0}));
  EXPECT_EQ(l.feed_mm_s, (std::array{100.0, 100.0, 20.0}));
  EXPECT_EQ(l.acceleration, (std::array{500.0, 250.0, 100.0}));
  EXPECT_EQ(l.jerk, (std::array{kNoJerk, kNoJerk, 3e4}));
  EXPECT_TRUE(l.has_jerk);
  EXPECT_FALSE(limits().has_jerk);
  EXPECT_EQ(l.tolerance_mm, 0.05);
  EXPECT_EQ(l.block_s, 0.002);
}

TEST(LimitsOf, AreNotThoseOfAnAxisWithoutAccelerationOrSpeed) {
  const auto refused = [](auto change) {
    model::Machine m = machine();
    change(m.axes[1]);
    const auto l = limits_of(m);
    ASSERT_FALSE(l);
    EXPECT_EQ(l.error().code, "MOT-MACHINE");
    EXPECT_NE(l.error().message.find("axis Y "), std::string::npos) << l.error().message;
  };
  refused([](model::LinearAxis& a) { a.acceleration_mm_s2 = 0.0; });
  refused([](model::LinearAxis& a) { a.acceleration_mm_s2 = std::nan(""); });
  refused([](model::LinearAxis& a) { a.acceleration_mm_s2 = HUGE_VAL; });
  refused([](model::LinearAxis& a) { a.rapid_mm_min = -1.0; });
  refused([](model::LinearAxis& a) { a.rapid_mm_min = HUGE_VAL; });
}

// --- Straight moves ---

TEST(ShapeOf, ALineIsHeldByTheAxisThatGivesLeastAlongIt) {
  // 3 : 4 in X and Y: Y gives 50 mm/s for 0.8 of the way, 62.5 along it, X 166.
  const Shape s = shape_of(line({1, 2, 3}, {31, 42, 3}), 1, 1000.0, limits());
  EXPECT_NEAR(s.segment.length_mm, 50.0, kNear);
  expect_near(s.first, {0.6, 0.8, 0.0});
  EXPECT_EQ(s.first, s.last);
  EXPECT_NEAR(s.axes_mm_s, 62.5, kNear);
  EXPECT_NEAR(s.segment.speed_mm_s, 62.5, kNear);
  EXPECT_NEAR(s.segment.acceleration_mm_s2, 250.0 / 0.8, kNear);
  EXPECT_GE(s.turning_mm_s, kNoSpeed);
}

TEST(ShapeOf, ALineRunsAtItsFeedAndARapidAtWhatTheAxesGive) {
  EXPECT_EQ(shape_of(line({0, 0, 0}, {10, 0, 0}), 1, kFeed, limits()).segment.speed_mm_s, kFeed);
  CutterPath rapid;
  rapid.start({0, 0, 0});
  rapid.rapid({0, 0, 10});
  EXPECT_NEAR(shape_of(rapid, 1, kFeed, limits()).segment.speed_mm_s, 40.0, kNear);
  rapid.rapid({10, 0, 10});
  EXPECT_NEAR(shape_of(rapid, 2, kFeed, limits()).segment.speed_mm_s, 200.0, kNear);
}

TEST(ShapeOf, AMoveWithoutLengthHasNoDirection) {
  for (const CutterPath& p : {line({1, 1, 1}, {1, 1, 1}), arc({1, 1, 1}, {1, 1, 1}, {1, 1}, false)}) {
    const Shape s = shape_of(p, 1, kFeed, limits());
    EXPECT_EQ(s.segment.length_mm, 0.0);
    EXPECT_EQ(s.first, Vec3{});
    EXPECT_EQ(s.last, Vec3{});
  }
}

// --- Arcs ---

TEST(ShapeOf, AnArcTurnsFromItsFirstTangentToItsLast) {
  const Shape left = shape_of(arc({10, 0, 0}, {0, 10, 0}, {0, 0}, false), 1, kFeed, limits());
  EXPECT_NEAR(left.segment.length_mm, 5.0 * pi, kNear);
  expect_near(left.first, {0, 1, 0});
  expect_near(left.last, {-1, 0, 0});
  const Shape right = shape_of(arc({0, 10, 0}, {10, 0, 0}, {0, 0}, true), 1, kFeed, limits());
  expect_near(right.first, {1, 0, 0});
  expect_near(right.last, {0, -1, 0});
}

TEST(ShapeOf, AnArcIsHeldByTheWeakerOfItsTwoAxesAndByItsCentripetalAcceleration) {
  // Somewhere Y carries all of it: 50 mm/s, 250 mm/s2.
  const Limits l = limits();
  const Shape s = shape_of(arc({10, 0, 0}, {-10, 0, 0}, {0, 0}, false), 1, 1000.0, l);
  EXPECT_NEAR(s.axes_mm_s, 50.0, kNear);
  EXPECT_NEAR(s.turning_mm_s, std::sqrt(l.turning_share * 250.0 * 10.0), kNear);
  EXPECT_NEAR(s.segment.speed_mm_s, std::min(50.0, s.turning_mm_s), kNear);
}

TEST(ShapeOf, AnArcLeavesForBrakingWhatItsCentripetalAccelerationDoesNotTake) {
  // At 30 mm/s on a radius of 10 mm 90 of 500 mm/s2 turn: sqrt(500^2 - 90^2) are left along the path.
  Limits l = limits(even_machine());
  l.along_share = 0.1;
  const CutterPath p = arc({10, 0, 0}, {-10, 0, 0}, {0, 0}, false);
  EXPECT_NEAR(shape_of(p, 1, 30.0, l).segment.acceleration_mm_s2, std::sqrt(500.0 * 500.0 - 90.0 * 90.0),
              1e-6);
  l.along_share = 0.999;
  EXPECT_NEAR(shape_of(p, 1, 30.0, l).segment.acceleration_mm_s2, 0.999 * 500.0, 1e-6);
}

TEST(ShapeOf, AHelixIsAsLongAsItsDevelopmentAndTurnsLessThanItsCircle) {
  // A full turn of radius 10 that falls as far as it goes round: 45 degrees.
  const double round = 20.0 * pi;
  const Limits l = limits(even_machine());
  const Shape s = shape_of(arc({10, 0, 0}, {10, 0, -round}, {0, 0}, false), 1, kFeed, l);
  EXPECT_NEAR(s.segment.length_mm, round * std::sqrt(2.0), kNear);
  expect_near(s.first, {0.0, std::sqrt(0.5), -std::sqrt(0.5)});
  expect_near(s.last, s.first);
  // Its radius of curvature is twice the circle's; each axis gives 500 over sqrt(1/2) of the way.
  EXPECT_NEAR(s.turning_mm_s, std::sqrt(l.turning_share * 500.0 * std::sqrt(2.0) * 20.0), 1e-6);
}

TEST(ShapeProperty, AnArcIsWhatManyChordsComeTo) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> at(-20.0, 20.0);
  const Limits l = limits();
  for (int i = 0; i < 100; ++i) {
    const Vec3 from{at(random), at(random), at(random)};
    const Vec2 centre{at(random), at(random)};
    const Vec2 arm = xy(from) - centre;
    const double turn = at(random);
    const Vec3 to{centre.x + arm.x * std::cos(turn) - arm.y * std::sin(turn),
                  centre.y + arm.x * std::sin(turn) + arm.y * std::cos(turn), at(random)};
    const CutterPath p = arc(from, to, centre, i % 2 == 0);
    const Shape s = shape_of(p, 1, kFeed, l);
    constexpr std::size_t kChords = 2000;
    std::vector<Vec3> points;
    for (std::size_t k = 0; k <= kChords; ++k)
      points.push_back(model::point_on_move(p, 1, static_cast<double>(k) / kChords));
    double length = 0.0;
    for (std::size_t k = 0; k < kChords; ++k) length += norm(points[k + 1] - points[k]);
    EXPECT_NEAR(s.segment.length_mm, length, 1e-4 * length);
    EXPECT_LT(norm(s.first - normalised(points[1] - points[0])), 0.01);
    EXPECT_LT(norm(s.last - normalised(points[kChords] - points[kChords - 1])), 0.01);
  }
}

// --- From move to move ---

Junction corner(Vec3 a, Vec3 b, Vec3 c, const Limits& l, double feed = kFeed) {
  return junction(shape_of(line(a, b), 1, feed, l), shape_of(line(b, c), 1, feed, l), l);
}

TEST(Junction, IsPassedAtTheSlowerSpeedStraightOnAndNotAtAllWhereThePathTurnsBack) {
  const Limits l = limits();
  const Shape fast = shape_of(line({0, 0, 0}, {10, 0, 0}), 1, 60.0, l);
  const Shape slow = shape_of(line({10, 0, 0}, {20, 0, 0}), 1, 30.0, l);
  EXPECT_EQ(junction(fast, slow, l).speed_mm_s, 30.0);
  EXPECT_EQ(junction(slow, fast, l).speed_mm_s, 30.0);
  EXPECT_FALSE(junction(fast, slow, l).by_tolerance);
  EXPECT_EQ(corner({0, 0, 0}, {10, 0, 0}, {0, 0, 0}, l).speed_mm_s, 0.0);
}

TEST(Junction, IsPassedAtTheSpeedOfTheArcWithinTheToleranceOrWithinTheShorterMove) {
  const Limits l = limits(even_machine());
  const double s = std::sqrt(0.5);  // of half the angle, 45 degrees
  const Junction by_tolerance = corner({0, 0, 0}, {100, 0, 0}, {100, 100, 0}, l);
  EXPECT_NEAR(by_tolerance.speed_mm_s, std::sqrt(l.turning_share * 500.0 * 0.05 * s / (1.0 - s)), kNear);
  EXPECT_TRUE(by_tolerance.by_tolerance);
  // Moves of 0.1 mm have room for an arc of half of that at a right angle.
  const Junction by_length = corner({0, 0, 0}, {100, 0, 0}, {100, 0.1, 0}, l);
  EXPECT_NEAR(by_length.speed_mm_s, std::sqrt(l.turning_share * 500.0 * 0.05), kNear);
  EXPECT_FALSE(by_length.by_tolerance);
}

TEST(Junction, WithoutToleranceIsAStop) {
  Limits l = limits();
  l.tolerance_mm = 0.0;
  const Junction j = corner({0, 0, 0}, {100, 0, 0}, {100, 100, 0}, l);
  EXPECT_EQ(j.speed_mm_s, 0.0);
  EXPECT_TRUE(j.by_tolerance);
}

TEST(JunctionProperty, IsTheSameBackwardsAndTurnedAndSlowerTheSharperItIs) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> at(-20.0, 20.0), angle(0.01, pi - 0.01);
  const Limits l = limits(even_machine());
  for (int i = 0; i < 500; ++i) {
    const Vec3 a{at(random), at(random), at(random)}, b{at(random), at(random), at(random)},
        c{at(random), at(random), at(random)};
    EXPECT_NEAR(corner(a, b, c, l).speed_mm_s, corner(c, b, a, l).speed_mm_s, kNear);
    const auto turned = [](Vec3 p) { return Vec3{p.z, -p.x, -p.y}; };
    EXPECT_NEAR(corner(a, b, c, l).speed_mm_s, corner(turned(a), turned(b), turned(c), l).speed_mm_s, kNear);
    const double less = angle(random), more = less + 0.5 * (pi - less);
    const auto by = [&](double t) {
      return corner({-50, 0, 0}, {0, 0, 0}, {50 * std::cos(t), 50 * std::sin(t), 0}, l).speed_mm_s;
    };
    EXPECT_GE(by(less), by(more) * (1.0 - kNear)) << less << " " << more;
  }
}

TEST(StopsBetween, RapidsAndFeedsAndAtEitherEndOfTapping) {
  CutterPath p;
  p.start({0, 0, 0});
  p.rapid({10, 0, 0});
  p.rapid({20, 0, 0});
  p.line({30, 0, 0}, MoveRole::kCut);
  p.line({40, 0, 0}, MoveRole::kCut);
  p.line({40, 0, -5}, MoveRole::kTap);
  p.line({40, 0, 0}, MoveRole::kCut);
  const std::vector<bool> expected{false, true, false, true, true};
  for (std::size_t i = 1; i + 1 < p.size(); ++i) EXPECT_EQ(stops_between(p, i, i + 1), expected[i - 1]) << i;
}

}  // namespace
}  // namespace capstan::motion
