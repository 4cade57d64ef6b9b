// What holds a cut: the tool's strength, feeds and chips that are too small, depth, chatter.

#include "planner/making/optimise/cut/limits.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "planner/making/optimise/cut.h"
#include "planner/making/optimise/cut/cost.h"
#include "planner/making/optimise/cut/stability.h"
#include "planner/model/plan/resources/by_cases.h"
#include "planner/physics/mechanics/constants.h"
#include "planner/physics/mechanics/force/force_law.h"
#include "planner/physics/mechanics/stability.h"
#include "tests/making/optimise/cut/questions.h"
#include "tests/making/optimise/cut/solved.h"

namespace capstan::optimise {
namespace {

using CutLimits = questions::Solved;

/// The mill of 1 mm in a slot of half its diameter, by the feed per tooth that planning starts from.
CutQuestion thin_mill(double fz_mm) {
  CutQuestion q = questions::roughing();
  q.cutter.cutting_diameter_mm = q.cutter.shank_diameter_mm = 1.0;
  q.cutter.maximum_depth_of_cut_mm = q.cutter.stick_out_mm = 3.0;
  q.cutter.fz_max_mm = 0.0;
  q.slot = true;
  q.width_mm = 1.0;
  q.depth_mm = *(q.ap_mm = 0.5);
  q.fz_start_mm = fz_mm;
  return q;
}

// Flutes of 3 mm on a mill of 1 mm: I = pi 0.8^4 / 64 = 0.0201 mm4, so that 1000 N/mm2 in the fibre at 0.5 mm
// are a force of 1000 I / (0.5 * 3) = 13.4 N. No bending is asked for.
TEST_F(CutLimits, AThinMillIsHeldByItsStrength) {
  const CutQuestion q = thin_mill(0.02);
  const CutAnswer a = answered(q);
  ASSERT_TRUE(a.feasible);
  EXPECT_LE(a.loads.peak_force_n, 13.41);
  EXPECT_TRUE(std::any_of(a.active.begin(), a.active.end(),
                          [](const auto& c) { return c.name == "tool_deflection"; }));
}

// The tooth that stands out most takes 0.015 sin(pi / 4) mm more, its force grows by (1 - mc) = 0.8 of the
// logarithm, and that adds as a square to the margin of 1.5 in the coefficients, 1.3 in wear and an override
// of 1.2.
TEST(CutLimitsOfRunout, AThinChipLeavesTheToolLessOfItsStrengthWhereNoRunoutIsStated) {
  const auto share = [](CutQuestion q) {
    const double usual = fixed_limits(q).deflection_mm;
    q.cutter.runout_mm = 0.0001;  // where it is stated, the forces have it
    return usual / fixed_limits(q).deflection_mm;
  };
  EXPECT_NEAR(share(thin_mill(0.02)), 0.901, 1e-3);
  EXPECT_NEAR(share(thin_mill(0.2)), 0.998, 1e-3);
}

TEST_F(CutLimits, AThinMillIsFedFasterWhereItIsStatedToRunTrue) {
  CutQuestion q = thin_mill(0.02);
  const CutAnswer usual = answered(q);
  q.cutter.runout_mm = 0.0001;
  const CutAnswer runs_true = answered(q);
  ASSERT_TRUE(usual.feasible && runs_true.feasible);
  EXPECT_GT(runs_true.fz_mm, 1.05 * usual.fz_mm);
}

TEST_F(CutLimits, HoldsTheLeastFeedThatTheMakerStates) {
  CutQuestion q = questions::roughing();
  q.deflection_limit_mm = 0.03;
  const CutAnswer without = answered(q);
  ASSERT_TRUE(without.feasible);
  q.cutter.fz_min_mm = 0.05;
  const CutAnswer with = answered(q);
  ASSERT_TRUE(with.feasible);
  EXPECT_GE(with.fz_mm, 0.05 * (1.0 - 1.0 / with.feed_mm_min) - 1e-9);
  // No depth and width that bends so little at that feed:
  q.deflection_limit_mm = 1e-4;
  const CutAnswer never = answered(q);
  EXPECT_FALSE(never.feasible);
  EXPECT_FALSE(never.violated.empty());
}

TEST_F(CutLimits, ALeastFeedThatNobodyStatedGivesWayBeforeTheCutDoes) {
  CutQuestion q = questions::roughing();
  q.slot = true;
  q.ap_mm = 4.0;
  q.deflection_limit_mm = 0.05;
  q.cutter.fz_min_mm = 0.05;
  const CutAnswer strict = answered(q);
  EXPECT_FALSE(strict.feasible);
  q.cutter.sources = {{"fz_min_mm", "derived: of a generic cutter"}};
  const CutAnswer mild = answered(q);
  EXPECT_TRUE(mild.feasible);
  EXPECT_LT(mild.fz_mm, 0.05);
}

TEST_F(CutLimits, KeepsTheLeastChip) {
  CutQuestion q = questions::finishing();
  q.surface_ra_um = 0.02;  // feeds below about 0.05
  const double least = mechanics::least_chip_mm(q.cutter.cutting_diameter_mm, false, q.material.iso_group);
  const CutAnswer a = answered(q);
  ASSERT_TRUE(a.feasible);
  EXPECT_GE(a.loads.chip_thickness_mm, least * (1.0 - 1e-5));
  q.surface_ra_um = 1e-5;  // feeds below about a thousandth
  const CutAnswer b = answered(q);
  EXPECT_FALSE(b.feasible);
}

TEST_F(CutLimits, LevelsOfSlenderCuttersAreShallow) {
  CutQuestion q = questions::roughing();
  q.deflection_limit_mm = 10.0;  // the rule alone
  q.material.kc11_n_mm2 = 300.0;
  q.cutter.stick_out_mm = 40.0;
  EXPECT_EQ(answered(q).levels, 1);  // four diameters: 12 mm are within 1.5 D
  q.cutter.stick_out_mm = 80.0;      // 1.5 D / 2^3 = 1.875 mm
  const CutAnswer a = answered(q);
  EXPECT_LE(a.ap_mm, 1.875);
  EXPECT_GE(a.levels, 7);
  q.ap_mm = 6.0;  // given: the rule of thumb does not overrule it
  EXPECT_TRUE(answered(q).feasible);
}

TEST_F(CutLimits, DeepSlotsAreCutWithTheirShareOfSpeedAndFeed) {
  EXPECT_EQ(deep_slot_share(5.0, 10.0), 1.0);
  EXPECT_DOUBLE_EQ(deep_slot_share(10.0, 10.0), 0.75);
  EXPECT_DOUBLE_EQ(deep_slot_share(15.0, 10.0), 0.5);
  CutQuestion q = questions::roughing();
  q.slot = true;
  q.width_mm = 10.0;
  q.deflection_limit_mm = 10.0;  // speed and chip alone
  q.material.kc11_n_mm2 = 300.0;
  for (const double depth : {5.0, 10.0, 15.0}) {
    q.ap_mm = q.depth_mm = depth;
    const CutAnswer a = answered(q);
    const double share = deep_slot_share(depth, 10.0);
    ASSERT_TRUE(a.feasible);
    EXPECT_LE(a.vc_m_min, share * q.vc_start_m_min * (1.0 + 1e-9));
    EXPECT_GE(a.vc_m_min, 0.98 * share * q.vc_start_m_min);
    EXPECT_LE(a.fz_mm, share * q.fz_start_mm * (1.0 + 1e-6));
    EXPECT_GE(a.fz_mm, 0.98 * share * q.fz_start_mm);
  }
}

TEST_F(CutLimits, KeepsOutOfTheLobesThatTheModesTell) {
  CutQuestion q = questions::roughing();
  q.machine.modes = {{"", "x", 700.0, 0.03, 8000.0}, {"", "y", 700.0, 0.03, 8000.0}};
  const CutAnswer free = answered(questions::roughing());
  const CutAnswer a = answered(q);
  ASSERT_TRUE(a.feasible);
  const auto allowed = stable_depth(q, a.ae_mm, a.fz_mm, a.n_rpm);
  ASSERT_TRUE(allowed);
  EXPECT_LE(a.ap_mm, *allowed * (1.0 + 1e-9));
  // The lobes of the mean chip's specific force, in the direction that allows less; fewer than one and a half
  // teeth are in the cut (4 phi / 2 pi for a width of at most 0.65 D), so that their margin counts.
  const auto law = mechanics::force_law(q.material, q.cutter);
  const double kc =
      law.uncertainty_factor *
      mechanics::specific_force_n_mm2(law.kienzle, mechanics::mean_chip_thickness_mm(a.fz_mm, a.ae_mm, 10.0));
  double least = 1e300;
  for (const auto d : {mechanics::CutDirection::kUp, mechanics::CutDirection::kDown}) {
    const mechanics::ChatterCut chatter{.arc = mechanics::immersion_arc(a.ae_mm, 10.0, d),
                                        .teeth = 4,
                                        .ktc_n_mm2 = kc,
                                        .krc_n_mm2 = mechanics::kRadialToTangentialRatio * kc};
    const auto lobes = mechanics::StabilityLobes::make(q.machine.modes, chatter);
    ASSERT_TRUE(lobes);
    least = std::min(least, mechanics::kSingleToothMargin * lobes->limit_mm(a.n_rpm));
  }
  EXPECT_NEAR(*allowed, least, 1e-9 * least);
  const auto before = stable_depth(q, free.ae_mm, free.fz_mm, free.n_rpm);
  ASSERT_TRUE(before);
  EXPECT_GT(free.ap_mm, *before);  // else this shows nothing
  // A depth that is given and chatters at every speed is said to.
  q.ap_mm = 12.0;
  q.ae_mm = 6.0;
  const CutAnswer never = answered(q);
  EXPECT_FALSE(never.feasible);
}

// Chatter grows with the slope of a law of force, which is less than the whole: what cases say of Kienzle's
// law allows no deeper a cut by its form.
TEST(StableDepth, OfKienzlesLawAsCasesCorrectItIsByTheWholeForceToo) {
  CutQuestion q = questions::roughing();
  q.machine.modes = {{"", "x", 700.0, 0.03, 8000.0}, {"", "y", 700.0, 0.03, 8000.0}};
  constexpr double kAe = 3.0, kFz = 0.06, kRpm = 4000.0, kFactor = 1.0;
  q.cutter.cutter_class = model::CutterClass::kFacemill;  // without a rake, as the corrected law
  const auto by_card = stable_depth(q, kAe, kFz, kRpm);
  const double spread = mechanics::force_margin(q.material, q.cutter.substrate).spread;
  const double chip = mechanics::mean_chip_thickness_mm(kFz, kAe, 10.0);
  mechanics::SetCorrection by;
  by.factor = kFactor;
  by.spread = spread;
  by.chip_mm = chip;
  by.source.assign(model::kByCases);
  q.material.mechanistic.push_back(mechanics::corrected_set(q.material, q.cutter.substrate, by));
  const auto by_cases = stable_depth(q, kAe, kFz, kRpm);
  ASSERT_TRUE(by_card && by_cases);
  EXPECT_NEAR(*by_cases, *by_card, 1e-9 * *by_card);
}

}  // namespace
}  // namespace capstan::optimise
