#include "planner/motion/time.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

namespace capstan::motion {
namespace {

using model::CutterPath;
using model::FeedSchedule;
using model::Machine;
using model::MoveRole;
using std::numbers::pi;

// 500 mm/s2 everywhere; rapids 12 m/min (200 mm/s), feeds to 6 m/min (100 mm/s).
constexpr double kA = 500.0;
constexpr double kRapid = 200.0;
constexpr double kNormalShare = 0.86602540378443864676;

Machine machine(double tolerance_mm = 0.0) {
  Machine m;
  for (std::size_t i = 0; i < 3; ++i) {
    m.axes[i] = {.name = std::string(1, static_cast<char>('X' + i)),
                 .rapid_mm_min = 60.0 * kRapid,
                 .feed_max_mm_min = 6000.0,
                 .acceleration_mm_s2 = kA,
                 .jerk_mm_s3 = {}};
  }
  m.control.path_tolerance_mm = tolerance_mm;
  m.spindle.rpm_max = 10000.0;
  m.spindle.spin_up_s = 2.0;
  return m;
}

FeedSchedule feed(const CutterPath& path, double mm_s, double rpm = 1000.0) {
  const std::size_t n = path.size();
  return {std::vector<double>(n, 60.0 * mm_s), std::vector<double>(n, rpm), std::vector<double>(n, 0.0)};
}

CutterPath straight(double length_mm) {
  CutterPath p;
  p.start({0, 0, 0});
  p.line({length_mm, 0, 0}, MoveRole::kCut);
  return p;
}

TEST(Time, OfALongMoveIsATrapezoid) {
  // Ramps of v/a = 0.1 s over v^2/2a = 2.5 mm each; 95 mm at 50 mm/s between them.
  const CutterPath p = straight(100.0);
  const auto t = time_of(p, feed(p, 50.0), machine());
  ASSERT_TRUE(t);
  EXPECT_NEAR(t->cutting_s, 0.1 + 95.0 / 50.0 + 0.1, 1e-12);
  EXPECT_NEAR(t->peak_mm_min[1], 3000.0, 1e-9);
  EXPECT_EQ(t->rapid_s, 0.0);
}

TEST(Time, OfAShortMoveIsATriangleThatNeverReachesTheFeed) {
  // 2 mm: 1 mm up, 1 mm down: t = 2 sqrt(L / a), peak sqrt(a L).
  const CutterPath p = straight(2.0);
  const auto t = time_of(p, feed(p, 100.0), machine());
  ASSERT_TRUE(t);
  EXPECT_NEAR(t->cutting_s, 2.0 * std::sqrt(2.0 / kA), 1e-12);
  EXPECT_NEAR(t->peak_mm_min[1] / 60.0, std::sqrt(kA * 2.0), 1e-9);
}

TEST(Time, OfAStraightLineDoesNotDependOnHowManyBlocksItIsCutInto) {
  const CutterPath whole = straight(100.0);
  CutterPath pieces;
  pieces.start({0, 0, 0});
  for (int i = 1; i <= 1000; ++i) pieces.line({0.1 * i, 0, 0}, MoveRole::kCut);
  const auto a = time_of(whole, feed(whole, 80.0), machine());
  const auto b = time_of(pieces, feed(pieces, 80.0), machine());
  ASSERT_TRUE(a);
  ASSERT_TRUE(b);
  EXPECT_NEAR(a->cutting_s, b->cutting_s, 1e-9);
}

TEST(Time, StopsAtASquareCornerWithoutTolerance) {
  CutterPath p;
  p.start({0, 0, 0});
  p.line({100, 0, 0}, MoveRole::kCut);
  p.line({100, 100, 0}, MoveRole::kCut);
  const auto t = time_of(p, feed(p, 50.0), machine());
  ASSERT_TRUE(t);
  EXPECT_NEAR(t->cutting_s, 2.0 * (0.2 + 95.0 / 50.0), 1e-9);
}

TEST(Time, PassesASquareCornerAtTheSpeedOfTheArcWithinTheTolerance) {
  // Half angle pi/4: R = P s / (1 - s), s = sin(pi/4); v = sqrt(0.866 a R).
  const double tolerance = 0.05;
  const double s = std::sin(pi / 4.0);
  const double corner = std::sqrt(kNormalShare * kA * tolerance * s / (1.0 - s));
  CutterPath p;
  p.start({0, 0, 0});
  p.line({100, 0, 0}, MoveRole::kCut);
  p.line({100, 100, 0}, MoveRole::kCut);
  const auto t = time_of(p, feed(p, 50.0), machine(tolerance));
  ASSERT_TRUE(t);
  const double v = 50.0;
  const double one = v / kA + (v - corner) / kA + (100.0 - (2.0 * v * v - corner * corner) / (2.0 * kA)) / v;
  EXPECT_NEAR(t->cutting_s, 2.0 * one, 1e-9);
}

TEST(Time, StopsWhereThePathTurnsBack) {
  CutterPath p;
  p.start({0, 0, 0});
  p.line({100, 0, 0}, MoveRole::kCut);
  p.line({0, 0, 0}, MoveRole::kCut);
  const auto t = time_of(p, feed(p, 50.0), machine(0.1));
  ASSERT_TRUE(t);
  EXPECT_NEAR(t->cutting_s, 2.0 * (0.2 + 95.0 / 50.0), 1e-9);
}

TEST(Time, OfAnArcIsHeldByItsCentripetalAcceleration) {
  // R = 1 mm: v = sqrt(0.866 * 500) = 20.8 mm/s although 100 is asked; ramps with half the acceleration.
  CutterPath p;
  p.start({1, 0, 0});
  p.arc({1, 0, 0}, {0, 0}, false, MoveRole::kCut);
  const auto t = time_of(p, feed(p, 100.0), machine());
  ASSERT_TRUE(t);
  const double v = std::sqrt(kNormalShare * kA);
  EXPECT_NEAR(t->peak_mm_min[1] / 60.0, v, 1e-9);
  EXPECT_NEAR(t->cutting_s, 2.0 * v / (0.5 * kA) + (2.0 * pi - v * v / (0.5 * kA)) / v, 1e-9);
}

TEST(Time, PassesFromALineIntoATangentArcAtTheArcsSpeed) {
  CutterPath p;
  p.start({-100, 1, 0});
  p.line({0, 1, 0}, MoveRole::kCut);
  p.arc({0, -1, 0}, {0, 0}, true, MoveRole::kCut);
  p.line({-100, -1, 0}, MoveRole::kCut);
  const auto t = time_of(p, feed(p, 100.0), machine());
  ASSERT_TRUE(t);
  const double v = std::sqrt(kNormalShare * kA);
  EXPECT_NEAR(t->move_s[2], pi / v, 1e-9);  // constant speed all along
}

TEST(Time, OfAFineChordPolygonApproachesThatOfTheArc) {
  CutterPath arc;
  arc.start({50, 0, 0});
  arc.arc({50, 0, 0}, {0, 0}, false, MoveRole::kCut);
  CutterPath chords;
  chords.start({50, 0, 0});
  for (int i = 1; i <= 720; ++i) {
    chords.line({50 * std::cos(pi * i / 360), 50 * std::sin(pi * i / 360), 0}, MoveRole::kCut);
  }
  const auto a = time_of(arc, feed(arc, 60.0), machine(0.01));
  const auto b = time_of(chords, feed(chords, 60.0), machine(0.01));
  ASSERT_TRUE(a);
  ASSERT_TRUE(b);
  EXPECT_NEAR(a->cutting_s, b->cutting_s, 0.01 * a->cutting_s);
}

TEST(Time, OfARapidIsThatOfItsSlowestAxis) {
  Machine m = machine();
  m.axes[2].rapid_mm_min = 60.0 * 20.0;  // Z: 20 mm/s, 100 mm/s2
  m.axes[2].acceleration_mm_s2 = 100.0;
  CutterPath p;
  p.start({0, 0, 0});
  p.rapid({30, 0, 40});  // Z carries 40 of 50 mm: 25 mm/s and 125 mm/s2 along the path
  const auto t = time_of(p, feed(p, 1.0), m);
  ASSERT_TRUE(t);
  EXPECT_NEAR(t->rapid_s, 2.0 * 25.0 / 125.0 + (50.0 - 25.0 * 25.0 / 125.0) / 25.0, 1e-12);
  EXPECT_EQ(t->cutting_s, 0.0);
}

TEST(Time, StopsBetweenRapidAndFeedAtDwellsAndAtChangesOfSpeed) {
  const auto at_rest = [](double mm) { return 0.1 + (mm - 5.0) / 50.0 + 0.1; };
  CutterPath p;
  p.start({0, 0, 0});
  p.line({100, 0, 0}, MoveRole::kCut);
  p.dwell();
  p.line({200, 0, 0}, MoveRole::kCut);
  p.line({300, 0, 0}, MoveRole::kCut);  // at another spindle speed
  p.rapid({400, 0, 0});
  FeedSchedule f = feed(p, 50.0);
  f.dwell_s[2] = 0.7;
  f.spindle_rpm = {1000, 1000, 1000, 1000, 3500, 3500};
  const auto t = time_of(p, f, machine(0.1));
  ASSERT_TRUE(t);
  EXPECT_NEAR(t->cutting_s, 3.0 * at_rest(100.0), 1e-9);
  EXPECT_NEAR(t->dwell_s, 0.7, 1e-12);
  EXPECT_NEAR(t->spindle_s, 2.0 * 2500.0 / 10000.0, 1e-12);
  EXPECT_NEAR(t->rapid_s, 2.0 * kRapid / kA + (100.0 - kRapid * kRapid / kA) / kRapid, 1e-9);
}

TEST(Time, KeepsALeastTimePerBlock) {
  Machine m = machine();
  m.control.block_time_s = 0.01;
  CutterPath p;
  p.start({0, 0, 0});
  for (int i = 1; i <= 1000; ++i) p.line({0.1 * i, 0, 0}, MoveRole::kCut);
  const auto t = time_of(p, feed(p, 100.0), m);  // 0.1 mm in 10 ms: 10 mm/s, not 100
  ASSERT_TRUE(t);
  EXPECT_NEAR(t->cutting_s, 100.0 / 10.0 + 10.0 / kA, 1e-9);
}

TEST(Time, IgnoresMovesWithoutLength) {
  CutterPath p;
  p.start({0, 0, 0});
  p.line({50, 0, 0}, MoveRole::kCut);
  p.line({50, 0, 0}, MoveRole::kCut);
  p.line({100, 0, 0}, MoveRole::kCut);
  const CutterPath whole = straight(100.0);
  const auto a = time_of(p, feed(p, 50.0), machine());
  const auto b = time_of(whole, feed(whole, 50.0), machine());
  ASSERT_TRUE(a);
  EXPECT_NEAR(a->cutting_s, b->cutting_s, 1e-9);
  EXPECT_EQ(a->move_s[2], 0.0);
}

TEST(Time, NamesWhatItCannotTime) {
  CutterPath p = straight(10.0);
  FeedSchedule f = feed(p, 50.0);
  f.feed_mm_min[1] = 0.0;
  EXPECT_EQ(time_of(p, f, machine()).error().code, "MOT-FEED");
  EXPECT_EQ(time_of(p, {}, machine()).error().code, "MOT-SCHEDULE");
  EXPECT_EQ(time_of(p, feed(p, 50.0), Machine{}).error().code, "MOT-MACHINE");
  p.x[1] = std::nan("");
  EXPECT_EQ(time_of(p, feed(p, 50.0), machine()).error().code, "MOT-NUMBER");
}

TEST(TimeProperty, NoRandomPathBreaksASpeedOrIsFasterThanItsLengthAllows) {
  std::mt19937 random(20261121);
  std::uniform_real_distribution<double> at(-20.0, 20.0), how_fast(1.0, 100.0);
  for (int round = 0; round < 200; ++round) {
    CutterPath p;
    p.start({at(random), at(random), at(random)});
    for (int i = 0; i < 50; ++i) {
      if (random() % 4 == 0) {
        p.rapid({at(random), at(random), at(random)});
      } else {
        p.line({at(random), at(random), at(random)}, MoveRole::kCut);
      }
    }
    FeedSchedule f = feed(p, 1.0);
    for (double& v : f.feed_mm_min) v = 60.0 * how_fast(random);
    const auto t = time_of(p, f, machine(0.02));
    ASSERT_TRUE(t);
    for (std::size_t i = 1; i < p.size(); ++i) {
      const double peak = t->peak_mm_min[i] / 60.0;
      const double limit = p.kind[i] == model::MoveKind::kRapid ? 1e9 : f.feed_mm_min[i] / 60.0;
      EXPECT_LE(peak, limit + 1e-9);
      EXPECT_GE(t->move_s[i] * peak, model::move_length(p, i) * (1 - 1e-9));
      // From rest to rest is the slowest way to run a move.
      const double rest =
          std::sqrt(4.0 * model::move_length(p, i) / kA) + model::move_length(p, i) / (peak + 1e-9);
      EXPECT_LE(t->move_s[i], rest + 1e-9);
    }
  }
}

TEST(PlanTime, CountsToolChangesSpinUpsAndTheWayBetweenSteps) {
  model::Plan plan;
  plan.machine = machine();
  plan.machine.tool_change_s = 6.0;
  plan.setups.push_back({.setup = {}, .work_offset = "G54", .security_z_mm = 20.0});
  auto path = std::make_shared<CutterPath>();
  path->start({0, 0, 10});
  path->line({100, 0, 10}, MoveRole::kCut);
  for (const char* cutter : {"a", "a", "b"}) {
    model::StepResult step;
    step.cutter_id = cutter;
    step.path = path;
    step.spindle_rpm = 5000.0;
    step.feed_mm_min = 3000.0;
    plan.steps.push_back(step);
  }
  const auto t = time_of(plan);
  ASSERT_TRUE(t) << to_text(t.error());
  EXPECT_EQ(t->tool_changes, 2);
  EXPECT_EQ(t->tool_change_s, 12.0);
  EXPECT_NEAR(t->spin_up_s, 4.0, 1e-12);  // two starts and two stops of 1 s each: 5000 of 10000, 2 s
  EXPECT_NEAR(t->cutting_s, 3.0 * 2.1, 1e-9);
  // 10 mm up, 100 mm back, 10 mm down, stopping at each corner (no tolerance).
  const double ten = 2.0 * std::sqrt(10.0 / kA);
  EXPECT_NEAR(t->link_s, 2.0 * ten + 2.0 * kRapid / kA + (100.0 - kRapid * kRapid / kA) / kRapid, 1e-9);
}

}  // namespace
}  // namespace capstan::motion
