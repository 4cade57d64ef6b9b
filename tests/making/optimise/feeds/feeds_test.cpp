#include "planner/making/optimise/feeds.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "planner/physics/mechanics/force/immersion.h"
#include "tests/making/optimise/feeds/examples.h"

namespace capstan::optimise {
namespace {

using examples::cut_along;
using examples::cutting_s;
using examples::question;
using examples::straight;
using model::CutterPath;
using model::MoveRole;

double feed_of(const FeedQuestion& q, double ap, double ae) {
  FeedQuestion asked = q;
  const CutterPath p = straight();
  cut_along(asked, p, 1, ap, ae);
  return feeds(asked, p).schedule.feed_mm_min[1];
}

TEST(Feeds, OfAThinLightCutIsThatOfTheSameLargestChip) {
  // ae = 0.05 D: the chip is 2 sqrt(r (1 - r)) = 0.4359 of the feed per tooth; 0.05 mm at 4 x 4000 1/min.
  const double expected = 0.05 / mechanics::max_chip_thickness_mm(1.0, 0.5, 10.0) * 16000.0;
  const double feed = feed_of(question(), 1.0, 0.5);
  EXPECT_LE(feed, expected);
  EXPECT_GT(feed, 0.98 * expected);  // sections are taken 1 to 2 % heavier
}

TEST(Feeds, OfAHalfImmersedLightCutIsThatOfTheChip) {
  const double feed = feed_of(question(), 0.5, 5.0);
  EXPECT_NEAR(feed, 800.0, 1.0);
}

/// A layer of a ball on a slope, by its section; `chip_over_feed` 0: the chip is not measured.
model::FeedSchedule over_a_slope(double chip_over_feed) {
  FeedQuestion q = question();
  q.cut.kind = CutKind::kFinish;
  q.cut.as_measured = true;
  q.cut.cutter.cutter_class = model::CutterClass::kBallEndmill;
  const CutterPath p = straight();
  // Of 0.1 mm over a width of 1.3 mm, high on the ball: more area than a strip from the tip up has.
  q.samples = {{.move = 1,
                .ap_mm = 0.1,
                .ae_mm = 1.3,
                .at_mm = 100.0,
                .step_mm = 100.0,
                .entry_rad = 1.45,
                .exit_rad = 1.72,
                .csa_mm2 = 0.13,
                .top_mm = 1.8,
                .chip_over_feed = chip_over_feed}};
  return feeds(q, p).schedule;
}

TEST(Feeds, OfABallOnASlopeAreThoseOfTheChipThatWasMeasured) {
  // 0.05 mm at 4 x 4000 1/min; shares of the feed are rounded up by 1 / 128.
  EXPECT_NEAR(over_a_slope(0.5).feed_mm_min[1], 2.0 * 800.0, 0.03 * 1600.0);
  EXPECT_NEAR(over_a_slope(1.0).feed_mm_min[1], 800.0, 0.03 * 800.0);
  // Where nobody looked, by the section's height and arc.
  EXPECT_LT(over_a_slope(0.0).feed_mm_min[1], over_a_slope(0.5).feed_mm_min[1]);
}

TEST(Feeds, GoNoFasterThanTheBoundOfThinning) {
  EXPECT_NEAR(feed_of(question(), 0.5, 0.01), kMostThinning * 800.0, 0.1);
}

TEST(Feeds, OfFinishingAreNeverFasterThanPlannedUnlessASurfaceBoundsThem) {
  FeedQuestion q = question();
  q.cut.kind = CutKind::kFinish;
  EXPECT_NEAR(feed_of(q, 1.0, 0.2), 800.0, 0.1);
  q.cut.surface_ra_um = 0.8;
  const double feed = feed_of(q, 1.0, 0.2);
  EXPECT_GT(feed, 1000.0);
  // Ra = 1.24 * 0.2566 fz^2 / (4 D)
  const double fz = feed / 16000.0;
  EXPECT_LE(1000.0 * 1.24 * 0.2566 * fz * fz / 40.0, 0.8 * 1.001);
}

TEST(Feeds, GoSlowerWhereTheForceWouldBendTheTool) {
  FeedQuestion q = question();
  q.cut.deflection_limit_mm = 0.02;
  const double heavy = feed_of(q, 8.0, 8.0);
  const double light = feed_of(q, 4.0, 4.0);
  EXPECT_LT(heavy, light);
  EXPECT_LT(heavy, 500.0);
}

TEST(Feeds, KeepAnAllowedForceAndSayThatItHolds) {
  FeedQuestion q = question();
  q.cut.peak_force_limit_n = 600.0;
  const CutterPath p = straight();
  cut_along(q, p, 1, 5.0, 5.0);
  const auto a = feeds(q, p);
  EXPECT_LE(a.peak.peak_force_n, 600.0 * (1 + 1e-6));
  EXPECT_GT(a.peak.peak_force_n, 590.0);
  ASSERT_FALSE(a.held_by.empty());
  EXPECT_EQ(a.held_by.front().name, "peak_force");
  EXPECT_NEAR(a.held_by.front().limit, 600.0, 1e-9);
  EXPECT_GT(a.held_by.front().share, 0.9);
  // F ~ f^(1 - mc): 10 % more force is 1.1^(1 / 0.78) more feed; the move is long.
  const double t = cutting_s(q, p, a.schedule);
  EXPECT_NEAR(a.held_by.front().saves_s, t * (1.0 - std::pow(1.1, -1.0 / 0.78)), 0.02 * t);
  EXPECT_LE(a.worst_excess, 1e-6);
}

TEST(Feeds, OfAGivenFeedAreExecutedAsGiven) {
  FeedQuestion q = question();
  q.adapt = false;
  q.feed_mm_min = 1234.5;
  const CutterPath p = straight();
  cut_along(q, p, 1, 8.0, 10.0);
  const auto a = feeds(q, p);
  EXPECT_EQ(a.schedule.feed_mm_min[1], 1234.5);
  EXPECT_GT(a.worst_excess, 0.0);
}

TEST(Feeds, OfAGivenFeedAreNeverRaisedByThePath) {
  FeedQuestion q = question();
  q.adapt = false;
  q.feed_mm_min = 500.0;
  const CutterPath p = straight();
  for (const double factor : {4.0, 1.0, 0.25}) {  // the way back of a T-slot cutter asks for four times
    q.feed_factor.assign(p.size(), factor);
    EXPECT_EQ(feeds(q, p).schedule.feed_mm_min[1], std::min(factor, 1.0) * 500.0);
  }
}

TEST(Feeds, OfPlungesAreAFractionAtMost) {
  FeedQuestion q = question();
  CutterPath p;
  p.start({0, 0, 10});
  p.line({0, 0, 0}, MoveRole::kPlunge);
  p.line({20, 0, -1}, MoveRole::kRamp);
  cut_along(q, p, 2, 0.5, 1.0);
  const auto a = feeds(q, p);
  EXPECT_LE(a.schedule.feed_mm_min[1], kPlungeFraction * 800.0);
  EXPECT_GT(a.schedule.feed_mm_min[1], 0.0);
  // In something very hard the plunge is slower than its fraction: torque and power hold it.
  q.cut.machine.spindle.curve = {{60, 100, 0}, {10000, 300, 0}};
  EXPECT_LT(feeds(q, p).schedule.feed_mm_min[1], 0.5 * kPlungeFraction * 800.0);
}

/// A ramp that falls by `fall` over 20 mm, with a shallow slot along it, and its feed.
double feed_on_a_ramp(FeedQuestion q, double fall_mm) {
  CutterPath p;
  p.start({0, 0, 0});
  p.line({20, 0, -fall_mm}, MoveRole::kRamp);
  cut_along(q, p, 1, 0.5, 10.0);
  return feeds(q, p).schedule.feed_mm_min[1];
}

TEST(Feeds, OfRampsAreThreeQuartersOfASlotsForEdgesThatReachTheCentreAndHalfForOthers) {
  FeedQuestion q = question();
  constexpr double kSlot = 800.0;
  q.cut.cutter.maximum_ramp_angle_rad = 0.2;
  q.cut.cutter.centre_cutting = true;
  EXPECT_NEAR(feed_on_a_ramp(q, 1.0), 0.75 * kSlot, 1.0);
  q.cut.cutter.centre_cutting = false;
  EXPECT_NEAR(feed_on_a_ramp(q, 1.0), 0.5 * kSlot, 1.0);
}

TEST(Feeds, OfSteepRampsKeepTheChipOfTheEndsEdgesAtThatOfAPlunge) {
  FeedQuestion q = question();
  q.cut.cutter.maximum_ramp_angle_rad = 0.8;
  q.cut.cutter.centre_cutting = true;
  for (const double fall : {1.0, 5.0, 10.0, 15.0}) {
    const double sine = fall / std::hypot(20.0, fall);
    EXPECT_LE(feed_on_a_ramp(q, fall) * sine, kPlungeFraction * 800.0 + 0.1) << fall;
  }
}

// In titanium an edge of carbide asks for 0.008 mm: 4 x 4000 x 0.008 = 128 mm/min, and the step's feed is
// 160.
TEST(Feeds, OfRampsAreNotBelowTheThinnestChip) {
  FeedQuestion q = question();
  q.cut.material.iso_group = "S";
  q.cut.cutter.substrate = model::Substrate::kCarbide;
  q.cut.fz_start_mm = 0.01;
  q.feed_mm_min = 160.0;
  q.cut.cutter.maximum_ramp_angle_rad = 0.1;  // its edges do not reach the centre: half the feed
  CutterPath p;
  p.start({0, 0, 0});
  p.line({20, 0, -1}, MoveRole::kRamp);
  cut_along(q, p, 1, 0.5, 1.0);
  EXPECT_NEAR(feeds(q, p).schedule.feed_mm_min[1], 128.0, 0.1);
  q.feed_mm_min = 100.0;  // meant to be thinner
  EXPECT_NEAR(feeds(q, p).schedule.feed_mm_min[1], 100.0, 0.1);
}

TEST(Feeds, WithoutSectionsAreNeverFasterThanPlanned) {
  const CutterPath p = straight();
  EXPECT_EQ(feeds(question(), p).schedule.feed_mm_min[1], 800.0);
}

TEST(Feeds, BrakeBeforeAHeavySection) {
  FeedQuestion q = question();
  q.cut.machine = examples::machine(20.0);  // very slow to brake
  q.cut.peak_force_limit_n = 500.0;
  CutterPath p;
  p.start({0, 0, 0});
  for (int i = 1; i <= 4; ++i) p.line({1.0 * i, 0, 0}, MoveRole::kCut);
  p.line({40, 0, 0}, MoveRole::kCut);
  for (std::uint32_t i = 1; i <= 4; ++i) cut_along(q, p, i, 1.0, 0.5);
  cut_along(q, p, 5, 8.0, 6.0);
  q.group_ratio = 0.0;
  const auto a = feeds(q, p);
  for (std::size_t i = 1; i + 1 < p.size(); ++i) {
    const double v = a.schedule.feed_mm_min[i] / 60.0;
    const double next = a.schedule.feed_mm_min[i + 1] / 60.0;
    EXPECT_LE(v * v, next * next + 2.0 * 20.0 * 1.0 + 1e-6) << i;
  }
}

TEST(Feeds, OfNeighboursWithinTheRatioAreOne) {
  FeedQuestion q = question();
  q.cut.peak_force_limit_n = 600.0;
  CutterPath p;
  p.start({0, 0, 0});
  for (int i = 1; i <= 50; ++i) {
    p.line({10.0 * i, 0, 0}, MoveRole::kCut);
    cut_along(q, p, static_cast<std::uint32_t>(i), 5.0, 5.0 + 0.002 * (i % 7));
  }
  const auto a = feeds(q, p);
  for (std::size_t i = 2; i < p.size(); ++i) EXPECT_EQ(a.schedule.feed_mm_min[i], a.schedule.feed_mm_min[1]);
}

TEST(Feeds, OfSectionsOutsideTheFormulasAreTheLeast) {
  FeedQuestion q = question();
  q.cut.material.kc11_n_mm2 = std::nan("");
  const CutterPath p = straight();
  cut_along(q, p, 1, 5.0, 5.0);
  const auto a = feeds(q, p);
  // Four teeth of 10 mm carbide at 4000 1/min: chips of 0.3 x 0.008 mm are 38.4 mm/min; a 25th of 800 is 32.
  EXPECT_NEAR(a.schedule.feed_mm_min[1], 38.4, 0.1);
}

TEST(Feeds, AreNeverSaidToBeHeldByALimitThatNobodyStates) {
  FeedQuestion q = question();
  q.cut.material.kc11_n_mm2 = std::nan("");  // no load can be told
  const CutterPath p = straight();
  cut_along(q, p, 1, 5.0, 5.0);
  const auto a = feeds(q, p);
  ASSERT_FALSE(a.held_by.empty());
  EXPECT_EQ(a.held_by.front().name, "least_feed");
  for (const auto& h : a.held_by) EXPECT_LT(h.limit, 1e6) << h.name;
}

TEST(Feeds, OfHeavierCutsThanTheLeastFeedBearsSaySo) {
  FeedQuestion q = question();
  q.cut.peak_force_limit_n = 1.0;
  const CutterPath p = straight();
  cut_along(q, p, 1, 8.0, 8.0);
  const auto a = feeds(q, p);
  EXPECT_GT(a.worst_excess, 1.0);
  EXPECT_NEAR(a.schedule.feed_mm_min[1], 38.4, 0.1) << "and no less: there the edge would rub";
}

TEST(Feeds, NameTheLimitThatIsExceededMostWithItsNumbersAndPlace) {
  FeedQuestion q = question();
  q.cut.peak_force_limit_n = 1.0;
  CutterPath p;
  p.start({0, 0, 0});
  p.line({100, 0, 0}, MoveRole::kCut);
  p.line({100, 50, 0}, MoveRole::kCut);
  // Shallow along the first move, deep from 10 mm on the second: its first millimetre there is worst.
  cut_along(q, p, 1, 0.5, 1.0);
  cut_along(q, p, 2, 8.0, 8.0, 10.0);
  const auto a = feeds(q, p);
  EXPECT_EQ(a.worst.name, "peak_force");
  EXPECT_EQ(a.worst.unit, "N");
  EXPECT_EQ(a.worst.limit, 1.0);
  EXPECT_NEAR(a.worst.value / a.worst.limit - 1.0, a.worst_excess, 1e-12);
  ASSERT_TRUE(a.worst.at_mm);
  EXPECT_NEAR(a.worst.at_mm->x, 100.0, 1e-9);
  EXPECT_NEAR(a.worst.at_mm->y, 11.0, 1e-9);
}

TEST(Feeds, StayWithinWhatOneAxisDoesEvenWhereTwoShareTheWay) {
  FeedQuestion q = question();
  for (auto& axis : q.cut.machine.axes) axis.feed_max_mm_min = 700.0;
  CutterPath p;
  p.start({0, 0, 0});
  p.line({50, 50, 0}, MoveRole::kCut);
  cut_along(q, p, 1, 1.0, 0.5);
  const auto a = feeds(q, p);
  EXPECT_EQ(a.schedule.feed_mm_min[1], 700.0);
  ASSERT_FALSE(a.held_by.empty());
  EXPECT_EQ(a.held_by.front().name, "axis_feed");
}

TEST(Feeds, OfAMoveWithoutLengthStayWithinWhatOneAxisDoes) {
  // A path over a surface ends a row where the next begins: such a move has no way to tell its axis by.
  FeedQuestion q = question();
  for (auto& axis : q.cut.machine.axes) axis.feed_max_mm_min = 900.0;
  CutterPath p;
  p.start({0, 0, 0});
  p.line({50, 0, 0}, MoveRole::kCut);
  p.line({50, 0, 0}, MoveRole::kCut);
  p.line({100, 0, 0}, MoveRole::kCut);
  cut_along(q, p, 1, 0.5, 0.5);
  for (const double feed : feeds(q, p).schedule.feed_mm_min) EXPECT_LE(feed, 900.0);
}

TEST(Feeds, OfNumbersThatAreNoneAreFeedsStill) {
  const double nan = std::nan("");
  const double infinity = std::numeric_limits<double>::infinity();
  for (const double bad : {nan, infinity, -1.0, 0.0}) {
    FeedQuestion q = question();
    CutterPath p = straight();
    for (int k = 0; k < 6; ++k) {
      CutSample s = examples::down_cut(1, 10.0 * k + 10.0, 10.0, 2.0, 2.0);
      (k == 0   ? s.ap_mm
       : k == 1 ? s.ae_mm
       : k == 2 ? s.csa_mm2
       : k == 3 ? s.entry_rad
       : k == 4 ? s.exit_rad
                : s.step_mm) = bad;
      q.samples.push_back(s);
    }
    split_moves(q, p, nullptr);
    const auto a = feeds(q, p);
    ASSERT_EQ(a.schedule.feed_mm_min.size(), p.size());
    for (std::size_t i = 1; i < p.size(); ++i) {
      EXPECT_TRUE(std::isfinite(a.schedule.feed_mm_min[i]));
      EXPECT_GT(a.schedule.feed_mm_min[i], 0.0);
      EXPECT_LE(a.schedule.feed_mm_min[i], kMostThinning * 800.0);
    }
    EXPECT_TRUE(std::isfinite(a.peak.peak_force_n));
  }
}

TEST(Feeds, KeepAWallErrorWhereItIsLimited) {
  FeedQuestion q = question();
  q.cut.kind = CutKind::kFinish;
  q.cut.wall_error_limit_mm = 0.01;
  const CutterPath p = straight();
  cut_along(q, p, 1, 10.0, 0.5);
  const auto a = feeds(q, p);
  EXPECT_LE(std::abs(a.peak.wall_error_mm), 0.01 * (1.0 + 1e-9));
  FeedQuestion tight = q;
  tight.cut.wall_error_limit_mm = 0.5 * std::abs(a.peak.wall_error_mm);
  EXPECT_LT(feeds(tight, p).schedule.feed_mm_min[1], a.schedule.feed_mm_min[1]);
}

TEST(Feeds, OfAnEmptyPathAreNone) {
  const CutterPath p;
  EXPECT_TRUE(feeds(question(), p).schedule.feed_mm_min.empty());
}

}  // namespace
}  // namespace capstan::optimise
