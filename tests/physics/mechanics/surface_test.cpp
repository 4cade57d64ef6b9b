#include "planner/physics/mechanics/surface.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace capstan::mechanics {
namespace {

TEST(WallRoughness, IsTheUsualFormulaOfFeedAndRadius) {
  const double fz = 0.2;
  const double radius = 6.0;
  EXPECT_NEAR(wall_rz_mm(fz, 2.0 * radius), fz * fz / (8.0 * radius), 1e-18);
  EXPECT_NEAR(kArcRaOverRz * wall_rz_mm(fz, 2.0 * radius), 0.0321 * fz * fz / radius,
              5e-4 * fz * fz / radius);
}

TEST(WallRoughness, IsAQuarterUnderTheFormulaOfToloueiRadAndBidhendi) {
  // Their 318 fz^2 / (4 d) um is 24 % above 0.0321 fz^2 / R [M] for the constant, [C] for the ratio.
  const double theirs = 318e-3 * 0.2 * 0.2 / (4.0 * 10.0);
  EXPECT_NEAR(theirs / (kArcRaOverRz * wall_rz_mm(0.2, 10.0)), 1.24, 0.005);
}

TEST(WallRoughness, RaOverRzIsThatOfAParabola) {
  EXPECT_DOUBLE_EQ(kArcRaOverRz, 4.0 / (9.0 * std::sqrt(3.0)));
  double mean = 0.0;
  constexpr int kSteps = 100000;
  for (int i = 0; i < kSteps; ++i) {
    const double x = (i + 0.5) / kSteps;  // z = x^2, mean line 1/3
    mean += std::abs(x * x - 1.0 / 3.0) / kSteps;
  }
  EXPECT_NEAR(mean, kArcRaOverRz, 1e-9);
}

TEST(FloorRoughness, IsTheArcOfTheCornerRadius) { EXPECT_NEAR(floor_rz_mm(0.1, 0.8), 0.01 / 6.4, 1e-18); }

}  // namespace
}  // namespace capstan::mechanics
