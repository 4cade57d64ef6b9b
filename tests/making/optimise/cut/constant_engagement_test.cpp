// Cuts of constant engagement: as deep as the edge, narrow, and faster for it.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "planner/making/optimise/cut.h"
#include "planner/making/optimise/cut/cost.h"
#include "planner/making/optimise/cut/limits.h"
#include "planner/physics/mechanics/life/arc_speed.h"
#include "tests/making/optimise/cut/questions.h"
#include "tests/making/optimise/cut/solved.h"

namespace capstan::optimise {
namespace {

CutQuestion stainless() {
  CutQuestion q = questions::roughing();
  q.material.iso_group = "M";
  q.material.kc11_n_mm2 = 2000.0;
  q.vc_start_m_min = 75.0;
  q.fz_start_mm = 0.04;
  q.constant_engagement = true;
  return q;
}

class ConstantEngagement : public questions::Solved {
 protected:
  static double by_arc(const CutQuestion& q, const CutAnswer& a) {
    return mechanics::speed_by_arc(a.ae_mm, q.cutter.cutting_diameter_mm, q.cutter.substrate,
                                   q.material.iso_group);
  }
};

TEST_F(ConstantEngagement, KeepsEveryLimitThatOtherCutsKeep) {
  CutQuestion q = stainless();
  const CutAnswer a = answered(q);
  ASSERT_TRUE(a.feasible);
  q.constant_engagement = false;
  EXPECT_LE(worst_excess(q, a.loads, a.n_rpm), 1e-6);
  EXPECT_LE(a.loads.chip_thickness_mm, q.fz_start_mm * (1.0 + 1e-6));
}

TEST_F(ConstantEngagement, IsFedSoThatTheChipAndNotTheFeedIsTheTables) {
  CutQuestion q = stainless();
  q.ae_mm = 1.0;
  q.deflection_limit_mm = 1.0;  // only the chip is to hold it
  const CutAnswer a = answered(q);
  ASSERT_TRUE(a.feasible);
  EXPECT_NEAR(a.loads.chip_thickness_mm, q.fz_start_mm, 0.01 * q.fz_start_mm);
  // A tenth of the diameter wide: 1 / (2 sqrt(0.1 x 0.9)) = 1.667 times the feed.
  EXPECT_NEAR(a.fz_mm, q.fz_start_mm / 0.6, 0.01 * q.fz_start_mm);
}

TEST_F(ConstantEngagement, TurnsFasterByTheArcAndNoFaster) {
  for (const double width : {0.5, 1.0, 2.0, 5.0}) {
    CutQuestion q = stainless();
    q.ae_mm = width;
    const CutAnswer a = answered(q);
    ASSERT_TRUE(a.feasible) << width;
    EXPECT_LE(a.vc_m_min, by_arc(q, a) * q.vc_start_m_min * (1.0 + 1e-9)) << width;
    EXPECT_GT(a.vc_m_min, 0.98 * by_arc(q, a) * q.vc_start_m_min) << width;
  }
}

TEST_F(ConstantEngagement, WearsAnEdgeNoFasterThanTheTablesSpeedDoesInAWideCut) {
  CutQuestion q = stainless();
  const CutAnswer narrow = answered(q);
  ASSERT_TRUE(narrow.feasible);
  ASSERT_GT(narrow.vc_m_min, q.vc_start_m_min);
  q.constant_engagement = false;
  const double n = 1000.0 * q.vc_start_m_min / (std::numbers::pi * q.cutter.cutting_diameter_mm);
  EXPECT_GE(narrow.life_min, edge_life_min(q, {1.0, 5.0, n, 100.0}) * (1.0 - 1e-6));
}

TEST_F(ConstantEngagement, IsAsDeepAsTheEdgeWhereASlotMayNotBe) {
  CutQuestion q = stainless();
  q.depth_mm = 22.0;
  q.cutter.stick_out_mm = 35.0;
  q.ae_mm = 1.0;
  EXPECT_EQ(deepest_level(q), q.cutter.maximum_depth_of_cut_mm);
  q.constant_engagement = false;
  EXPECT_LT(deepest_level(q), q.depth_mm);
}

TEST_F(ConstantEngagement, OfAluminiumTurnsNoFasterThanTheTable) {
  CutQuestion q = stainless();
  q.material.iso_group = "N";
  q.ae_mm = 1.0;
  const CutAnswer a = answered(q);
  ASSERT_TRUE(a.feasible);
  EXPECT_LE(a.vc_m_min, q.vc_start_m_min * (1.0 + 1e-9));
}

TEST_F(ConstantEngagement, IsOfTheWidthThatRemovesMost) {
  const CutQuestion q = stainless();
  const CutAnswer best = answered(q);
  const double rate = best.ap_mm * best.ae_mm * best.feed_mm_min;
  for (const double width : {0.5, 1.0, 1.5, 2.0, 3.0, 5.0}) {
    CutQuestion one = q;
    one.ae_mm = width;
    const CutAnswer a = answered(one);
    // Changing levels counts, too, so that a rate may be a little more.
    if (!a.feasible) continue;
    EXPECT_LE(a.ap_mm * a.ae_mm * a.feed_mm_min, 1.02 * rate) << width;
  }
}

/// The 10 mm mill in hardened steel of this Brinell hardness: 481 are 50 HRC, 654 are 60.
CutQuestion hardened(double hb, bool constant) {
  CutQuestion q = questions::roughing();
  q.material.iso_group = "H";
  q.material.hardness_hb = hb;
  q.material.kc11_n_mm2 = 4700.0;
  q.material.mc = 0.24;
  q.vc_start_m_min = 20.0;
  q.fz_start_mm = 0.025;
  q.constant_engagement = constant;
  return q;
}

// Never half the diameter at a third of it deep: a level of 0.05 D, or D x 0.1 D (model::kHardCut).
TEST_F(ConstantEngagement, InSteelAboveFiftyHrcIsNarrowAndLevelsAreThin) {
  const CutAnswer level = answered(hardened(654.0, false)), narrow = answered(hardened(654.0, true));
  EXPECT_TRUE(level.feasible);
  EXPECT_LE(level.ap_mm, 0.5 + 1e-9);
  EXPECT_TRUE(narrow.feasible);
  EXPECT_LE(narrow.ae_mm, 1.0 + 1e-9);
  EXPECT_LE(narrow.ap_mm, 10.0 + 1e-9);
  EXPECT_GT(narrow.ap_mm * narrow.ae_mm * narrow.feed_mm_min, level.ap_mm * level.ae_mm * level.feed_mm_min);
  EXPECT_GT(answered(hardened(481.0, false)).ap_mm, 0.5 + 1e-9);
}

}  // namespace
}  // namespace capstan::optimise
