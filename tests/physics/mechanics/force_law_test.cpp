#include "planner/physics/mechanics/force/force_law.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace capstan::mechanics {
namespace {

model::WorkMaterial aluminium() {
  model::WorkMaterial m;
  m.kc11_n_mm2 = 641.0;
  m.mc = 0.27;
  m.kc_uncertainty = 0.375;
  m.mechanistic = {{"hss", 951.0, 11.0, 262.0, 11.0, 323.0, 1.0, 0.4, "a"},
                   {"carbide", 767.0, 27.7, 168.8, 26.6, 222.0, 0.7, 0.72, "b"},
                   {"carbide", 600.0, 17.9, 181.0, 20.4, 0.0, 0.0, 0.0, "c"}};
  return m;
}

model::Cutter mill(model::Substrate substrate, model::CutterClass kind = model::CutterClass::kEndmill) {
  model::Cutter c;
  c.cutter_class = kind;
  c.substrate = substrate;
  return c;
}

TEST(ForceLaw, TakesTheFirstMeasuredSetOfTheSubstrate) {
  const ForceLaw carbide = force_law(aluminium(), mill(model::Substrate::kCarbide));
  ASSERT_TRUE(carbide.mechanistic);
  EXPECT_EQ(carbide.mechanistic->ktc_n_mm2, 767.0);
  EXPECT_EQ(carbide.mechanistic->kae_n_mm, 0.7);
  EXPECT_DOUBLE_EQ(carbide.kienzle.kc11_n_mm2, 0.9 * 641.0);
  EXPECT_DOUBLE_EQ(carbide.uncertainty_factor, 1.72);
  EXPECT_EQ(force_law(aluminium(), mill(model::Substrate::kHss)).mechanistic->ktc_n_mm2, 951.0);
}

TEST(ForceLaw, IsKienzlesWithoutAMeasuredSet) {
  model::WorkMaterial m = aluminium();
  m.mechanistic.clear();
  EXPECT_FALSE(force_law(m, mill(model::Substrate::kCarbide)).mechanistic);
  EXPECT_DOUBLE_EQ(force_law(m, mill(model::Substrate::kCarbide)).uncertainty_factor,
                   kForceUncertaintyFactor);
}

// One per cent less for each of the 10 degrees of an end mill's rake; the tables are of 0 degrees.
TEST(ForceLaw, CountsTheRakeOfEndMillsAndOfNothingElse) {
  model::WorkMaterial m = aluminium();
  m.mechanistic.clear();
  const auto kc11 = [&](model::CutterClass kind) {
    return force_law(m, mill(model::Substrate::kCarbide, kind)).kienzle.kc11_n_mm2;
  };
  EXPECT_DOUBLE_EQ(kc11(model::CutterClass::kEndmill), 0.9 * 641.0);
  EXPECT_DOUBLE_EQ(kc11(model::CutterClass::kBallEndmill), 0.9 * 641.0);
  EXPECT_DOUBLE_EQ(kc11(model::CutterClass::kFacemill), 641.0);
  m.iso_group = "H";
  EXPECT_DOUBLE_EQ(kc11(model::CutterClass::kEndmill), 641.0);
}

TEST(ForceMargin, IsTheRootOfTheSquaresOfSpreadWearAndOverride) {
  model::WorkMaterial m = aluminium();
  // exp(sqrt(ln^2 1.72 + ln^2 1.3)) = exp(0.60250) = 1.8267, where the product is 2.236.
  EXPECT_NEAR(force_margin(m, model::Substrate::kCarbide).factor(), 1.8267, 5e-4);
  // With the feed turned up by a fifth, and ln 1.2 = 0.18232: exp(0.62948) = 1.8766; the product is 2.683.
  EXPECT_NEAR(force_margin(m, model::Substrate::kCarbide, {.feed_up = 1.2}).factor(), 1.8766, 5e-4);
  m.mechanistic.erase(m.mechanistic.begin() + 1);  // leaves a set that states no uncertainty
  EXPECT_DOUBLE_EQ(force_margin(m, model::Substrate::kCarbide).spread, kForceUncertaintyFactor);
  m.kc_uncertainty = 0.9;
  EXPECT_DOUBLE_EQ(kienzle_margin(m).spread, 1.9);
}

TEST(ForceMargin, OfOneCauseIsThatCause) {
  ForceMargin m{.spread = 1.0, .wear = 1.3};
  EXPECT_DOUBLE_EQ(m.factor(), 1.3);
  m.wear = 1.0;
  EXPECT_DOUBLE_EQ(m.factor(), 1.0);
}

TEST(ForceMargin, OfASteelIsMoreForTheCarefulAndLessForTheBold) {
  // Kienzle's law, mc 0.24: ln 1.5 = 0.40547, ln 1.3 = 0.26236, 0.76 ln 1.2 = 0.13856; root of the squares
  // 0.50249: 1.653 usually, at 1.6449 deviations 2.285, at 0.5244 of them 1.301. The product was 2.240.
  model::WorkMaterial m;
  m.kc11_n_mm2 = 2809.0;
  m.mc = 0.24;
  const auto of = [&](const char* name) {
    return kienzle_margin(m, {.feed_up = 1.2, .deviations = margin_policy(name)->deviations}).factor();
  };
  EXPECT_NEAR(of("careful"), 2.285, 2e-3);
  EXPECT_NEAR(of("usual"), 1.653, 1e-3);
  EXPECT_NEAR(of("bold"), 1.301, 1e-3);
  EXPECT_FALSE(margin_policy("none"));
}

TEST(LeastChip, IsAPartOfTheEdgesRadiusAndLessForSmallCutters) {
  EXPECT_DOUBLE_EQ(least_chip_mm(10.0, false), 0.0024);
  EXPECT_DOUBLE_EQ(least_chip_mm(10.0, true), 0.0036);
  EXPECT_DOUBLE_EQ(least_chip_mm(1.0, false), 0.001);
  EXPECT_NEAR(least_chip_mm(10.0, false, "S"), 0.008, 1e-15);
  EXPECT_NEAR(least_chip_mm(10.0, false, "P"), 0.0024, 1e-15);
}

TEST(ToothOfACutter, HasTheCornerOfABall) {
  model::Cutter c;
  c.cutting_diameter_mm = 8.0;
  c.cutter_class = model::CutterClass::kBallEndmill;
  EXPECT_EQ(tooth_of(c).corner_radius_mm, 4.0);
  EXPECT_EQ(tooth_of(c).teeth, 1);
}

TEST(CorrectedSet, ScalesTheCardsSetAndStatesTheSpreadOfTheEvidence) {
  model::WorkMaterial m = aluminium();
  const model::MechanisticSet before = *measured_set(m, model::Substrate::kCarbide);
  const auto set = corrected_set(m, model::Substrate::kCarbide,
                                 {.factor = 0.8, .spread = 1.15, .chip_mm = 0.05, .source = "18 cases"});
  EXPECT_DOUBLE_EQ(set.ktc_n_mm2, 0.8 * before.ktc_n_mm2);
  EXPECT_DOUBLE_EQ(set.kre_n_mm, 0.8 * before.kre_n_mm);
  m.mechanistic.insert(m.mechanistic.begin(), set);
  EXPECT_NEAR(force_margin(m, model::Substrate::kCarbide).spread, 1.15, 1e-12);
  EXPECT_NE(force_source(m, model::Substrate::kCarbide, true).find("18 cases"), std::string::npos);
}

TEST(CorrectedSet, IsNowhereBelowKienzlesLawTimesTheFactorAndMeetsItAtTheChipObserved) {
  model::WorkMaterial m;
  m.kc11_n_mm2 = 1800.0;
  m.mc = 0.25;
  constexpr double kChip = 0.05, kFactor = 0.8;
  const auto set = corrected_set(m, model::Substrate::kHss,
                                 {.factor = kFactor, .spread = 1.2, .chip_mm = kChip, .source = {}});
  const auto by_set = [&](double h) { return set.ktc_n_mm2 * h + set.kte_n_mm; };
  const auto by_kienzle = [&](double h) { return kFactor * m.kc11_n_mm2 * std::pow(h, 1.0 - m.mc); };
  EXPECT_NEAR(by_set(kChip), by_kienzle(kChip), 1e-9 * by_kienzle(kChip));
  // Of the axial force, too, whose edge share has its own coefficient: the mills' steepest helix is 45
  // degrees.
  const auto axial_by_set = [&](double h) { return set.kac_n_mm2 * h + set.kae_n_mm; };
  for (double h = 0.001; h < 1.0; h *= 1.3) {
    EXPECT_GE(by_set(h), by_kienzle(h) * (1.0 - 1e-12)) << h;
    EXPECT_GE(axial_by_set(h), kAxialToTangentialRatio * by_kienzle(h) * (1.0 - 1e-12)) << h;
  }
  EXPECT_EQ(set.substrate, "hss");
}

}  // namespace
}  // namespace capstan::mechanics
