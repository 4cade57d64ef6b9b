#include "planner/physics/stock/planar/planar_stock.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include "planner/physics/stock/sweep.h"

namespace capstan::stock {
namespace {

using geometry::Box3;
using geometry::Vec2;
using model::CutterPath;
using model::MoveRole;

constexpr double kPi = std::numbers::pi;
const Box3 kBlock{{0.0, 0.0, -10.0}, {60.0, 40.0, 0.0}};

TEST(PlanarStock, BlockAndBarHaveTheirVolume) {
  EXPECT_NEAR(PlanarStock::from_box(kBlock).volume(), 24000.0, 1e-6);
  const auto bar = PlanarStock::from_cylinder(kBlock, 15.0);
  EXPECT_NEAR(bar.volume(), kPi * 2250.0, 1e-4);
  EXPECT_EQ(bar.height_at({30.0, 20.0}), 0.0);
  EXPECT_EQ(bar.height_at({30.0, 35.1}), -10.0);
}

TEST(PlanarStock, ASlotHasItsPlaceToTheGrainOfNumbers) {
  auto s = PlanarStock::from_box(kBlock);
  CutterPath p;
  p.start({10.0, 20.0, -2.0});
  p.line({50.0, 20.0, -2.0}, MoveRole::kCut);
  ASSERT_TRUE(s.cut(geometry::flat_profile(8.0, 20.0), p));
  EXPECT_EQ(s.height_at({30.0, 23.9999999}), -2.0);
  EXPECT_EQ(s.height_at({30.0, 24.0000001}), 0.0);
  EXPECT_EQ(s.height_at({53.9999999, 20.0}), -2.0);
  EXPECT_NEAR(24000.0 - s.volume(), 2.0 * (320.0 + 16.0 * kPi), 1e-5);
}

TEST(PlanarStock, WhatLaterTrailsCoverIsForgottenAndNothingChanges) {
  // Two hundred skew passes over the same place, deeper and deeper: each tile keeps few of them.
  auto s = PlanarStock::from_box(kBlock);
  auto map = from_box(kBlock, 0.25);
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> u(0.0, 1.0);
  const auto flat = geometry::flat_profile(6.0, 20.0);
  for (int k = 0; k < 200; ++k) {
    CutterPath p;
    const double z = -9.0 * k / 200.0;
    p.start({10.0 + 10.0 * u(random), 10.0 + 20.0 * u(random), z});
    p.line({40.0 + 10.0 * u(random), 10.0 + 20.0 * u(random), z}, MoveRole::kCut);
    ASSERT_TRUE(s.cut(flat, p));
    cut(map, flat, p);
  }
  PlanarStock::Nearby near;
  s.gather({29.0, 19.0}, {31.0, 21.0}, near);
  EXPECT_LT(near.trails.size(), 40U);
  EXPECT_NEAR(s.volume(1e-6), volume(map), 1e-3 * volume(map));
}

CutterPath random_path(std::mt19937_64& random, bool slopes) {
  std::uniform_real_distribution<double> u(0.0, 1.0);
  const auto point = [&](double z) {
    return geometry::Vec3{-5.0 + 70.0 * u(random), -5.0 + 50.0 * u(random), z};
  };
  CutterPath p;
  double z = -0.5 - 3.0 * u(random);
  p.start(point(2.0));
  p.line({p.x[0], p.y[0], z}, MoveRole::kPlunge);
  for (int k = 0; k < 6; ++k) {
    if (slopes && u(random) < 0.4) z = -0.5 - 5.0 * u(random);
    if (u(random) < 0.5) {
      p.line(point(z), MoveRole::kCut);
      continue;
    }
    const geometry::Vec3 from = p.point(p.size() - 1);
    const double a = 2.0 * kPi * u(random);
    const double r = 1.0 + 12.0 * u(random);
    const Vec2 centre = xy(from) + r * Vec2{std::cos(a), std::sin(a)};
    const double b = 2.0 * kPi * u(random);
    p.arc({centre.x + r * std::cos(b), centre.y + r * std::sin(b), z}, centre, u(random) < 0.5,
          slopes ? MoveRole::kRamp : MoveRole::kCut);
  }
  return p;
}

TEST(PlanarStock, AgreesWithTheHeightMapOnRandomPaths) {
  std::mt19937_64 random(11);
  for (int k = 0; k < 24; ++k) {
    auto s = PlanarStock::from_box(kBlock);
    auto map = from_box(kBlock, 0.2);
    for (int n = 0; n < 3; ++n) {
      const bool slopes = k % 2 == 1;
      const auto profile = geometry::flat_profile(4.0 + 4.0 * n, 20.0);
      const auto path = random_path(random, slopes);
      ASSERT_TRUE(s.cut(profile, path));
      cut(map, profile, path);
    }
    const double gone = 24000.0 - volume(map);
    EXPECT_NEAR(24000.0 - s.volume(1e-5), gone, 5e-3 * gone + 1.0) << k;
  }
}

TEST(PlanarStock, HoldsLevelMovesAndPlungesOfRoundedOutlinesAndRefusesTheirSlopes) {
  const auto ball = geometry::ball_profile(8.0, 20.0);
  auto s = PlanarStock::from_box(kBlock);
  auto map = from_box(kBlock, 0.1);
  CutterPath level;
  level.start({10.0, 20.0, 5.0});
  level.line({10.0, 20.0, -3.0}, MoveRole::kPlunge);
  level.line({50.0, 20.0, -3.0}, MoveRole::kCut);
  ASSERT_TRUE(s.cut(ball, level));
  cut(map, ball, level);
  EXPECT_NEAR(s.height_at({30.0, 22.0}), -3.0 + 4.0 - std::sqrt(12.0), 1e-9);
  EXPECT_NEAR(24000.0 - s.volume(1e-6), 24000.0 - volume(map), 0.5);
  CutterPath slope;
  slope.start({10.0, 20.0, 5.0});
  slope.line({50.0, 20.0, -5.0}, MoveRole::kRamp);
  EXPECT_FALSE(s.cannot_hold(ball, slope).empty());
  EXPECT_TRUE(s.lost().empty());
  EXPECT_EQ(s.cut(ball, slope).error().code, "STK-NOT-PLANAR");
  EXPECT_FALSE(s.lost().empty());
  EXPECT_FALSE(s.cut(geometry::flat_profile(8.0, 20.0), level));  // lost once is lost
}

TEST(PlanarStock, BadNumbersAreRefusedAndFarAwayMovesAreNothing) {
  auto s = PlanarStock::from_box(kBlock);
  CutterPath p;
  p.start({1e9, -1e9, -5.0});
  p.line({1e9, 1e9, -5.0}, MoveRole::kCut);
  ASSERT_TRUE(s.cut(geometry::flat_profile(8.0, 20.0), p));
  EXPECT_NEAR(s.volume(), 24000.0, 1e-6);
  p.x[1] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(s.cut(geometry::flat_profile(8.0, 20.0), p));
}

Trail arc_trail(double from_rad, double turn_rad, double z_from, double z_to, double radius = 5.0) {
  const Vec2 centre{30.0, 30.0};
  const auto on = [&](double t) { return centre + 8.0 * Vec2{std::cos(t), std::sin(t)}; };
  Trail t;
  t.a = on(from_rad);
  t.b = on(from_rad + turn_rad);
  t.za = z_from;
  t.zb = z_to;
  t.radius_mm = radius;
  t.arc = true;
  t.centre = centre;
  t.turn_rad = turn_rad;
  t.settle();
  return t;
}

Trail straight_trail(Vec2 a, Vec2 b, double z_from, double z_to, double radius = 5.0) {
  Trail t;
  t.a = a;
  t.b = b;
  t.za = z_from;
  t.zb = z_to;
  t.radius_mm = radius;
  t.settle();
  return t;
}

TEST(TrailCovers, TheTurnAboveTheWayBackAndTheHoleInsideAndNothingThatSticksOut) {
  const double quarter = 0.5 * std::numbers::pi;
  const Trail turn = arc_trail(0.3, quarter, -1.0, -1.25);
  EXPECT_TRUE(arc_trail(0.3, quarter, -2.0, -2.25).covers(turn));
  EXPECT_TRUE(arc_trail(0.3 + quarter, -quarter, -2.0, -2.25).covers(turn));
  EXPECT_TRUE(arc_trail(0.3, quarter, -1.25, -1.25).covers(turn));
  EXPECT_FALSE(arc_trail(0.3, quarter, -1.2, -1.3).covers(turn));        // its floor begins higher
  EXPECT_FALSE(arc_trail(0.4, quarter, -2.0, -2.25).covers(turn));       // turned on
  EXPECT_FALSE(arc_trail(0.3, quarter, -2.0, -2.25, 4.9).covers(turn));  // smaller
  EXPECT_FALSE(straight_trail(turn.a, turn.b, -2.0, -2.0).covers(turn));

  const Trail way = straight_trail({10, 10}, {30, 20}, -0.0, -1.0);
  EXPECT_TRUE(straight_trail({30, 20}, {10, 10}, -1.0, -2.0).covers(way));
  EXPECT_FALSE(straight_trail({30, 20}, {10.1, 10}, -1.0, -2.0).covers(way));
  EXPECT_TRUE(straight_trail({10, 10}, {10, 10}, -3.0, -3.0, 5.0)
                  .covers(straight_trail({10.9, 10}, {10.9, 10}, -1.0, -1.0, 4.1)));
  EXPECT_FALSE(straight_trail({10, 10}, {10, 10}, -3.0, -3.0, 5.0)
                   .covers(straight_trail({11, 10}, {11, 10}, -1.0, -1.0, 4.1)));
}

TEST(PlanarStockHelix, LeavesTheSameWithTheTurnsAboveItsLastOnesForgotten) {
  // A bore of four turns: a tile's trails are those of the last turn or two, and the bottom is where it was.
  auto s = PlanarStock::from_box({{0, 0, -20}, {60, 60, 0}});
  const double quarter = 0.5 * std::numbers::pi;
  for (int k = 0; k < 16; ++k) s.take(arc_trail(k * quarter, quarter, -0.5 * k, -0.5 * (k + 1)));
  for (int k = 0; k < 4; ++k) s.take(arc_trail(k * quarter, quarter, -8.0, -8.0));
  PlanarStock::Nearby near;
  s.gather({25, 25}, {50, 35}, near);
  EXPECT_EQ(near.trails.size(), 4U);
  // A ring from 3 to 13 mm, 8 deep.
  EXPECT_NEAR(60.0 * 60.0 * 20.0 - s.volume(1e-7), 8.0 * std::numbers::pi * (13.0 * 13.0 - 9.0), 0.1);
}

}  // namespace
}  // namespace capstan::stock
