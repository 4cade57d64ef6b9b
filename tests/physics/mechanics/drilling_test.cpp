#include "planner/physics/mechanics/force/drilling.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "planner/physics/mechanics/constants.h"

namespace capstan::mechanics {
namespace {

constexpr double kPi = std::numbers::pi;

TEST(DrillingLoads, MatchTheToolMakersWorkedExample) {
  // Iscar 2017, p. 601: D 22, f 0.15, kc 2200, sin k = 1: Mc 20 Nm, Ff 2286 N; Q 165 cm3/min at 2894 1/min.
  const auto loads = drilling_loads(
      {.diameter_mm = 22.0, .feed_mm_per_rev = 0.15, .n_rpm = 2894.0, .teeth = 1, .point_angle_rad = kPi},
      {2200.0, 0.0});
  ASSERT_TRUE(loads);
  EXPECT_NEAR(loads->torque_nm, 20.0, 0.05);
  EXPECT_NEAR(loads->thrust_n, 2286.0, 1.5);
  EXPECT_NEAR(loads->removal_mm3_min, 165e3, 100.0);
  // The example's 8.06 kW are at the motor, efficiency 0.75.
  EXPECT_NEAR(loads->power_w / 0.75, 8060.0, 30.0);
}

TEST(DrillingLoads, UseTheChipThicknessOfOneLip) {
  const WorkMaterial work{2110.0, 0.17};
  const auto loads = drilling_loads(
      {.diameter_mm = 10.0, .feed_mm_per_rev = 0.2, .n_rpm = 800.0, .point_angle_rad = 118.0 * kPi / 180.0},
      work);
  const double h = 0.1 * std::sin(59.0 * kPi / 180.0);
  EXPECT_DOUBLE_EQ(loads->chip_thickness_mm, h);
  EXPECT_DOUBLE_EQ(loads->specific_force_n_mm2, specific_force_n_mm2(work, h));
  EXPECT_NEAR(loads->power_w, cutting_power_w(loads->removal_mm3_min, loads->specific_force_n_mm2), 1e-9);
}

TEST(DrillingLoads, OfEnlargingAddUpToThoseOfTheSolid) {
  const WorkMaterial work{2110.0, 0.17};
  DrillingCut cut{.diameter_mm = 20.0, .feed_mm_per_rev = 0.25, .n_rpm = 400.0, .point_angle_rad = 2.0};
  const auto whole = drilling_loads(cut, work);
  cut.pre_hole_diameter_mm = 8.0;
  const auto outer = drilling_loads(cut, work);
  cut.diameter_mm = 8.0;
  cut.pre_hole_diameter_mm = 0.0;
  const auto inner = drilling_loads(cut, work);
  EXPECT_NEAR(outer->torque_nm + inner->torque_nm, whole->torque_nm, 1e-9);
  EXPECT_NEAR(outer->thrust_n + inner->thrust_n, whole->thrust_n, 1e-9);
}

TEST(ReamingLoads, AreThoseOfEnlargingTimesTheFrictionFactor) {
  const DrillingCut cut{.diameter_mm = 10.0,
                        .feed_mm_per_rev = 0.3,
                        .n_rpm = 250.0,
                        .teeth = 6,
                        .point_angle_rad = kPi / 2.0,
                        .pre_hole_diameter_mm = 9.8};
  const WorkMaterial work{2110.0, 0.17};
  EXPECT_DOUBLE_EQ(reaming_loads(cut, work)->torque_nm,
                   kReamingFrictionFactor * drilling_loads(cut, work)->torque_nm);
}

TEST(TappingLoads, AreNearTheTablesOfTwoTapMakers) {
  // M8 x 1.25 in a 6.8 mm hole, C45. Yamawa tabulates kc 3900 and K 1.35 (hand tap): 0.57735 * 3900 * 1.35 *
  // 1.2^2 * 21.6 / 24000 = 3.94 Nm. Lubero: kc p^2 d / 8000 with kc 2500 = 3.91 Nm.
  const TappingCut cut{.nominal_diameter_mm = 8.0,
                       .core_hole_diameter_mm = 6.8,
                       .pitch_mm = 1.25,
                       .n_rpm = 240.0,
                       .flutes = 3,
                       .chamfer_threads = 5.0};
  const auto loads = tapping_loads(cut, {2110.0, 0.17});
  ASSERT_TRUE(loads);
  EXPECT_NEAR(loads->torque_nm * 1.35 / kTappingTorqueFactor, 3.92, 0.35);
  EXPECT_GT(loads->torque_nm, 3.94);  // ours is the conservative factor
}

TEST(TappingCut, HasTheTeethAndTheLeadOfItsTap) {
  model::Cutter tap;
  tap.cutting_diameter_mm = 8.0;
  tap.thread_pitch_mm = 1.25;
  const TappingCut usual;
  const TappingCut untold = tapping_cut_of(tap, 0.0, 240.0);
  EXPECT_EQ(untold.core_hole_diameter_mm, 6.75);
  EXPECT_EQ(untold.flutes, usual.flutes);
  EXPECT_EQ(untold.chamfer_threads, usual.chamfer_threads);
  EXPECT_EQ(untold.n_rpm, 240.0);
  const TappingCut of_usual = tapping_cut_of(tap, 6.8, 240.0);
  tap.teeth = 4;
  tap.lead_threads = 5.0;
  const TappingCut told = tapping_cut_of(tap, 6.8, 240.0);
  EXPECT_EQ(told.core_hole_diameter_mm, 6.8);
  EXPECT_EQ(told.flutes, 4);
  EXPECT_EQ(told.chamfer_threads, 5.0);
  // The chip is shared by 20 teeth of the chamfer instead of 7.5, and kc = kc1.1 h^-mc.
  const WorkMaterial work{2110.0, 0.17};
  EXPECT_NEAR(tapping_loads(told, work)->torque_nm / tapping_loads(of_usual, work)->torque_nm,
              std::pow(20.0 / 7.5, 0.17), 1e-12);
}

TEST(DrillingDoors, RefuseWhatIsNotACut) {
  const WorkMaterial work{2110.0, 0.17};
  const DrillingCut good{.diameter_mm = 10.0, .feed_mm_per_rev = 0.2, .n_rpm = 800.0, .point_angle_rad = 2.0};
  ASSERT_TRUE(drilling_loads(good, work));
  DrillingCut bad = good;
  bad.feed_mm_per_rev = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(drilling_loads(bad, work).error().code, "MECH-DOMAIN");
  bad = good;
  bad.pre_hole_diameter_mm = 10.0;
  EXPECT_FALSE(drilling_loads(bad, work));
  EXPECT_FALSE(drilling_loads(good, {-1.0, 0.2}));
  EXPECT_FALSE(tapping_loads(
      {.nominal_diameter_mm = 6.0, .core_hole_diameter_mm = 8.0, .pitch_mm = 1.0, .n_rpm = 100.0}, work));
}

}  // namespace
}  // namespace capstan::mechanics
