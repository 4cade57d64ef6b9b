// What the sections mean for cutters of either hand, balls, plunges and overrides.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "planner/making/optimise/cut/limits.h"
#include "planner/making/optimise/feeds.h"
#include "planner/model/plan/cutter/ramp.h"
#include "planner/model/plan/resources/specific_force.h"
#include "planner/physics/mechanics/bending/beam.h"
#include "planner/physics/mechanics/constants.h"
#include "planner/physics/mechanics/force/force_law.h"
#include "planner/physics/mechanics/force/kienzle.h"
#include "planner/physics/mechanics/loads/section.h"
#include "tests/making/optimise/cut/questions.h"
#include "tests/making/optimise/feeds/examples.h"

namespace capstan::optimise {
namespace {

using examples::cut_along;
using examples::question;
using examples::straight;
using model::CutterPath;
using model::MoveRole;
using std::numbers::pi;

CutterPath down(MoveRole role) {
  CutterPath p;
  p.start({0, 0, 0});
  p.line({0, 0, -5}, role);
  p.line({50, 0, -5}, MoveRole::kCut);
  return p;
}

model::MechanisticSet measured_set() {
  return {.substrate = "carbide",
          .ktc_n_mm2 = 800.0,
          .kte_n_mm = 20.0,
          .krc_n_mm2 = 170.0,
          .kre_n_mm = 20.0,
          .kac_n_mm2 = 220.0,
          .kae_n_mm = 1.0,
          .uncertainty = 0.2,
          .source = "made up for this test"};
}

// The helix of a right-hand cutter lifts the chip, and so is pulled into the work: the force on the cutter
// points towards the work, which the model counts as negative.
TEST(AxisForces, OfAHelixPullTheCutterTowardsTheWork) {
  FeedQuestion q = question();
  q.cut.material.mechanistic = {measured_set()};
  const CutterPath p = straight();
  cut_along(q, p, 1, 3.0, 3.0);
  const auto a = feeds(q, p);
  EXPECT_LT(a.peak.mean_force.z_n, 0.0);
  EXPECT_LT(a.peak.peak_force.z_n, 0.0);
  const auto l = loads_of(q.cut, 3.0, 3.0, 4000.0, 800.0);
  ASSERT_TRUE(l);
  EXPECT_LT(l->mean_force.z_n, 0.0);
}

// The flat part of a ball's edge presses it away from the work.
TEST(AxisForces, OfAShallowBallPressItAwayFromTheWork) {
  CutQuestion q = question().cut;
  q.cutter.cutter_class = model::CutterClass::kBallEndmill;
  q.material.mechanistic = {measured_set()};
  const auto l = loads_of(q, 0.2, 0.5, 4000.0, 800.0);
  ASSERT_TRUE(l);
  EXPECT_GT(l->mean_force.z_n, 0.0);
}

// A wall at the right is climbed by a clockwise cutter; the same wall is cut upwards by one of the other
// hand.
TEST(AxisForces, OfALeftHandCutterAreTheMirrorImage) {
  FeedQuestion right = question();
  const CutterPath p = straight();
  cut_along(right, p, 1, 3.0, 3.0);
  FeedQuestion left = right;
  left.cut.cutter.hand = model::Hand::kLeft;
  left.n_rpm = -left.n_rpm;
  for (CutSample& s : left.samples)
    s = [&] {
      CutSample m = s;
      m.entry_rad = pi - s.exit_rad;
      m.exit_rad = pi - s.entry_rad;
      return m;
    }();
  const auto a = feeds(right, p).peak;
  const auto b = feeds(left, p).peak;
  EXPECT_NEAR(b.mean_force.x_n, a.mean_force.x_n, 1e-6 * std::abs(a.mean_force.x_n));
  EXPECT_NEAR(b.mean_force.y_n, -a.mean_force.y_n, 1e-6 * std::abs(a.mean_force.y_n));
  EXPECT_NEAR(b.mean_force.z_n, a.mean_force.z_n, 1e-6 * std::abs(a.mean_force.z_n));
  // Down milling presses the cutter off the wall at its right, to the left.
  EXPECT_GT(a.mean_force.y_n, 0.0);
  EXPECT_LT(b.mean_force.y_n, 0.0);
}

TEST(Feeds, OfABallHaveThePowerThatTheAreaNeeds) {
  FeedQuestion q = question();
  q.cut.cutter.cutter_class = model::CutterClass::kBallEndmill;
  q.cut.cutter.corner_radius_mm = 5.0;
  q.cut.material.mechanistic = {measured_set()};
  const CutterPath p = straight();
  // The strip that the ball meets at 0.5 mm depth: 2 mm about 1 mm to the right.
  CutSample s{.move = 1, .ap_mm = 0.5, .ae_mm = 2.0, .at_mm = 100.0, .step_mm = 100.0};
  s.entry_rad = std::acos(0.0);
  s.exit_rad = std::acos(-0.4);
  s.csa_mm2 = 0.5;
  q.samples = {s};
  const auto a = feeds(q, p);
  const double margin = mechanics::force_margin(q.cut.material, q.cut.cutter.substrate).factor();
  EXPECT_GE(a.peak.power_w,
            0.99 * margin * mechanics::cutting_power_w(0.5 * a.schedule.feed_mm_min[1], 800.0));
  // The chip of the steepest edge in contact, sin(kappa) 0.436 of the feed.
  EXPECT_GE(a.peak.chip_thickness_mm, 0.3 * a.schedule.feed_mm_min[1] / 16000.0);
}

TEST(Feeds, OfACutThatABallMakesAreThoseOfItsArea) {
  CutQuestion q = question().cut;
  q.cutter.cutter_class = model::CutterClass::kBallEndmill;
  q.cutter.corner_radius_mm = 5.0;
  q.material.mechanistic = {measured_set()};
  const double margin = mechanics::force_margin(q.material, q.cutter.substrate).factor();
  struct {
    double ap, ae;
  } const cuts[] = {{0.5, 2.0}, {1.0, 1.0}, {0.3, 0.4}};
  for (const auto& c : cuts) {
    const auto l = loads_of(q, c.ap, c.ae, 4000.0, 800.0);
    ASSERT_TRUE(l);
    EXPECT_GE(l->power_w, 0.99 * margin * mechanics::cutting_power_w(c.ap * c.ae * 800.0, 800.0));
    EXPECT_GT(l->chip_thickness_mm, 0.0);
    EXPECT_GT(l->deflection_mm, 0.0);
  }
}

TEST(Feeds, OfAMoveStraightDownArePlungesWhateverItIsCalled) {
  for (const bool measured : {false, true}) {
    FeedQuestion q = question();
    const CutterPath p = down(MoveRole::kCut);
    if (measured)
      q.samples = {{.move = 1, .ap_mm = 5.0, .ae_mm = 10.0, .plunge = true, .at_mm = 5.0, .step_mm = 5.0}};
    const auto a = feeds(q, p);
    EXPECT_LE(a.schedule.feed_mm_min[1], kPlungeFraction * q.feed_mm_min);
    q.constant = true;
    EXPECT_LE(feeds(q, p).schedule.feed_mm_min[1], kPlungeFraction * q.feed_mm_min);
  }
}

TEST(Feeds, TellAPlungeThatExceedsThePower) {
  FeedQuestion q = question();
  const CutterPath p = down(MoveRole::kPlunge);
  q.samples = {{.move = 1, .ap_mm = 5.0, .ae_mm = 10.0, .plunge = true, .at_mm = 5.0, .step_mm = 5.0}};
  EXPECT_GT(feeds(q, p).peak.torque_nm, 0.0);
  EXPECT_LE(feeds(q, p).worst_excess, 1e-9);
  q.cut.machine.spindle.curve = {{60, 0, 0.001}, {1500, 0.15, 0}, {10000, 0.15, 0}};
  EXPECT_GT(feeds(q, p).worst_excess, 0.0);
}

/// `down`, measured: a plunge that leaves all but this area to others.
FeedQuestion plunged(double area_mm2) {
  FeedQuestion q = question();
  q.samples = {{.move = 1,
                .ap_mm = 5.0,
                .ae_mm = 10.0,
                .plunge = true,
                .at_mm = 5.0,
                .step_mm = 5.0,
                .csa_mm2 = area_mm2}};
  return q;
}

// A cutter that comes down on a small rest cuts that rest: drilling's specific force, kc1.1 (f / z)^-mc, with
// the mill's rake, times the area times the feed, and no more torque than this power has at the speed.
TEST(Feeds, OfAPlungeHaveThePowerOfTheAreaBelowTheCutter) {
  constexpr double kArea = 5.0;
  const FeedQuestion q = plunged(kArea);
  const auto a = feeds(q, down(MoveRole::kPlunge));
  const double feed = a.schedule.feed_mm_min[1];
  const double share = model::kienzle_share(q.cut.material, q.cut.cutter);
  const double kc = share * 1800.0 * std::pow(feed / 16000.0, -0.22);
  const double margin = drilling_margin_of(q.cut).factor();
  EXPECT_NEAR(a.peak.power_w, margin * kc * kArea * feed / 60000.0, 1e-6 * a.peak.power_w);
  EXPECT_NEAR(a.peak.torque_nm, a.peak.power_w * 60.0 / (2.0 * pi * 4000.0), 1e-9);
  EXPECT_NEAR(a.peak.mrr_mm3_min, kArea * feed, 1e-9);
}

TEST(Feeds, OfAPlungeIntoTheWholeDiscAreThoseOfTheSolid) {
  const CutterPath p = down(MoveRole::kPlunge);
  const auto solid = feeds(plunged(0.0), p);
  for (const double area : {25.0 * pi, 100.0}) {  // a map knows the rim to a cell
    const auto a = feeds(plunged(area), p);
    EXPECT_NEAR(a.peak.power_w, solid.peak.power_w, 1e-9 * solid.peak.power_w);
    EXPECT_EQ(a.schedule.feed_mm_min, solid.schedule.feed_mm_min);
  }
}

// 30 W do not drill 10 mm into steel, but take 1 mm2 of it: 1800 (h)^-0.22 N/mm2, some 7000 at most.
TEST(Feeds, OfAPlungeOntoASmallRestAreWithinASmallSpindle) {
  const CutterPath p = down(MoveRole::kPlunge);
  for (const double area : {0.0, 1.0}) {
    FeedQuestion q = plunged(area);
    q.cut.machine.spindle.curve = {{60, 0, 0.191}, {1500, 30, 0}, {10000, 30, 0}};
    const auto a = feeds(q, p);
    if (area > 0.0) {
      EXPECT_LE(a.worst_excess, 1e-9);
    } else {
      EXPECT_GT(a.worst_excess, 0.0);
    }
  }
}

// A ramp goes at half the feed of a slot with a cutter that states no angle (model::ramp_of): 400 of 800, not
// at the three tenths of a plunge, and that is what is told.
TEST(Feeds, TellOfARampTheFeedThatItsEndAllows) {
  FeedQuestion q = question();
  CutterPath p;
  p.start({0, 0, 0});
  p.line({50, 0, -1}, MoveRole::kRamp);
  cut_along(q, p, 1, 0.5, 2.0);
  const auto a = feeds(q, p);
  const double share = model::ramp_of(q.cut.cutter, q.cut.material).feed_share;
  EXPECT_NEAR(a.schedule.feed_mm_min[1], share * q.feed_mm_min, 0.2);
  const auto end = std::find_if(a.held_by.begin(), a.held_by.end(),
                                [](const auto& l) { return l.name == "end_cutting"; });
  ASSERT_NE(end, a.held_by.end());
  EXPECT_NEAR(end->limit, share * q.feed_mm_min, 0.2);
}

TEST(Feeds, OfTheConstantKindKeepAMovesOwnFactor) {
  FeedQuestion q = question();
  q.constant = true;
  CutterPath p = straight(50.0);
  p.line({50, 50, 0}, MoveRole::kCut);
  cut_along(q, p, 1, 2.0, 5.0);
  cut_along(q, p, 2, 2.0, 5.0);
  q.feed_factor = {1.0, 0.4, 1.0};
  const auto a = feeds(q, p).schedule.feed_mm_min;
  EXPECT_NEAR(a[1], 0.4 * a[2], 0.2);
}

// Inside of a corner the edge goes faster than the centre; a force that nobody limits holds nothing there.
TEST(Feeds, AreNotHeldByALimitThatNobodyStates) {
  FeedQuestion q = question();
  CutterPath p = straight();
  cut_along(q, p, 1, 0.5, 1.0);
  for (CutSample& s : q.samples) s.ae_mm = 1.35, s.csa_mm2 = 0.675;
  const auto a = feeds(q, p);
  EXPECT_FALSE(a.held_by.empty());
  for (const auto& l : a.held_by) {
    EXPECT_NE(l.name, "peak_force");
    EXPECT_LT(l.limit, 1e9);
  }
}

TEST(Loads, RunoutThickensThePlannedChipInFull) {
  CutQuestion q = questions::roughing();
  q.cutter.fz_max_mm = 0.0;
  q.machine.abilities.feed_override_max = 1.2;
  const double e = 0.01;
  q.cutter.runout_mm = e;
  const double feed = 0.05 * 4 * 4000.0;
  const auto l = loads_of(q, 2.0, 6.0, 4000.0, feed);
  ASSERT_TRUE(l);
  EXPECT_NEAR(l->chip_thickness_mm, 0.05 + e * std::sin(pi / 4.0), 1e-9);
}

TEST(Loads, ANeckAndALongHolderBendTheTip) {
  CutQuestion q = questions::roughing();
  const auto plain = loads_of(q, 2.0, 5.0, 4000.0, 800.0);
  CutQuestion necked = q;
  necked.cutter.neck_diameter_mm = 6.0;
  necked.cutter.neck_length_mm = 33.0;
  CutQuestion held = q;
  held.cutter.holder.push_back({.height_mm = 80.0, .lower_diameter_mm = 20.0, .upper_diameter_mm = 20.0});
  for (const CutQuestion& other : {necked, held}) {
    const auto l = loads_of(other, 2.0, 5.0, 4000.0, 800.0);
    ASSERT_TRUE(plain && l);
    EXPECT_GT(l->deflection_mm, 1.05 * plain->deflection_mm);
    EXPECT_NEAR(l->deflection_mm, l->peak_force_n * *mechanics::tip_compliance_mm_n(other.cutter), 1e-12);
  }
}

}  // namespace
}  // namespace capstan::optimise
