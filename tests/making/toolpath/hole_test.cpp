#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/making/toolpath/path_helpers.h"

namespace capstan::toolpath {
namespace {

using model::CutterClass;
using model::MoveKind;
using model::MoveRole;
using model::TypeId;

constexpr double kPi = std::numbers::pi;

PathJob hole_job(TypeId operation, CutterClass tool, double diameter, double depth) {
  PathJob t;
  t.shape.kind = model::ShapeKind::kHole;
  t.shape.name = "HOLE";
  t.shape.diameter.nominal_mm = t.shape.bottom_diameter_mm = diameter;
  t.shape.depth_mm = depth;
  t.shape.through = true;
  t.shape.area = t.shape.reach = geometry::disc({0, 0}, 0.5 * diameter);
  t.feature_in_setup.origin = {20, 60, 0};
  t.operation = operation;
  t.cutter = endmill(diameter);
  t.cutter.cutter_class = tool;
  t.security_z_mm = 30.0;
  t.retract_z_mm = 10.0;
  return t;
}

double lowest(const GeneratedPath& g) { return *std::min_element(g.path.z.begin(), g.path.z.end()); }

TEST(DrillPath, ReducesSpeedAndFeedAsNistsExampleDoes) {
  // nist_ex1.can, its lines 52 to 63: a 20 mm drill whose tip is 7.1378 mm long, reduced at start over 2 mm
  // and from 8 mm on, both counted at the full diameter.
  PathJob t = hole_job(TypeId::kDrilling, CutterClass::kTwistDrill, 20.0, 30.0);
  t.cutter.point_angle_rad = 2.0 * std::atan(10.0 / 7.1378);
  t.phases = DrillPhases{0.75, 0.5, 2.0, 0.5, 0.75, 8.0, true};
  t.feed_on_retract = 1.0;
  Job job;
  const auto g = generate(t, job);
  ASSERT_TRUE(g) << g.error().message;
  struct Step {
    double z, feed, speed;
  };
  std::vector<Step> drilled;
  for (std::size_t i = 1; i < g->path.size(); ++i) {
    if (g->path.role[i] == MoveRole::kDrill)
      drilled.push_back({g->path.z[i], g->feed_factor[i], g->speed_factor[i]});
  }
  ASSERT_EQ(drilled.size(), 3U);
  EXPECT_NEAR(drilled[0].z, -9.1378, 1e-9);
  EXPECT_NEAR(drilled[1].z, -15.1378, 1e-9);
  EXPECT_NEAR(drilled[2].z, -37.1378, 1e-9);
  EXPECT_EQ(drilled[0].feed, 0.5);
  EXPECT_EQ(drilled[0].speed, 0.75);
  EXPECT_EQ(drilled[1].feed, 1.0);
  EXPECT_EQ(drilled[2].feed, 0.75);
  EXPECT_EQ(drilled[2].speed, 0.5);
  EXPECT_THAT(rule_breaks(t, *g), testing::IsEmpty());
}

TEST(DrillPath, KeepsTheReducedEndAsALengthAboveTheBottomOtherwise) {
  PathJob t = hole_job(TypeId::kDrilling, CutterClass::kTwistDrill, 10.0, 30.0);
  t.phases = DrillPhases{1.0, 1.0, 0.0, 0.5, 0.5, 4.0, false};
  Job job;
  const auto g = generate(t, job);
  ASSERT_TRUE(g);
  double begins = 0.0;
  for (std::size_t i = 1; i < g->path.size(); ++i) {
    if (g->path.role[i] == MoveRole::kDrill && g->feed_factor[i] == 1.0) begins = g->path.z[i];
  }
  EXPECT_NEAR(begins, lowest(*g) + 4.0, 1e-9);
}

TEST(DrillPath, EndsWhereTheKindOfBottomSays) {
  Job job;
  PathJob t = hole_job(TypeId::kDrilling, CutterClass::kTwistDrill, 10.0, 25.0);
  t.cutter.point_angle_rad = kPi / 2.0;  // a tip of 5 mm
  t.break_through_mm = 1.5;
  EXPECT_NEAR(lowest(*generate(t, job)), -25.0 - 5.0 - 1.5, 1e-9);
  t.shape.through = false;
  t.shape.bottom = model::HoleBottom::kFlat;
  EXPECT_NEAR(lowest(*generate(t, job)), -25.0, 1e-9);
  t.shape.bottom = model::HoleBottom::kConical;
  t.shape.bottom_angle_rad = kPi / 4.0;
  EXPECT_NEAR(lowest(*generate(t, job)), -30.0, 1e-9);
  t.shape.bottom_angle_rad = kPi / 6.0;  // flatter than the drill's tip: its cone is not gone through
  EXPECT_NEAR(lowest(*generate(t, job)), -25.0 - 5.0 * std::tan(kPi / 6.0), 1e-9);
  t.cutting_depth_mm = 12.0;
  EXPECT_NEAR(lowest(*generate(t, job)), -12.0 - 5.0, 1e-9);
}

TEST(DrillPath, PecksWithoutRapidsInTheHole) {
  for (const double retract : {0.0, 0.4}) {
    PathJob t = hole_job(TypeId::kMultistepDrilling, CutterClass::kTwistDrill, 6.0, 40.0);
    t.peck = Peck{.first_mm = 12.0, .step_mm = 6.0, .retract_mm = retract, .dwell_s = 0.2};
    Job job;
    const auto g = generate(t, job);
    ASSERT_TRUE(g) << g.error().message;
    EXPECT_THAT(rule_breaks(t, *g), testing::IsEmpty());
    int bottoms = 0;
    for (std::size_t i = 1; i < g->path.size(); ++i) {
      if (g->path.kind[i] == MoveKind::kDwell) {
        ++bottoms;
        EXPECT_EQ(g->dwell_s[i], 0.2);
      }
    }
    EXPECT_EQ(bottoms, 6);  // 12, 18, 24, 30, 36, 40 mm
    HeightMap map({10, 50}, {30, 70}, 0.25, 0.0);
    EXPECT_THAT(map.run(*g, t.cutter).faults, testing::IsEmpty());
  }
}

TEST(DrillPath, DrawsAReamerOutAtFeedAndSaysWhenItsSpindleIsStopped) {
  PathJob t = hole_job(TypeId::kReaming, CutterClass::kReamer, 22.0, 30.0);
  Job job;
  auto g = generate(t, job);
  ASSERT_TRUE(g);
  EXPECT_NEAR(lowest(*g), -30.0, 1e-9);
  EXPECT_TRUE(job.diagnostics().empty());
  t.spindle_stop_at_bottom = true;
  g = generate(t, job);
  ASSERT_TRUE(g);
  const std::size_t up = g->path.size() - 2;
  EXPECT_EQ(g->path.kind[up], MoveKind::kLine);
  EXPECT_EQ(g->speed_factor[up], 0.0);
  ASSERT_EQ(job.diagnostics().size(), 1U);
  EXPECT_EQ(job.diagnostics()[0].code, "TPA-GIVEN");
}

TEST(DrillPath, DrawsAGunDrillOutAsSlowlyTurningAsItWentIn) {
  for (const bool gun : {true, false}) {
    PathJob t =
        hole_job(TypeId::kDrilling, gun ? CutterClass::kGunDrill : CutterClass::kTwistDrill, 8.0, 120.0);
    t.cutter.usable_length_mm = 150.0;
    t.phases = DrillPhases{0.3, 0.3, 12.0, 1.0, 1.0, 0.0, false};
    Job job;
    const auto g = generate(t, job);
    ASSERT_TRUE(g) << g.error().message;
    const auto bottom = std::min_element(g->path.z.begin(), g->path.z.end()) - g->path.z.begin();
    ASSERT_LT(static_cast<std::size_t>(bottom) + 1, g->path.size());
    EXPECT_EQ(g->speed_factor[bottom], 1.0);
    for (std::size_t i = bottom + 1; i < g->path.size(); ++i) {
      EXPECT_EQ(g->path.kind[i], MoveKind::kRapid);
      EXPECT_EQ(g->speed_factor[i], gun ? 0.3 : 1.0);
    }
  }
}

TEST(DrillPath, SinksAConeToTheDiameterAsked) {
  PathJob t = hole_job(TypeId::kCounterSinking, CutterClass::kCountersink, 12.0, 3.0);
  t.cutter.cutting_diameter_mm = 16.0;
  t.cutter.point_angle_rad = kPi / 2.0;
  t.cutter.tip_diameter_mm = 2.0;
  Job job;
  EXPECT_NEAR(lowest(*generate(t, job)), -5.0, 1e-9);  // (12 - 2) / 2 at 45 degrees
}

TEST(DrillPath, OfASpotReachesAsDeepAsTheSpotNotTheHole) {
  PathJob t = hole_job(TypeId::kCenterDrilling, CutterClass::kSpotDrill, 6.0, 30.0);
  t.cutter.point_angle_rad = 0.5 * kPi;
  t.cutter.usable_length_mm = 12.0;
  t.cutting_depth_mm = 2.0;
  Job job;
  ASSERT_TRUE(generate(t, job));
  for (const auto& d : job.take_diagnostics()) EXPECT_NE(d.code, "TPA-REACH") << d.message;
  t.cutting_depth_mm = 13.0;
  ASSERT_TRUE(generate(t, job));
  const auto said = job.take_diagnostics();
  EXPECT_TRUE(std::any_of(said.begin(), said.end(), [](const auto& d) { return d.code == "TPA-REACH"; }));
}

TEST(DrillPath, RefusesBackBoring) {
  Job job;
  const auto g = generate(hole_job(TypeId::kBackBoring, CutterClass::kBoringTool, 22.0, 30.0), job);
  ASSERT_FALSE(g);
  EXPECT_EQ(g.error().code, "TPA-UNSUPPORTED");
}

TEST(TapPath, GoesDownAndUpInStepWithTheSpindle) {
  PathJob t = hole_job(TypeId::kTapping, CutterClass::kTap, 8.0, 20.0);
  t.shape.thread_pitch_mm = 1.25;
  t.shape.thread_depth_mm = 16.0;
  t.cutter.thread_pitch_mm = 1.25;
  Job job;
  const auto g = generate(t, job);
  ASSERT_TRUE(g) << g.error().message;
  EXPECT_NEAR(lowest(*g), -16.0, 1e-9);
  std::vector<double> speeds;
  for (std::size_t i = 1; i < g->path.size(); ++i) {
    if (g->path.role[i] == MoveRole::kTap) speeds.push_back(g->speed_factor[i]);
  }
  EXPECT_THAT(speeds, testing::ElementsAre(1.0, -1.0));
  t.cutter.thread_pitch_mm = 1.0;
  EXPECT_EQ(generate(t, job).error().code, "TPA-TOOL");
}

TEST(ThreadMillPath, RisesOnePitchPerTurnAndStaysInTheMajorDiameter) {
  for (const bool left_hand : {false, true}) {
    PathJob t = hole_job(TypeId::kThreadDrilling, CutterClass::kThreadMill, 18.0, 30.0);
    t.shape.kind = model::ShapeKind::kThread;
    t.shape.thread_major_mm = 20.0;
    t.shape.thread_pitch_mm = 2.0;
    t.shape.thread_depth_mm = 24.0;
    t.shape.thread_left_hand = left_hand;
    t.cutter.cutting_diameter_mm = 12.0;
    t.cutter.thread_pitch_mm = 2.0;
    t.cutter.maximum_depth_of_cut_mm = 2.0;
    Job job;
    const auto g = generate(t, job);
    ASSERT_TRUE(g) << g.error().message;
    EXPECT_THAT(rule_breaks(t, *g), testing::IsEmpty());
    double turned = 0.0;
    double rise = 0.0;
    for (std::size_t i = 1; i < g->path.size(); ++i) {
      if (g->path.kind[i] != MoveKind::kArcCcw) continue;
      const double r = std::hypot(g->path.x[i] - g->path.cx[i], g->path.y[i] - g->path.cy[i]);
      if (r < 3.0) continue;  // leads
      EXPECT_NEAR(r + 6.0, 10.0, 1e-9);
      turned += model::arc_sweep(g->path, i);
      rise += g->path.z[i] - g->path.z[i - 1];
    }
    EXPECT_NEAR(turned, 12 * 2.0 * kPi, 1e-6);
    // Counter-clockwise and rising is a right-hand helix.
    EXPECT_NEAR(rise, left_hand ? -24.0 : 24.0, 1e-9);
  }
}

TEST(HelixPath, MillsAHoleWithoutLeavingACoreOrPlunging) {
  for (const double diameter : {15.0, 18.5}) {
    PathJob t = hole_job(TypeId::kBottomAndSideRoughMilling, CutterClass::kEndmill, diameter, 12.0);
    t.shape.through = false;
    t.cutter = endmill(10.0);
    t.cutter.centre_cutting = false;
    t.allowance_side_mm = 0.2;
    Job job;
    const auto g = generate(t, job);
    ASSERT_TRUE(g) << g.error().message;
    EXPECT_THAT(rule_breaks(t, *g), testing::IsEmpty());
    const auto hole = geometry::disc({20, 60}, 0.5 * diameter);
    EXPECT_LE(gouge_mm(*g, hole, 5.2, -1e-6), 0.003);
    HeightMap map({5, 45}, {35, 75}, 0.125, 0.0);
    EXPECT_THAT(map.run(*g, t.cutter).faults, testing::IsEmpty());
    EXPECT_NEAR(map.highest(geometry::offset(hole, -0.4)), -12.0, 1e-4);
  }
}

// Steepest fall of the tip along an arc, rad.
double steepest_arc(const GeneratedPath& g) {
  double out = 0.0;
  for (std::size_t i = 1; i < g.path.size(); ++i) {
    if (g.path.kind[i] != MoveKind::kArcCw && g.path.kind[i] != MoveKind::kArcCcw) continue;
    const double r = std::hypot(g.path.x[i] - g.path.cx[i], g.path.y[i] - g.path.cy[i]);
    out = std::max(out, std::atan2(g.path.z[i - 1] - g.path.z[i], kPi * r));  // half a turn at most
  }
  return out;
}

TEST(HelixPath, GoesDownByTheAxialDepthOnlyWhereTheCuttersMiddleIsInTheHoleThatIsThere) {
  PathJob t = hole_job(TypeId::kBottomAndSideRoughMilling, CutterClass::kEndmill, 30.0, 30.0);
  t.cutter = endmill(14.0);
  t.cutter.maximum_ramp_angle_rad = 7.0 * kPi / 180.0;
  t.allowance_side_mm = 0.3;
  t.axial_depth_mm = 10.0;
  // The axis runs 7.7 mm from the middle: the rim of a hole of 16 mm lies under the cutter's middle, and a
  // helix wider than the cutter would leave a core where there was none.
  t.previous_diameter_mm = 16.0;
  Job job;
  const auto narrow = generate(t, job);
  ASSERT_TRUE(narrow) << narrow.error().message;
  EXPECT_LE(steepest_arc(*narrow), t.cutter.maximum_ramp_angle_rad + 1e-9);
  // 29.4 mm leave the middle free: 31 mm in levels of 10.
  t.previous_diameter_mm = 29.4;
  t.allowance_side_mm = 0.0;
  const auto wide = generate(t, job);
  ASSERT_TRUE(wide) << wide.error().message;
  EXPECT_NEAR(steepest_arc(*wide), std::atan2(32.0 / 8.0, kPi * 8.0), 0.02);
}

TEST(HelixPath, LeavesLargeHolesToTheRings) {
  PathJob t = hole_job(TypeId::kBottomAndSideRoughMilling, CutterClass::kEndmill, 60.0, 8.0);
  t.shape.through = false;
  t.cutter = endmill(10.0);
  t.axial_depth_mm = 4.0;
  Job job;
  const auto g = generate(t, job);
  ASSERT_TRUE(g) << g.error().message;
  HeightMap map({-15, 25}, {55, 95}, 0.25, 0.0);
  EXPECT_THAT(map.run(*g, t.cutter).faults, testing::IsEmpty());
  EXPECT_NEAR(map.highest(geometry::disc({20, 60}, 29.7)), -8.0, 1e-4);
}

TEST(Generate, RefusesATiltedFeature) {
  PathJob t = hole_job(TypeId::kDrilling, CutterClass::kTwistDrill, 10.0, 20.0);
  t.feature_in_setup = *geometry::make_placement({0, 0, 0}, {0, 1, 1}, {1, 0, 0});
  Job job;
  EXPECT_EQ(generate(t, job).error().code, "TPA-FRAME");
}

}  // namespace
}  // namespace capstan::toolpath
