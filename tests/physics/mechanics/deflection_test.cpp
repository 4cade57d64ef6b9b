#include "planner/physics/mechanics/bending/deflection.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "planner/physics/mechanics/constants.h"

namespace capstan::mechanics {
namespace {

ToolStiffness end_mill() {
  return {.stickout_mm = 40.0,
          .shank_diameter_mm = 12.0,
          .flute_length_mm = 26.0,
          .cutting_diameter_mm = 12.0,
          .youngs_modulus_n_mm2 = kCarbideYoungsModulusNMm2};
}

TEST(TipCompliance, OfAToolFlutedToTheHolderIsThatOfTheEquivalentCylinder) {
  ToolStiffness tool = end_mill();
  tool.flute_length_mm = 60.0;
  const double d = 0.8 * 12.0;
  const double moment = std::numbers::pi * d * d * d * d / 64.0;
  EXPECT_NEAR(*tip_compliance_mm_n(tool), 40.0 * 40.0 * 40.0 / (3.0 * kCarbideYoungsModulusNMm2 * moment),
              1e-15);
}

TEST(TipCompliance, OfTwoStepsIsTheIntegralAlongTheTool) {
  const ToolStiffness tool = end_mill();
  double sum = 0.0;
  constexpr int kSteps = 40000;
  for (int i = 0; i < kSteps; ++i) {
    const double x = tool.stickout_mm * (i + 0.5) / kSteps;  // from the tip
    const double d = x < tool.flute_length_mm ? 0.8 * 12.0 : 12.0;
    sum += x * x / (tool.youngs_modulus_n_mm2 * std::numbers::pi * std::pow(d, 4) / 64.0) * tool.stickout_mm /
           kSteps;
  }
  EXPECT_NEAR(*tip_compliance_mm_n(tool) / sum, 1.0, 1e-6);
}

TEST(TipCompliance, GrowsEightfoldWhenEveryLengthDoubles) {
  ToolStiffness tool = end_mill();
  const double once = *tip_compliance_mm_n(tool);
  tool.stickout_mm *= 2.0;
  tool.flute_length_mm *= 2.0;
  EXPECT_NEAR(*tip_compliance_mm_n(tool) / once, 8.0, 1e-12);
}

TEST(TipCompliance, RefusesAToolWithoutDimensions) {
  ToolStiffness tool = end_mill();
  tool.shank_diameter_mm = 0.0;
  EXPECT_EQ(tip_compliance_mm_n(tool).error().path, "shank_diameter_mm");
}

}  // namespace
}  // namespace capstan::mechanics
