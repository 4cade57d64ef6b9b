#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "planner/proof/verify/volumes/form/form.h"

namespace capstan::verify::volumes {
namespace {

using geometry::Vec2;

Outline square(double half) {
  Outline o;
  o.add(straight({-half, -half}, {half, -half}));
  o.add(straight({half, -half}, {half, half}));
  o.add(straight({half, half}, {-half, half}));
  o.add(straight({-half, half}, {-half, -half}));
  return o;
}

/// A pocket of 40 x 40 x 10 with a radius of 3 at its foot and a boss of 8 x 8 in its middle, 4 below its
/// top.
Form pocket() {
  Area a;
  a.outline = square(20.0);
  a.foot_radius_mm = 3.0;
  Standing boss;
  boss.outline = square(4.0);
  boss.top_mm = -4.0;
  a.standing.push_back(boss);
  Form f;
  f.kind = model::ShapeKind::kPocket;
  f.solid.depth_mm = 10.0;
  f.solid.form = a;
  f.area = geometry::rectangle({-20, -20}, {20, 20});
  return f;
}

TEST(LevelAbout, SaysSoOnlyWhereTheFloorIsTheSameAllAround) {
  const Form f = pocket();
  int level = 0;
  for (int i = 0; i <= 60; ++i) {
    for (int k = 0; k <= 60; ++k) {
      const Vec2 q{-24.0 + 0.8 * i, -24.0 + 0.8 * k};
      const double distance = 0.5 + 0.05 * ((i + k) % 20);
      if (!level_about(f, q, distance)) continue;
      ++level;
      for (int turn = 0; turn < 32; ++turn) {
        const double angle = 2.0 * std::numbers::pi * turn / 32;
        const Vec2 p = q + distance * Vec2{std::cos(angle), std::sin(angle)};
        EXPECT_EQ(floor_at(f, p), floor_at(f, q)) << "(" << q.x << ", " << q.y << "), " << distance;
      }
    }
  }
  // Beside, on the floor and on the boss: not all places are given up.
  EXPECT_GT(level, 1000);
  EXPECT_TRUE(level_about(f, {0, 0}, 3.9));
  EXPECT_EQ(floor_at(f, {0, 0}), -4.0);
  EXPECT_TRUE(level_about(f, {10, 0}, 5.9));
  EXPECT_EQ(floor_at(f, {10, 0}), -10.0);
  EXPECT_FALSE(level_about(f, {15, 0}, 2.5)) << "the radius at the foot begins at 17";
}

TEST(FloorAt, RisesInTheFilletAtTheFootOfABossToItsTopAtMost) {
  Form f = pocket();
  auto& boss = std::get<Area>(f.solid.form).standing.front();
  boss.foot_radius_mm = 2.0;
  // A quarter of a circle of 2 mm, its middle 2 mm beside the boss and above the floor.
  for (const double beside : {0.25, 1.0, 1.75}) {
    EXPECT_NEAR(*floor_at(f, {4.0 + beside, 0}),
                -10.0 + 2.0 - std::sqrt(4.0 - (2.0 - beside) * (2.0 - beside)), 1e-9);
  }
  EXPECT_EQ(floor_at(f, {6.5, 0}), -10.0);
  EXPECT_FALSE(level_about(f, {6.5, 0}, 1.0));
  boss.top_mm = -9.5;
  EXPECT_EQ(floor_at(f, {4.01, 0}), -9.5);
}

TEST(FloorAt, OfASlotRisesInTheFilletsAlongItsSides) {
  Groove g;
  g.half_mm = 10.0;
  g.foot_radius_mm = 3.0;
  Form f;
  f.kind = model::ShapeKind::kSlot;
  f.solid.depth_mm = 8.0;
  f.solid.form = g;
  f.course = {{0, 0}, {50, 0}};
  f.area = geometry::rectangle({0, -10}, {50, 10});
  EXPECT_EQ(floor_at(f, {25, 6}), -8.0);
  EXPECT_NEAR(*floor_at(f, {25, 9}), -8.0 + 3.0 - std::sqrt(9.0 - 2.0 * 2.0), 1e-9);
  EXPECT_NEAR(*floor_at(f, {25, -10}), -5.0, 1e-9);
}

TEST(FloorAt, OfAnOpenAreaRisesAtItsWallsAlone) {
  Area a;
  a.outline = square(20.0);
  a.outline.edges[0].open = true;
  a.foot_radius_mm = 3.0;
  Form f;
  f.kind = model::ShapeKind::kPocket;
  f.solid.depth_mm = 10.0;
  f.solid.form = a;
  f.area = geometry::rectangle({-20, -20}, {20, 20});
  ASSERT_TRUE(f.open());
  EXPECT_EQ(floor_at(f, {0, -19.5}), -10.0);
  EXPECT_NEAR(*floor_at(f, {0, 19.5}), -10.0 + 3.0 - std::sqrt(9.0 - 2.5 * 2.5), 1e-9);
}

}  // namespace
}  // namespace capstan::verify::volumes
