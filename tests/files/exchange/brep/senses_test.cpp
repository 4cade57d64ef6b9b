#include "planner/files/exchange/brep/helper/senses.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

namespace capstan::exchange {
namespace {

using geometry::Vec3;
constexpr double kPi = std::numbers::pi;

Vec3 unit(std::mt19937& random) {
  std::normal_distribution<double> n;
  return geometry::normalised({n(random), n(random), n(random)});
}

// Two half planes that bound a wedge of material, turned anyhow: the angle is the wedge's.
TEST(EdgeAngle, IsThatOfTheWedgeWhereverItStands) {
  std::mt19937 random(1);
  for (int i = 0; i < 2000; ++i) {
    const double wedge = std::uniform_real_distribution<double>(0.01, 2 * kPi - 0.01)(random);
    const Vec3 along = unit(random);
    const Vec3 u = geometry::normalised(cross(along, unit(random)));
    const Vec3 v = cross(along, u);
    // Material lies between u and the direction at `wedge`, counter-clockwise about `along`.
    const Vec3 other = std::cos(wedge) * u + std::sin(wedge) * v;
    const Side a{u, -1.0 * v};
    const Side b{other, cross(along, other)};
    for (const auto& [first, second] : {std::pair{a, b}, std::pair{b, a}}) {
      Edge edge;
      set_angle(first, second, edge);
      ASSERT_NEAR(edge.dihedral, wedge, 1e-9);
      const Convexity expected = std::abs(wedge - kPi) <= kSmoothAngleRad ? Convexity::kSmooth
                                 : wedge < kPi                            ? Convexity::kConvex
                                                                          : Convexity::kConcave;
      ASSERT_EQ(edge.convexity, expected) << wedge;
    }
  }
}

// The top of a block, walked counter-clockwise seen from above: the face lies on the left.
TEST(EdgeSide, LiesOnTheLeftOfTheWalk) {
  const auto side = side_of({0, 0, 1}, {5, 0, 0});
  ASSERT_TRUE(side);
  EXPECT_EQ(side->into, (Vec3{0, 1, 0}));
  EXPECT_FALSE(side_of({0, 0, 1}, {0, 0, 2}));
  EXPECT_FALSE(side_of({0, 0, 1}, {0, 0, 0}));
}

TEST(FaceSenses, ABossIsOutwardAndAHoleIsNot) {
  Face face;
  face.carrier = Carrier::kCylinder;
  face.axis = {0, 0, 1};
  face.radius = 2;
  set_senses({{2, 0, 7}, {1, 0, 0}}, face);
  EXPECT_TRUE(face.outward && face.same_sense);
  set_senses({{2, 0, 7}, {-1, 0, 0}}, face);
  EXPECT_FALSE(face.outward || face.same_sense);
}

TEST(FaceSenses, TheTubeOfATorusHasTwoWallsAndOneInside) {
  Face face;
  face.carrier = Carrier::kTorus;
  face.axis = {0, 0, 1};
  face.radius = 10;
  face.minor_radius = 2;
  set_senses({{8, 0, 0}, {-1, 0, 0}}, face);  // the inner wall of a ring
  EXPECT_TRUE(face.outward);
  set_senses({{12, 0, 0}, {1, 0, 0}}, face);  // its outer wall
  EXPECT_TRUE(face.outward);
  set_senses({{12, 0, 0}, {-1, 0, 0}}, face);  // a groove's
  EXPECT_FALSE(face.outward);
}

// x^2 + y^2 = (5 + z tan 45)^2 holds above and below its apex at z = -5.
TEST(FaceSenses, AConeStandsOnItsOwnSideOfTheApex) {
  const auto cone = [] {
    Face face;
    face.carrier = Carrier::kCone;
    face.axis = {0, 0, 1};
    face.radius = 5;
    face.half_angle = kPi / 4;
    return face;
  };
  Face above = cone();
  set_senses({{6, 0, 1}, geometry::normalised({1, 0, -1})}, above);
  EXPECT_TRUE(above.outward);
  EXPECT_EQ(above.axis, (Vec3{0, 0, 1}));
  EXPECT_EQ(above.radius, 5);
  Face below = cone();
  set_senses({{2, 0, -7}, geometry::normalised({1, 0, 1})}, below);
  EXPECT_TRUE(below.outward);
  EXPECT_EQ(below.axis, (Vec3{0, 0, -1}));
  EXPECT_NEAR(below.point.z, -5, 1e-12);
  EXPECT_EQ(below.radius, 0);
}

}  // namespace
}  // namespace capstan::exchange
