#include "planner/proof/verify/sweep/grid/way.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

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

/// Some way round a centre, in either direction, up to a whole turn; its ends may lie 1 um off one circle.
Move random_arc(std::mt19937& random) {
  std::uniform_real_distribution<double> u(0.0, 1.0);
  const double radius = 0.2 + 8.0 * u(random), start = 6.3 * u(random);
  const double sweep = (random() % 4 == 0 ? 180.0 : 1.0 + 359.0 * u(random)) * kRad;
  const double ends = radius + 0.001 * (u(random) - 0.5);
  Move m;
  m.kind = random() % 2 == 0 ? model::MoveKind::kArcCcw : model::MoveKind::kArcCw;
  const double end = m.kind == model::MoveKind::kArcCcw ? start + sweep : start - sweep;
  m.centre = {20.0 * u(random), 20.0 * u(random)};
  m.from = {m.centre.x + radius * std::cos(start), m.centre.y + radius * std::sin(start), 0.0};
  m.to = {m.centre.x + ends * std::cos(end), m.centre.y + ends * std::sin(end),
          random() % 2 == 0 ? 0.0 : -u(random)};
  return m;
}

TEST(ArcWay, MeetsThePointsThatItsAxisComesNearTo) {
  constexpr int kPlaces = 1500;
  constexpr double kRadius = 3.0, kHigh = 100.0;
  const CutterOutline outline(geometry::flat_profile(2.0 * kRadius, 30.0));
  std::mt19937 random(11);
  std::uniform_real_distribution<double> within(-12.0, 12.0);
  int met = 0, missed = 0;
  for (int k = 0; k < 200; ++k) {
    const Move m = random_arc(random);
    const ArcWay way(outline, m);
    std::vector<Vec2> axis;
    for (int i = 0; i <= kPlaces; ++i) axis.push_back(xy(point_of(m, static_cast<double>(i) / kPlaces)));
    // Of two places one is no farther from the way's nearest place than half of what lies between them; the
    // way runs at the mean of its ends' distances from the centre.
    const double doubt = 0.5 * norm(axis[1] - axis[0]) + 0.001;
    for (int n = 0; n < 100; ++n) {
      const Vec2 p = m.centre + Vec2{within(random), within(random)};
      double nearest = 1e300;
      for (const Vec2& at : axis) nearest = std::min(nearest, dot(p - at, p - at));
      nearest = std::sqrt(nearest);
      if (std::abs(nearest - kRadius) < doubt) continue;
      Over over;
      ASSERT_EQ(way.meets(p, kHigh, over), nearest < kRadius) << "arc " << k << ", point " << n;
      ++(nearest < kRadius ? met : missed);
    }
  }
  EXPECT_GT(std::min(met, missed), 3000);
}

TEST(LineWay, OfAFlatCutterComesLowestWhereItWasLastOverThePoint) {
  constexpr double kRadius = 3.0;
  const CutterOutline outline(geometry::flat_profile(2.0 * kRadius, 30.0));
  // From 0 along x, 1 mm down in 4: over (x, y) it comes until x + sqrt(R^2 - y^2), no farther than its end.
  constexpr double kLength = 10.0, kFall = 0.25;
  for (double x = -2.5; x <= 12.5; x += 0.31) {
    for (double y = -2.9; y <= 2.9; y += 0.29) {
      const double last = std::min(kLength, x + std::sqrt(kRadius * kRadius - y * y));
      if (last < 0.0 || (x > kLength && std::hypot(x - kLength, y) > kRadius)) continue;
      EXPECT_NEAR(lowest_on_line(outline, 0.0, -kFall * kLength, x, std::abs(y), kLength), -kFall * last,
                  1e-12);
    }
  }
}

}  // namespace
}  // namespace capstan::verify
