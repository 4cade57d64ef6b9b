#include "planner/proof/verify/sweep/target/resting_ball.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace capstan::verify {
namespace {

constexpr double kCell = 0.05, kRadius = 3.0;

/// A part of these heights, 20 x 4 mm, its middle at x = 0.
template <class F>
Grid part(const F& height) {
  Grid grid({-10, -2}, {10, 2}, kCell, 1000000);
  for (int iy = 0; iy < grid.ny(); ++iy) {
    for (int ix = 0; ix < grid.nx(); ++ix) {
      const geometry::Vec2 p = grid.centre(ix, iy);
      grid.part[grid.index(ix, iy)] = height(p.x, p.y);
    }
  }
  return grid;
}

// A ball in a V of an angle of 2 a has its middle r / sin(a) above the bottom.
TEST(RestingBalls, InAValleyReachAsDeepAsTheCircleThatTouchesBothSides) {
  for (const double degrees : {30.0, 45.0, 60.0, 90.0, 120.0, 160.0}) {
    const double half = 0.5 * degrees / 180.0 * std::numbers::pi;
    const Grid grid = part([&](double x, double) { return std::abs(x) / std::tan(half); });
    RestingBalls balls(grid, kRadius);
    const double deepest = kRadius / std::sin(half) - kRadius;
    // Heights beside the bottom of a cell rise by a cell over the tangent.
    const double doubt = 1.5 * kCell / std::tan(half);
    for (const double above : {0.3, 1.0, 2.0}) {
      const geometry::Vec3 place{0.0, 0.0, deepest + above};
      EXPECT_TRUE(balls.reaches(place, kRadius - above + doubt)) << degrees << " " << above;
      EXPECT_FALSE(balls.reaches(place, kRadius - above - kCell)) << degrees << " " << above;
    }
    EXPECT_FALSE(balls.reaches({0.0, 0.0, deepest - doubt - kCell}, kRadius)) << degrees;
  }
}

TEST(RestingBalls, DoNotEnterASlotNarrowerThanThey) {
  const Grid grid = part([](double x, double) { return std::abs(x) < 2.0 ? 0.0 : 10.0; });
  RestingBalls balls(grid, kRadius);
  EXPECT_FALSE(balls.reaches({0.0, 0.0, 5.0}, kRadius));
  EXPECT_TRUE(balls.reaches({0.0, 0.0, 12.9}, kRadius));
}

// On a level floor beside a wall the ball touches both: a place in the corner is out of its reach.
TEST(RestingBalls, BesideAWallLeaveTheCorner) {
  const Grid grid = part([](double x, double) { return x > 0.0 ? 8.0 : 0.0; });
  RestingBalls balls(grid, kRadius);
  const double corner = kRadius * (1.0 - std::sqrt(0.5));  // of the circle, from wall and floor
  EXPECT_FALSE(balls.reaches({-corner + 2.0 * kCell, 0.0, corner - 2.0 * kCell}, kRadius));
  EXPECT_TRUE(balls.reaches({-corner - 2.0 * kCell, 0.0, corner + 2.0 * kCell}, kRadius));
  EXPECT_TRUE(balls.reaches({-0.2, 0.0, 5.0}, kRadius)) << "along the wall it goes";
}

}  // namespace
}  // namespace capstan::verify
