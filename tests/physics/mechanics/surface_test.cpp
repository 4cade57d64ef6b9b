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
  EXPECT_NEAR(wall_ra_mm(fz, 2.0 * radius), 0.0321 * fz * fz / radius, 5e-4 * fz * fz / radius);
}

TEST(WallRoughness, IsAQuarterUnderTheFormulaOfToloueiRadAndBidhendi) {
  // Their 318 fz^2 / (4 d) um is 24 % above 0.0321 fz^2 / R [M] for the constant, [C] for the ratio.
  const double theirs = 318e-3 * 0.2 * 0.2 / (4.0 * 10.0);
  EXPECT_NEAR(theirs / wall_ra_mm(0.2, 10.0), 1.24, 0.005);
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

TEST(Scallop, HeightAndStepoverReverseEachOther) {
  for (const double h : {1e-9, 1e-4, 0.01, 0.5, 3.0}) {
    EXPECT_NEAR(scallop_height_mm(stepover_for_scallop_mm(h, 3.0), 3.0) / h, 1.0, 1e-7);
  }
  EXPECT_NEAR(scallop_height_mm(1.0, 3.0), 3.0 - std::sqrt(9.0 - 0.25), 1e-15);
}

TEST(Scallop, ApproximationErrsByItsStatedPart) {
  for (const double s : {0.1, 0.3, 1.0}) {
    const double exact = scallop_height_mm(s, 3.0);
    const double q = s / 12.0;
    EXPECT_NEAR(1.0 - scallop_height_approx_mm(s, 3.0) / exact, q * q, 3.0 * q * q * q * q + 1e-14);
  }
  EXPECT_GT(stepover_for_scallop_approx_mm(0.01, 3.0), stepover_for_scallop_mm(0.01, 3.0));
}

TEST(FacedSurface, IsTheTriangleOfLeadAndClearance) {
  const double lead = std::numbers::pi / 4.0;
  const double clearance = 5.0 * std::numbers::pi / 180.0;
  const double rz = faced_rz_mm(0.1, lead, clearance);
  EXPECT_NEAR(rz * std::tan(lead) + rz / std::tan(clearance), 0.1, 1e-15);
}

TEST(DrilledCone, OfA118DegreePointIsPoint3Diameters) {
  EXPECT_NEAR(drilled_cone_mm(10.0, 118.0 * std::numbers::pi / 180.0), 3.004, 5e-4);
}

TEST(SurfaceWithRunout, LiesBetweenTheMarksOfAllTeethAndOfOne) {
  const double mark = wall_rz_mm(0.1, 10.0);
  EXPECT_DOUBLE_EQ(rz_with_runout_mm(mark, 4, 0.0), mark);
  EXPECT_DOUBLE_EQ(rz_with_runout_mm(mark, 4, 0.001), mark + 0.001);
  EXPECT_DOUBLE_EQ(rz_with_runout_mm(mark, 4, 1.0), wall_rz_mm(0.4, 10.0));
  EXPECT_DOUBLE_EQ(rz_with_runout_mm(mark, 1, 1.0), mark);
  EXPECT_NEAR(rz_with_runout_mm(floor_rz_mm(0.1, 0.8), 3, 0.1), floor_rz_mm(0.3, 0.8), 1e-15);
}

TEST(FloorTilt, LeavesStepsAcrossAndAHollowAlong) {
  EXPECT_NEAR(floor_step_mm(6.0, -1e-3), 6e-3, 1e-8);
  // The rim of a circle of 50 mm that leans by 1e-3: its side stands 25 um above its lowest point.
  EXPECT_NEAR(floor_hollow_mm(50.0, 50.0, 1e-3), 0.025, 1e-7);
  EXPECT_NEAR(floor_hollow_mm(30.0, 50.0, 1e-3), 25.0 * 1e-3 * (1.0 - 0.8), 1e-7);
  EXPECT_EQ(floor_hollow_mm(0.0, 50.0, 1e-3), 0.0);
}

TEST(FloorOfFlatTeeth, IsTheFeedTimesTheTangentOfTheEndClearance) {
  EXPECT_NEAR(faced_rz_mm(0.1, 0.0, 0.05), 0.1 * std::tan(0.05), 1e-15);
}

}  // namespace
}  // namespace capstan::mechanics
