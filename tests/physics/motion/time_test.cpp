#include "planner/physics/motion/time.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "planner/ground/base/job.h"
#include "planner/ground/base/stopping.h"
#include "planner/physics/motion/profile.h"

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
  f = feed(p, 50.0);
  f.feed_mm_min[1] = std::nan("");
  EXPECT_EQ(time_of(p, f, machine()).error().code, "MOT-FEED");
  f = feed(p, 50.0, std::nan(""));
  EXPECT_EQ(time_of(p, f, machine()).error().code, "MOT-NUMBER");
  for (const std::size_t i : {0U, 1U}) {
    CutterPath broken = p;
    broken.x[i] = std::nan("");
    EXPECT_EQ(time_of(broken, feed(p, 50.0), machine()).error().code, "MOT-NUMBER");
    EXPECT_EQ(reach_along(broken, machine()).error().code, "MOT-NUMBER");
  }
  p.dwell();
  f = feed(p, 50.0);
  f.dwell_s[2] = std::nan("");
  EXPECT_EQ(time_of(p, f, machine()).error().code, "MOT-NUMBER");
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

// --- Jerk -------------------------------------------------------------------------------------------

Machine with_jerk(double jerk_mm_s3, double tolerance_mm = 0.0) {
  Machine m = machine(tolerance_mm);
  for (auto& axis : m.axes) axis.jerk_mm_s3 = jerk_mm_s3;
  return m;
}

TEST(JerkTime, OfALongMoveIsTwoSCurvesAndAStretchBetween) {
  // v = 50, a = 500, j = 5000: a is just reached (a^2 / j = 50); each ramp 2 a / j = 0.2 s over 5 mm.
  const CutterPath p = straight(100.0);
  const auto t = time_of(p, feed(p, 50.0), with_jerk(5000.0));
  ASSERT_TRUE(t);
  EXPECT_NEAR(t->cutting_s, 0.2 + 90.0 / 50.0 + 0.2, 1e-9);
  EXPECT_NEAR(t->peak_mm_min[1], 3000.0, 1e-9);
  EXPECT_NEAR(t->at_top_s[1], 90.0 / 50.0, 1e-9);
}

TEST(JerkTime, OfAShortMoveIsFourPartsOfConstantJerk) {
  // Rest to rest without reaching a or v: T = 4 (L / 2 j)^(1/3).
  const CutterPath p = straight(0.5);
  const double jerk = 5000.0;
  const auto t = time_of(p, feed(p, 100.0), with_jerk(jerk));
  ASSERT_TRUE(t);
  EXPECT_NEAR(t->cutting_s, 4.0 * std::cbrt(0.5 / (2.0 * jerk)), 1e-7);
}

TEST(JerkTime, OfAStraightLineDoesNotDependOnHowManyBlocksItIsCutInto) {
  const CutterPath whole = straight(100.0);
  CutterPath pieces;
  pieces.start({0, 0, 0});
  for (int i = 1; i <= 1000; ++i) pieces.line({0.1 * i, 0, 0}, MoveRole::kCut);
  const auto a = time_of(whole, feed(whole, 80.0), with_jerk(20000.0));
  const auto b = time_of(pieces, feed(pieces, 80.0), with_jerk(20000.0));
  ASSERT_TRUE(a);
  ASSERT_TRUE(b);
  // The ramps end at block ends: at most one block on each side is run at other than the feed.
  EXPECT_NEAR(a->cutting_s, b->cutting_s, 2.0 * 0.1 / 80.0);
}

TEST(JerkTime, TendsToThatOfAccelerationAloneAsJerkGrows) {
  std::mt19937 random(9);
  std::uniform_real_distribution<double> at(-20.0, 20.0), how_fast(5.0, 100.0);
  for (int round = 0; round < 50; ++round) {
    CutterPath p;
    p.start({0, 0, 0});
    for (int i = 0; i < 40; ++i) p.line({at(random), at(random), 0.1 * at(random)}, MoveRole::kCut);
    FeedSchedule f = feed(p, 1.0);
    for (double& v : f.feed_mm_min) v = 60.0 * how_fast(random);
    const auto plain = time_of(p, f, machine(0.02));
    ASSERT_TRUE(plain);
    const auto stiff = time_of(p, f, with_jerk(1e12, 0.02));
    ASSERT_TRUE(stiff);
    EXPECT_NEAR(stiff->cutting_s, plain->cutting_s, 1e-4 * plain->cutting_s);
    double slower = plain->cutting_s * (1.0 - 1e-9);
    for (const double jerk : {1e6, 1e5, 2e4, 5e3}) {
      const auto t = time_of(p, f, with_jerk(jerk, 0.02));
      ASSERT_TRUE(t);
      EXPECT_GE(t->cutting_s, slower) << jerk;
      slower = t->cutting_s * (1.0 - 1e-3);
      for (std::size_t i = 1; i < p.size(); ++i) {
        EXPECT_LE(t->peak_mm_min[i], f.feed_mm_min[i] * (1.0 + 1e-9));
        EXPECT_GE(t->move_s[i] * f.feed_mm_min[i] / 60.0, model::move_length(p, i) * (1.0 - 1e-9));
      }
    }
  }
}

// --- What holds -------------------------------------------------------------------------------------

TEST(Time, TellsWhatHoldsEachMove) {
  CutterPath p;
  p.start({0, 0, 0});
  p.line({100, 0, 0}, MoveRole::kCut);                  // at its feed
  p.line({200, 0, 0}, MoveRole::kCut);                  // asks for more than the axes give
  p.arc({200, 2, 0}, {200, 1}, false, MoveRole::kCut);  // a tight arc
  FeedSchedule f = feed(p, 50.0);
  f.feed_mm_min[2] = f.feed_mm_min[3] = 60.0 * 300.0;
  const auto t = time_of(p, f, machine(0.01));
  ASSERT_TRUE(t);
  EXPECT_EQ(t->top[1], TopBy::kFeed);
  EXPECT_EQ(t->top[2], TopBy::kAxes);
  EXPECT_EQ(t->top[3], TopBy::kTurning);
  for (std::size_t i = 1; i < p.size(); ++i) EXPECT_LE(t->at_top_s[i], t->move_s[i]);
  EXPECT_EQ(t->corner_s, 0.0);
}

TEST(Time, CountsTheRampsOfCornersThatTheToleranceSlows) {
  CutterPath p;
  p.start({0, 0, 0});
  p.line({100, 0, 0}, MoveRole::kCut);
  p.line({100, 100, 0}, MoveRole::kCut);
  const auto t = time_of(p, feed(p, 50.0), machine(0.05));
  ASSERT_TRUE(t);
  const double s = std::sin(pi / 4.0);
  const double corner = std::sqrt(kNormalShare * kA * 0.05 * s / (1.0 - s));
  EXPECT_NEAR(t->corner_s, 2.0 * (50.0 - corner) / kA, 1e-9);
}

TEST(ReachAlong, SaysLengthSpeedAndWhetherAMoveIsEnteredInMotion) {
  CutterPath p;
  p.start({0, 0, 10});
  p.rapid({10, 0, 10});
  p.line({10, 0, 0}, MoveRole::kPlunge);
  p.line({60, 0, 0}, MoveRole::kCut);
  p.line({110, 0, 0}, MoveRole::kCut);
  const auto r = reach_along(p, machine(0.01));
  ASSERT_TRUE(r);
  ASSERT_EQ(r->size(), p.size());
  EXPECT_EQ((*r)[2].entry_mm_min, 0.0);  // after a rapid
  EXPECT_NEAR((*r)[4].entry_mm_min, 6000.0, 1e-9);
  EXPECT_NEAR((*r)[4].length_mm, 50.0, 1e-12);
  EXPECT_NEAR((*r)[4].most_mm_min, 6000.0, 1e-9);
  // v^2 = 2 a L + v1^2
  EXPECT_NEAR(braked_mm_min((*r)[4], 600.0), 60.0 * std::sqrt(100.0 + 2.0 * kA * 50.0), 1e-9);
  p.x[3] = std::nan("");
  EXPECT_EQ(reach_along(p, machine()).error().code, "MOT-NUMBER");
}

TEST(TimeProperty, MoreOfAnythingIsNeverSlowerOnStraightMoves) {
  std::mt19937 random(12);
  std::uniform_real_distribution<double> at(-20.0, 20.0), how_fast(5.0, 100.0);
  for (int round = 0; round < 60; ++round) {
    CutterPath p;
    p.start({0, 0, 0});
    for (int i = 0; i < 40; ++i) p.line({at(random), at(random), at(random)}, MoveRole::kCut);
    FeedSchedule f = feed(p, 1.0);
    for (double& v : f.feed_mm_min) v = 60.0 * how_fast(random);
    const Machine m = round % 2 == 0 ? machine(0.02) : with_jerk(3e4, 0.02);
    const double base = time_of(p, f, m)->cutting_s;
    FeedSchedule faster = f;
    faster.feed_mm_min[1 + random() % 40] *= 1.3;
    const double slack = round % 2 == 0 ? 1e-9 : 1e-3;  // with jerk, ramps end at the ends of moves
    EXPECT_LE(time_of(p, faster, m)->cutting_s, base * (1.0 + slack));
    Machine stronger = m;
    for (auto& axis : stronger.axes) axis.acceleration_mm_s2 *= 1.2;
    EXPECT_LE(time_of(p, f, stronger)->cutting_s, base * (1.0 + slack));
    Machine looser = m;
    looser.control.path_tolerance_mm *= 2.0;
    EXPECT_LE(time_of(p, f, looser)->cutting_s, base * (1.0 + slack));
  }
}

TEST(Time, AsksWhetherToStopAlongALongPath) {
  constexpr int kMoves = 200;  // one look comes at every 64th
  CutterPath p;
  p.start({0, 0, 0});
  for (int i = 1; i <= kMoves; ++i) p.line({static_cast<double>(i), 0, 0}, MoveRole::kCut);
  const FeedSchedule schedule = feed(p, 50.0);
  Job job;
  job.request_stop();
  const StopScope scope(job);
  EXPECT_THROW((void)time_of(p, schedule, machine()), Stopped);
  EXPECT_THROW((void)reach_along(p, machine()), Stopped);
}

}  // namespace
}  // namespace capstan::motion
