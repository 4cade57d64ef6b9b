#include "planner/ground/geometry/profile.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

namespace capstan::geometry {
namespace {

using std::numbers::pi;

constexpr double kRounding = 1e-12;  // of sizes of some 10 mm

TEST(FlatProfile, IsAtItsTipHeightToItsRadiusAndNowhereBeyond) {
  const CutterProfile p = flat_profile(10.0, 22.0);
  EXPECT_EQ(p.radius_mm, 5.0);
  EXPECT_EQ(p.cutting_length_mm, 22.0);
  for (const double r : {0.0, 2.5, 5.0}) EXPECT_EQ(p.height(r), 0.0);
  EXPECT_TRUE(std::isinf(p.height(5.0 + 1e-9)));
  EXPECT_TRUE(is_flat(p));
}

TEST(BallProfile, IsHalfASphereThatStandsOnItsTip) {
  const CutterProfile p = ball_profile(10.0, 22.0);
  // 3, 4, 5: 4 mm off the axis the surface is 3 mm below the centre, which is 5 mm up.
  EXPECT_NEAR(p.height(4.0), 5.0 - 3.0, kRounding);
  EXPECT_NEAR(p.height(3.0), 5.0 - 4.0, kRounding);
  EXPECT_EQ(p.height(0.0), 0.0);
  EXPECT_EQ(p.height(5.0), 5.0);
  EXPECT_FALSE(is_flat(p));
}

TEST(BullProfile, IsFlatWithinItsCornerAndRoundAtIt) {
  const CutterProfile p = bull_profile(20.0, 5.0, 30.0);
  EXPECT_EQ(p.height(5.0), 0.0);
  EXPECT_NEAR(p.height(8.0), 5.0 - 4.0, kRounding);  // 3 mm out from the corner's centre
  EXPECT_EQ(p.height(10.0), 5.0);
  EXPECT_FALSE(is_flat(p));
}

TEST(BullProfile, IsAFlatOneWithoutACornerAndABallWithOneOfItsRadiusOrMore) {
  EXPECT_EQ(bull_profile(10.0, 0.0, 20.0), flat_profile(10.0, 20.0));
  EXPECT_EQ(bull_profile(10.0, -1.0, 20.0), flat_profile(10.0, 20.0));
  EXPECT_EQ(bull_profile(10.0, 5.0, 20.0), ball_profile(10.0, 20.0));
  EXPECT_EQ(bull_profile(10.0, 6.0, 20.0), ball_profile(10.0, 20.0));
}

TEST(ConeProfile, RisesByItsHalfAngleFromItsTip) {
  const CutterProfile sharp = cone_profile(10.0, 0.5 * pi, 20.0);  // 90 degrees: as high as wide
  EXPECT_NEAR(sharp.height(5.0), 5.0, kRounding);
  EXPECT_EQ(sharp.height(0.0), 0.0);
  const CutterProfile drill = cone_profile(10.0, 118.0 * pi / 180.0, 60.0);
  EXPECT_NEAR(drill.height(5.0), 5.0 / std::tan(59.0 * pi / 180.0), kRounding);
  const CutterProfile flat_tip = cone_profile(10.0, 0.5 * pi, 20.0, 4.0);
  EXPECT_EQ(flat_tip.height(2.0), 0.0);
  EXPECT_NEAR(flat_tip.height(5.0), 3.0, kRounding);
  EXPECT_TRUE(is_flat(cone_profile(10.0, 0.5 * pi, 20.0, 10.0))) << "the tip as wide as the cutter";
}

TEST(RoundingProfile, IsTheRoundOfAnEdgeFromItsTipOutwards) {
  const CutterProfile p = rounding_profile(9.0, 2.0, 4.0);
  EXPECT_EQ(p.radius_mm, 4.5);
  EXPECT_EQ(p.height(2.5), 0.0);
  EXPECT_NEAR(p.height(4.5), 2.0, kRounding);
  // The edge's round is a circle about a place 2 mm inside the wall, which the tip runs along, at the tip's
  // height.
  for (double inside = 0.01; inside < 2.0; inside += 0.01) {
    const double round = std::sqrt(4.0 - (2.0 - inside) * (2.0 - inside));
    const double height = p.height(2.5 + inside);
    EXPECT_LE(height, round + kRounding) << inside;
    // What a chord of a tenth of a quarter turn lies below its arc, in the direction of the radius.
    EXPECT_GE(std::hypot(2.0 - inside, height), 2.0 * std::cos(4.5 * pi / 180.0) - kRounding) << inside;
  }
  EXPECT_FALSE(convex_outline(p));
}

TEST(RadiusAt, IsWhereTheSurfaceReachesAHeight) {
  EXPECT_NEAR(ball_profile(10.0, 20.0).radius_at(2.0), 4.0, kRounding);
  EXPECT_NEAR(bull_profile(20.0, 5.0, 30.0).radius_at(1.0), 8.0, kRounding);
  EXPECT_NEAR(cone_profile(10.0, 0.5 * pi, 20.0, 4.0).radius_at(1.5), 3.5, kRounding);
  EXPECT_EQ(flat_profile(10.0, 20.0).radius_at(0.0), 5.0);
  EXPECT_EQ(ball_profile(10.0, 20.0).radius_at(100.0), 5.0) << "at most the cutter's";
  EXPECT_EQ(ball_profile(10.0, 20.0).radius_at(-0.1), 0.0) << "below the tip there is nothing";
}

CutterProfile random_profile(std::mt19937& random) {
  std::uniform_real_distribution<double> size(1.0, 30.0), share(0.0, 1.0);
  const double d = size(random);
  switch (random() % 4) {
    case 0:
      return ball_profile(d, 40.0);
    case 1:
      return bull_profile(d, 0.5 * d * share(random), 40.0);
    case 2:
      return cone_profile(d, (0.1 + 0.8 * share(random)) * pi, 40.0);
    default:
      return cone_profile(d, (0.1 + 0.8 * share(random)) * pi, 40.0, d * share(random));
  }
}

TEST(ProfileProperty, HasPiecesWithoutGapsThatDoNotFall) {
  std::mt19937 random(1);
  for (int i = 0; i < 500; ++i) {
    const CutterProfile p = random_profile(random);
    double r = 0.0, before = 0.0;
    for (const ProfilePiece& piece : p.pieces) {
      EXPECT_EQ(piece.r0_mm, r);
      r = piece.r1_mm;
    }
    EXPECT_EQ(r, p.radius_mm);
    EXPECT_EQ(p.height(0.0), 0.0);
    for (int k = 0; k <= 200; ++k) {
      const double h = p.height(p.radius_mm * k / 200.0);
      EXPECT_GE(h, before - kRounding);
      before = h;
    }
  }
}

TEST(ProfileProperty, ItsRadiusAtAHeightIsTheLargestThatIsNoHigher) {
  // By halving the radius from the axis to the edge, for the surface does not fall.
  std::mt19937 random(2);
  std::uniform_real_distribution<double> share(0.0, 1.2);
  for (int i = 0; i < 2000; ++i) {
    const CutterProfile p = random_profile(random);
    const double at = share(random) * p.height(p.radius_mm);
    double lo = 0.0, hi = p.radius_mm;
    if (p.height(hi) <= at) lo = hi;
    for (int k = 0; k < 60; ++k) {
      const double middle = 0.5 * (lo + hi);
      (p.height(middle) <= at ? lo : hi) = middle;
    }
    EXPECT_NEAR(p.radius_at(at), lo, 1e-9 * p.radius_mm) << i;
  }
}

}  // namespace
}  // namespace capstan::geometry
