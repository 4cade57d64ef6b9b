#include <gtest/gtest.h>

#include "planner/proof/verify/sweep/target/target.h"
#include "tests/proof/verify/plans.h"

namespace capstan::verify {
namespace {

Move level_line(geometry::Vec2 from, geometry::Vec2 to) {
  Move m;
  m.kind = model::MoveKind::kLine;
  m.from = {from.x, from.y, -5.0};
  m.to = {to.x, to.y, -5.0};
  return m;
}

// Pockets of 20 x 20 at x = 30 and 45, which meet; one at (80, 80) apart from both; one at (50, 5) that goes
// out past the part's edge at y = 0.
TEST(Walls, StandBetweenPocketsThatAreApartAndNotBetweenThoseThatMeet) {
  testing::PlanMaker k = testing::empty_plan();
  for (const auto& [name, x, y] :
       {std::tuple{"A", 30.0, 50.0}, {"B", 45.0, 50.0}, {"C", 80.0, 80.0}, {"D", 50.0, 5.0}})
    (void)k.pocket(name, x, y, 20, 10);
  const PartShapes part = shapes_of_part(k.plan);
  Target target(k.plan, part, 0);
  geometry::Vec2 at;
  constexpr double kRadius = 5.0;
  EXPECT_EQ(target.wall_gouge(level_line({26, 50}, {49, 50}), kRadius, 0.0, at), 0.0);
  EXPECT_EQ(target.wall_gouge(level_line({80, 76}, {80, 84}), kRadius, 0.0, at), 0.0);
  EXPECT_EQ(target.wall_gouge(level_line({50, -10}, {50, 9}), kRadius, 0.0, at), 0.0);
  // 1 mm too far: of B, C and D.
  EXPECT_NEAR(target.wall_gouge(level_line({45, 50}, {51, 50}), kRadius, 0.0, at), 1.0, 1e-6);
  EXPECT_NEAR(target.wall_gouge(level_line({80, 80}, {80, 86}), kRadius, 0.0, at), 1.0, 1e-6);
  EXPECT_NEAR(target.wall_gouge(level_line({50, 5}, {50, 11}), kRadius, 0.0, at), 1.0, 1e-6);
  // Through what stands between B and C, and on an arc that is all in the solid.
  EXPECT_EQ(target.wall_gouge(level_line({45, 50}, {80, 80}), kRadius, 0.0, at), kRadius);
  Move arc = level_line({85, 30}, {81, 30});
  arc.kind = model::MoveKind::kArcCcw;
  arc.centre = {83, 30};
  EXPECT_EQ(target.wall_gouge(arc, 1.0, 0.0, at), 1.0);
}

// The same pockets, seen about A and B alone: C and D lie apart.
TEST(Walls, NearAPlaceAreThoseOfAllFeatures) {
  testing::PlanMaker k = testing::empty_plan();
  for (const auto& [name, x, y] :
       {std::tuple{"A", 30.0, 50.0}, {"B", 45.0, 50.0}, {"C", 80.0, 80.0}, {"D", 50.0, 5.0}})
    (void)k.pocket(name, x, y, 20, 10);
  const PartShapes part = shapes_of_part(k.plan);
  Target all(k.plan, part, 0);
  Target near(k.plan, part, 0, geometry::Box2{{15, 35}, {60, 65}});
  int gouges = 0;
  for (int x = 16; x <= 58; ++x) {
    for (int y = 36; y <= 64; ++y) {
      const geometry::Vec2 p{1.0 * x, 1.0 * y};
      geometry::Vec2 at_all, at_near;
      const Move m = level_line(p, p + geometry::Vec2{1.0, 0.5});
      EXPECT_EQ(near.wall_gouge(m, 0.5, 0.0, at_near), all.wall_gouge(m, 0.5, 0.0, at_all));
      EXPECT_EQ(near.is_gouge(p, -5.0), all.is_gouge(p, -5.0));
      gouges += all.is_gouge(p, -5.0) ? 1 : 0;
    }
  }
  EXPECT_GT(gouges, 0);
  EXPECT_LT(gouges, 43 * 29);
  // What lies apart is left out: C is solid there.
  EXPECT_FALSE(all.is_gouge({80, 80}, -5.0));
  EXPECT_TRUE(near.is_gouge({80, 80}, -5.0));
}

}  // namespace
}  // namespace capstan::verify
