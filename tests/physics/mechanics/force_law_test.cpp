#include "planner/physics/mechanics/force_law.h"

#include <gtest/gtest.h>

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

TEST(ForceLaw, TakesTheFirstMeasuredSetOfTheSubstrate) {
  const ForceLaw carbide = force_law(aluminium(), model::Substrate::kCarbide);
  ASSERT_TRUE(carbide.mechanistic);
  EXPECT_EQ(carbide.mechanistic->ktc_n_mm2, 767.0);
  EXPECT_EQ(carbide.mechanistic->kae_n_mm, 0.7);
  EXPECT_EQ(carbide.kienzle.kc11_n_mm2, 641.0);
  EXPECT_DOUBLE_EQ(carbide.uncertainty_factor, 1.72);
  EXPECT_EQ(force_law(aluminium(), model::Substrate::kHss).mechanistic->ktc_n_mm2, 951.0);
}

TEST(ForceLaw, IsKienzlesWithoutAMeasuredSet) {
  model::WorkMaterial m = aluminium();
  m.mechanistic.clear();
  EXPECT_FALSE(force_law(m, model::Substrate::kCarbide).mechanistic);
  EXPECT_DOUBLE_EQ(force_law(m, model::Substrate::kCarbide).uncertainty_factor, kForceUncertaintyFactor);
}

TEST(ForceMargin, IsTheSpreadOfTheCoefficientsTimesWear) {
  model::WorkMaterial m = aluminium();
  EXPECT_DOUBLE_EQ(force_margin(m, model::Substrate::kCarbide).factor(), 1.72 * kWearForceFactor);
  m.mechanistic.erase(m.mechanistic.begin() + 1);  // leaves a set that states no uncertainty
  EXPECT_DOUBLE_EQ(force_margin(m, model::Substrate::kCarbide).spread, kForceUncertaintyFactor);
  m.kc_uncertainty = 0.9;
  EXPECT_DOUBLE_EQ(kienzle_margin(m).spread, 1.9);
}

TEST(ToothOfACutter, HasTheCornerOfABall) {
  model::Cutter c;
  c.cutting_diameter_mm = 8.0;
  c.cutter_class = model::CutterClass::kBallEndmill;
  EXPECT_EQ(tooth_of(c).corner_radius_mm, 4.0);
  EXPECT_EQ(tooth_of(c).teeth, 1);
}

}  // namespace
}  // namespace capstan::mechanics
