#include "planner/making/piece/mesh/rim.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace capstan::piece {
namespace {

constexpr double kSize = 20.0, kBall = 5.0, kLeft = 0.01;

/// A sheet of 20 x 20 mm, level up to x = 15, from there falling by this angle to its rim at x = 20.
geometry::Mesh sheet(double angle_deg) {
  const double low = -5.0 * std::tan(angle_deg * std::numbers::pi / 180.0);
  geometry::Mesh m;
  m.vertices = {{0, 0, 0}, {15, 0, 0}, {15, kSize, 0}, {0, kSize, 0}, {kSize, 0, low}, {kSize, kSize, low}};
  m.triangles = {{0, 1, 2}, {0, 2, 3}, {1, 4, 5}, {1, 5, 2}};
  return m;
}

TEST(Rim, OfALevelSurfaceNeedsNoWay) {
  const auto box = box_of_axis(sheet(0.0), kBall, kBall, kLeft);
  EXPECT_EQ(box.lo, (geometry::Vec2{0.0, 0.0}));
  EXPECT_EQ(box.hi, (geometry::Vec2{kSize, kSize}));
}

TEST(Rim, ThatFallsIsPassedByTheSineOfTheSlopeTimesTheBallsRadius) {
  const auto box = box_of_axis(sheet(30.0), kBall, kBall, kLeft);
  EXPECT_NEAR(box.hi.x, kSize + 0.5 * kBall, 1e-9);
  EXPECT_NEAR(box.lo.x, 0.0, 1e-9);
  EXPECT_NEAR(box.hi.y, kSize, 1e-9);
}

TEST(Rim, IsPassedByTheFlatPartOfABullNoseToo) {
  EXPECT_NEAR(box_of_axis(sheet(30.0), kBall, 2.0, kLeft).hi.x, kSize + (kBall - 2.0) + 0.5 * 2.0, 1e-9);
}

TEST(Rim, ThatRisesOutwardsIsTouchedFromWithin) {
  EXPECT_NEAR(box_of_axis(sheet(-30.0), kBall, kBall, kLeft).hi.x, kSize, 1e-9);
}

TEST(Rim, IsNotPassedWhereNoMoreStaysThanMay) {
  // 5 (1 / cos 3 deg - 1) = 0.0069 mm, 5 (1 / cos 4 deg - 1) = 0.0122 mm.
  EXPECT_NEAR(box_of_axis(sheet(3.0), kBall, kBall, kLeft).hi.x, kSize, 1e-9);
  EXPECT_GT(box_of_axis(sheet(4.0), kBall, kBall, kLeft).hi.x, kSize + 0.3);
}

}  // namespace
}  // namespace capstan::piece
