#include "planner/ground/geometry/kept_outlines.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "planner/ground/geometry/region.h"

namespace capstan::geometry {
namespace {

bool same(const Region& a, const Region& b) {
  if (a.loops.size() != b.loops.size()) return false;
  for (std::size_t i = 0; i < a.loops.size(); ++i) {
    if (a.loops[i].size() != b.loops[i].size()) return false;
    for (std::size_t k = 0; k < a.loops[i].size(); ++k)
      if (a.loops[i][k].x != b.loops[i][k].x || a.loops[i][k].y != b.loops[i][k].y) return false;
  }
  return true;
}

Region moved_by(const Region& r, Vec2 by) {
  Region out = r;
  for (Loop& loop : out.loops)
    for (Vec2& p : loop) p = p + by;
  return out;
}

/// A star of so many points with corners on the grid.
Region star(std::mt19937& draw, int points) {
  Loop loop;
  for (int i = 0; i < points; ++i) {
    const double r = 1e-3 * std::uniform_int_distribution(2000, 9000)(draw);
    const double a = 6.283185307179586 * i / points;
    loop.push_back({r * std::cos(a), r * std::sin(a)});
  }
  return clean({loop});
}

TEST(KeptOutlinesProperty, AreToTheBitWhatIsMadeAnew) {
  std::mt19937 draw(static_cast<unsigned>(::testing::UnitTest::GetInstance()->random_seed()) + 7U);
  KeptOutlines kept;
  for (int round = 0; round < 20; ++round) {
    const Region a = star(draw, 11), b = moved_by(star(draw, 7), {3.25, -1.5});
    const Region grown = offset(a, 0.7), shrunk = offset(a, -0.4), sharp = offset_sharp(b, 0.3);
    const Region both = unite(a, b), common = intersect(a, b), rest = subtract(a, b);
    const KeptOutlinesScope scope(&kept);
    for (int turn = 0; turn < 2; ++turn) {
      EXPECT_TRUE(same(offset(a, 0.7), grown));
      EXPECT_TRUE(same(offset(a, -0.4), shrunk));
      EXPECT_TRUE(same(offset_sharp(b, 0.3), sharp));
      EXPECT_TRUE(same(unite(a, b), both));
      EXPECT_TRUE(same(intersect(a, b), common));
      EXPECT_TRUE(same(subtract(a, b), rest));
    }
  }
  // The second turn of each round makes nothing.
  EXPECT_EQ(kept.counts().made, kept.counts().found);
}

TEST(KeptOutlines, OfAnOutlineAtAnotherPlaceAreThoseOfThisOneMoved) {
  const Region here = rounded_rectangle({-5.0, -4.0}, {5.0, 4.0}, 2.5);
  KeptOutlines kept;
  const KeptOutlinesScope scope(&kept);
  const Region inset = offset(here, -2.0);
  const auto made = kept.counts().made;
  for (const double x : {14.0, 140.0, 1400.0}) {
    const Region there = moved_by(here, {x, -0.5 * x});
    const Region moved = offset(there, -2.0);
    ASSERT_EQ(moved.loops.size(), inset.loops.size());
    ASSERT_EQ(moved.loops.front().size(), inset.loops.front().size());
    for (std::size_t i = 0; i < inset.loops.front().size(); ++i) {
      EXPECT_NEAR(moved.loops.front()[i].x, inset.loops.front()[i].x + x, 0.1 * kRegionGrid);
      EXPECT_NEAR(moved.loops.front()[i].y, inset.loops.front()[i].y - 0.5 * x, 0.1 * kRegionGrid);
    }
  }
  EXPECT_EQ(kept.counts().made, made);
}

TEST(KeptOutlines, OfAnotherDistanceToleranceOrCornerAreMadeAnew) {
  const Region square = rectangle({0.0, 0.0}, {10.0, 10.0});
  KeptOutlines kept;
  const KeptOutlinesScope scope(&kept);
  (void)offset(square, 1.0, 0.001);
  (void)offset(square, 1.0, 0.01);
  (void)offset(square, 1.5, 0.001);
  (void)offset(square, -1.0, 0.001);
  (void)offset_sharp(square, 1.0);
  (void)unite(square, square);
  (void)intersect(square, square);
  EXPECT_EQ(kept.counts().made, 7U);
  EXPECT_EQ(kept.counts().found, 0U);
}

TEST(KeptOutlines, BeyondTheirBoundAreLetGoAndMadeAgain) {
  const Region disc_of_ten = disc({0.0, 0.0}, 10.0);
  KeptOutlines none(1);
  const KeptOutlinesScope scope(&none);
  const Region first = offset(disc_of_ten, 1.0);
  EXPECT_TRUE(same(offset(disc_of_ten, 1.0), first));
  EXPECT_EQ(none.counts().made, 2U);
  EXPECT_EQ(none.counts().found, 0U);
}

TEST(KeptOutlines, OfAScopeThatEndedAreAskedNoMore) {
  KeptOutlines kept;
  { const KeptOutlinesScope scope(&kept); }
  (void)offset(rectangle({0.0, 0.0}, {10.0, 10.0}), 1.0);
  EXPECT_EQ(kept.counts().made, 0U);
}

}  // namespace
}  // namespace capstan::geometry
