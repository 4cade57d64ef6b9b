#include "planner/ground/geometry/profile.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace capstan::geometry {
namespace {

TEST(Profile, OfAFlatCutterIsItsPlaneUpToTheRim) {
  const CutterProfile p = flat_profile(10.0, 20.0);
  EXPECT_EQ(p.height(0.0), 0.0);
  EXPECT_EQ(p.height(5.0), 0.0);
  EXPECT_TRUE(std::isinf(p.height(5.001)));
  EXPECT_EQ(p.radius_at(0.0), 5.0);
  EXPECT_EQ(p.cutting_length_mm, 20.0);
}

// A sphere of radius 5 on its tip: z = 5 - sqrt(25 - r^2), so 1 mm at r = 3 and 5 mm at the rim.
TEST(Profile, OfABallIsItsSphere) {
  const CutterProfile p = ball_profile(10.0, 20.0);
  EXPECT_DOUBLE_EQ(p.height(0.0), 0.0);
  EXPECT_DOUBLE_EQ(p.height(3.0), 1.0);
  EXPECT_DOUBLE_EQ(p.height(5.0), 5.0);
  EXPECT_DOUBLE_EQ(p.radius_at(1.0), 3.0);
  EXPECT_EQ(p.radius_at(100.0), 5.0);
}

// Flat to r = 3, then the quarter of a circle of 2 mm: at r = 4.6, 1.6 out of its centre, 2 - sqrt(4 - 2.56).
TEST(Profile, OfABullNoseIsFlatAndThenRound) {
  const CutterProfile p = bull_profile(10.0, 2.0, 20.0);
  EXPECT_EQ(p.height(3.0), 0.0);
  EXPECT_DOUBLE_EQ(p.height(4.6), 2.0 - 1.2);
  EXPECT_DOUBLE_EQ(p.height(5.0), 2.0);
  EXPECT_NEAR(p.radius_at(0.8), 4.6, 1e-12);
  EXPECT_EQ(bull_profile(10.0, 0.0, 20.0), flat_profile(10.0, 20.0));
  EXPECT_EQ(bull_profile(10.0, 9.0, 20.0), ball_profile(10.0, 20.0)) << "no corner is wider than the radius";
}

// 90 degrees: as high as it is wide; a flat tip of 2 mm shifts it out by 1.
TEST(Profile, OfAConeRisesByThePointAngle) {
  const double right = std::numbers::pi / 2.0;
  const CutterProfile sharp = cone_profile(10.0, right, 20.0);
  EXPECT_NEAR(sharp.height(4.0), 4.0, 1e-12);
  EXPECT_NEAR(sharp.radius_at(4.0), 4.0, 1e-12);
  const CutterProfile blunt = cone_profile(10.0, right, 20.0, 2.0);
  EXPECT_EQ(blunt.height(1.0), 0.0);
  EXPECT_NEAR(blunt.height(4.0), 3.0, 1e-12);
  EXPECT_EQ(blunt.radius_at(0.0), 1.0);
}

TEST(Profile, HeightAndRadiusUndoEachOtherWhereTheSurfaceRises) {
  for (const CutterProfile& p : {ball_profile(6.0, 10.0), bull_profile(12.0, 3.0, 10.0),
                                 cone_profile(8.0, 2.0, 10.0), cone_profile(8.0, 1.0, 10.0, 1.0)}) {
    const double highest = p.height(p.radius_mm);
    for (int i = 1; i < 20; ++i) {
      const double z = highest * i / 20.0;
      EXPECT_NEAR(p.height(p.radius_at(z)), z, 1e-9);
    }
  }
}

}  // namespace
}  // namespace capstan::geometry
