#include "planner/physics/mechanics/force/immersion.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace capstan::mechanics {
namespace {

constexpr double kPi = std::numbers::pi;

TEST(ImmersionAngle, StaysWithinItsStatedErrorFromGrazingToSlot) {
  // Widths crowd towards both ends of the range: 1e-16 D .. D - 1e-16 D.
  for (double e = -16.0; e <= -0.01; e += 0.01) {
    for (const double x : {std::pow(10.0, e), 1.0 - std::pow(10.0, e)}) {
      const double width = 10.0 * x;
      if (width >= 10.0) continue;
      const long double w = width;
      const long double exact = 2.0L * std::atan2(std::sqrt(w), std::sqrt(10.0L - w));
      const double phi = immersion_angle_rad(width, 10.0);
      EXPECT_LE(std::abs(static_cast<double>(phi / exact - 1.0L)), kImmersionError) << width;
    }
  }
}

TEST(ImmersionAngle, IsZeroAtNothingAndPiInASlot) {
  EXPECT_EQ(immersion_angle_rad(0.0, 12.0), 0.0);
  EXPECT_DOUBLE_EQ(immersion_angle_rad(12.0, 12.0), kPi);
  EXPECT_DOUBLE_EQ(immersion_angle_rad(6.0, 12.0), kPi / 2.0);
}

TEST(ImmersionArc, OfDownMillingIsThatOfUpMillingMirrored) {
  const auto up = immersion_arc(3.0, 12.0, CutDirection::kUp);
  const auto down = immersion_arc(3.0, 12.0, CutDirection::kDown);
  EXPECT_DOUBLE_EQ(up.entry_rad, 0.0);
  EXPECT_DOUBLE_EQ(up.exit_rad, std::acos(1.0 - 2.0 * 3.0 / 12.0));
  EXPECT_DOUBLE_EQ(down.entry_rad, kPi - up.exit_rad);
  EXPECT_DOUBLE_EQ(down.exit_rad, kPi);
}

TEST(ChipThickness, MatchesTheTableOfRadialThinning) {
  // [C] r, h_max / fz, h_mean / fz to the digits of the table.
  constexpr double kTable[][3] = {{0.02, 0.28, 0.1409}, {0.05, 0.4359, 0.2217}, {0.1, 0.6, 0.3108},
                                  {0.2, 0.8, 0.4314},   {0.5, 1.0, 0.6366},     {1.0, 1.0, 0.6366}};
  for (const auto& row : kTable) {
    const double ae = row[0] * 10.0;
    EXPECT_NEAR(max_chip_thickness_mm(1.0, ae, 10.0), row[1], 5e-5) << row[0];
    EXPECT_NEAR(mean_chip_thickness_mm(1.0, ae, 10.0), row[2], 5e-5) << row[0];
  }
}

TEST(ChipThickness, DoesNotFallAgainBeyondHalfImmersion) {
  for (double r = 0.5; r <= 1.0; r += 0.01) EXPECT_EQ(max_chip_thickness_mm(0.1, r * 8.0, 8.0), 0.1) << r;
}

TEST(ChipThickness, MeanIsTheIntegralOverTheArc) {
  // h = fz sin(a): (1 - cos phi) / phi.
  for (const double ae : {0.1, 1.0, 4.0, 7.5, 10.0}) {
    const double phi = immersion_angle_rad(ae, 10.0);
    EXPECT_NEAR(mean_chip_thickness_mm(0.2, ae, 10.0), 0.2 * (1.0 - std::cos(phi)) / phi, 1e-15);
  }
}

TEST(EffectiveDiameter, OfABallIsTheChordAtItsDepth) {
  for (const double ap : {0.1, 1.0, 2.9}) {
    EXPECT_DOUBLE_EQ(effective_diameter_mm(ap, 6.0, 3.0), 2.0 * std::sqrt(ap * (6.0 - ap)));
  }
  EXPECT_DOUBLE_EQ(effective_diameter_mm(3.0, 6.0, 3.0), 6.0);
  EXPECT_DOUBLE_EQ(effective_diameter_mm(5.0, 6.0, 3.0), 6.0);
  EXPECT_DOUBLE_EQ(effective_diameter_mm(0.5, 50.0, 0.0), 50.0);
}

TEST(EngagedTeeth, AreTheShareOfTheTurnInTheMaterial) { EXPECT_DOUBLE_EQ(mean_engaged_teeth(4, kPi), 2.0); }

}  // namespace
}  // namespace capstan::mechanics
