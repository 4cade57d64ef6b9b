#include "planner/proof/verify/sweep/grid/way.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace capstan::verify {
namespace {

using geometry::Vec2;

constexpr double kRad = std::numbers::pi / 180.0;
constexpr double kBall = 5.0, kLayer = 0.25, kAdvance = 0.2;

/// The thickest chip on a line along a slope that rises towards +x, the layer measured square to it, over
/// points on the line and beside it.
double thickest(double slope_rad, double way) {
  const CutterOutline outline(geometry::ball_profile(2.0 * kBall, 30.0));
  const double rise = std::tan(slope_rad);
  const auto surface = [&](double x) { return rise * x; };
  const auto tip = [&](double x) {
    return geometry::Vec3{x, 0.0, surface(x) + (kBall - kLayer) / std::cos(slope_rad) - kBall};
  };
  Move m;
  m.kind = model::MoveKind::kLine;
  m.from = tip(-20.0 * way);
  m.to = tip(20.0 * way);
  const LineWay line(outline, m);
  double most = 0.0;
  for (double x = -8.0; x <= 8.0; x += 0.11) {
    for (double y = -2.0; y <= 2.0; y += 0.1) {
      Over over;
      const Vec2 p{x, y};
      if (!line.meets(p, surface(x), over)) continue;
      line.find_tip(p, surface(x), over);
      most = std::max(most, line.chip(p, surface(x), surface(x) - over.bound, kAdvance, over));
    }
  }
  return most;
}

TEST(ChipOfABall, IsThatOfTheLayerOnAnySlope) {
  const double level = std::sqrt(1.0 - (1.0 - kLayer / kBall) * (1.0 - kLayer / kBall));
  for (const double degrees : {0.0, 10.0, 30.0, 50.0}) {
    for (const double way : {1.0, -1.0})
      EXPECT_NEAR(thickest(degrees * kRad, way), kAdvance * level, 1e-3 * kAdvance) << degrees << ' ' << way;
  }
}

/// The thickest chip off a wall across the way, which rises by the slope.
double off_a_wall(double slope_rad, double high) {
  const CutterOutline outline(geometry::ball_profile(2.0 * kBall, 30.0));
  Move m;
  m.kind = model::MoveKind::kLine;
  m.from = {0.0, 0.0, 0.0};
  m.to = {10.0, 0.0, 10.0 * std::tan(slope_rad)};
  const LineWay line(outline, m);
  double most = 0.0;
  for (double y = -4.0; y <= 4.0; y += 0.25) {
    Over over;
    const Vec2 p{8.0, y};
    if (!line.meets(p, high, over)) continue;
    line.find_tip(p, high, over);
    most = std::max(most, line.chip(p, high, high - over.bound, kAdvance, over));
  }
  return most;
}

TEST(ChipOfABall, OffAWallThatTheShankMeetsIsTheLevelPartOfTheFeed) {
  for (const double degrees : {5.0, 20.0, 40.0})
    EXPECT_NEAR(off_a_wall(degrees * kRad, 20.0), kAdvance * std::cos(degrees * kRad), 1e-9) << degrees;
}

TEST(ChipOfABall, DownHillInAWallIsAllOfTheFeedWhereTheBallMeetsItSquarely) {
  EXPECT_NEAR(off_a_wall(-30.0 * kRad, 20.0), kAdvance, 1e-3 * kAdvance);
}

}  // namespace
}  // namespace capstan::verify
