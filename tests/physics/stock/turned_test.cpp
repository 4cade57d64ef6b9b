#include "planner/physics/stock/turned.h"

#include <gtest/gtest.h>

namespace capstan::stock {
namespace {

using geometry::Placement;

// A piece of 20 x 10 x 8 with its lower corner at the origin, in cells of 1 mm.
geometry::Box3 piece() {
  geometry::Box3 b;
  b.add({0, 0, 0});
  b.add({20, 10, 8});
  return b;
}

/// Cuts the cells x0..x1 (excluded), all y, down to z.
void cut_to(HeightMap& map, int x0, int x1, float z) {
  for (int y = 0; y < map.ny; ++y) {
    for (int x = x0; x < x1; ++x) map.set(x, y, z > 0.0F ? Column{z, z, 0.0F} : Column{});
  }
}

/// Turned over about x; the lower corner of the piece is the set-up's origin again.
Placement flipped() { return {{0, 10, 8}, {1, 0, 0}, {0, -1, 0}, {0, 0, -1}}; }

TEST(TakeOver, GivesTheSameHeightsInASetupThatHoldsThePieceAlike) {
  HeightMap first = from_box(piece(), 1.0);
  cut_to(first, 2, 5, 3.0F);
  HeightMap next = from_box(piece(), 1.0);
  take_over(next, {}, first, {});
  EXPECT_EQ(next, first);
}

TEST(TakeOver, ShiftsHeightsWithTheSetup) {
  HeightMap first = from_box(piece(), 1.0);
  cut_to(first, 2, 5, 3.0F);
  const Placement raised{{0, 0, 100}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  geometry::Box3 box = piece();
  box.lo.z += 100;
  box.hi.z += 100;
  HeightMap next = from_box(box, 1.0);
  take_over(next, raised, first, {});
  EXPECT_FLOAT_EQ(next.at(3, 4).top_mm, 3.0F);
  EXPECT_FLOAT_EQ(next.at(8, 4).top_mm, 8.0F);
}

TEST(TakeOver, SeesFromTheOtherSideWhatIsCutThroughAndNothingElse) {
  HeightMap first = from_box(piece(), 1.0);
  cut_to(first, 2, 5, 3.0F);   // blind: 3 mm are left, on this set-up's far side
  cut_to(first, 9, 12, 0.0F);  // through
  HeightMap next = from_box(piece(), 1.0);
  take_over(next, flipped(), first, {});
  for (int y = 0; y < next.ny; ++y) {
    EXPECT_FLOAT_EQ(next.at(3, y).top_mm, 8.0F);
    EXPECT_FLOAT_EQ(next.at(10, y).top_mm, 0.0F);
    EXPECT_FLOAT_EQ(next.at(15, y).top_mm, 8.0F);
  }
  EXPECT_DOUBLE_EQ(volume(next), 20.0 * 10 * 8 - 3.0 * 10 * 8);
}

TEST(TakeOver, IsNeverTooLowOnGridsOfOtherCells) {
  HeightMap first = from_box(piece(), 1.0);
  cut_to(first, 2, 5, 3.0F);
  HeightMap next = from_box(piece(), 0.7);
  take_over(next, {}, first, {});
  for (int x = 0; x < next.nx; ++x) {
    const double lo = x * next.cell_mm, hi = lo + next.cell_mm;
    const bool whole = lo >= 2.0 - 1e-6 && hi <= 5.0 + 1e-6;
    EXPECT_FLOAT_EQ(next.at(x, 5).top_mm, whole ? 3.0F : 8.0F) << x;
  }
}

TEST(TakeOver, TakesWholeLayersWhenSeenFromBeside) {
  HeightMap first = from_box(piece(), 1.0);
  cut_to(first, 16, 20, 0.0F);  // the end of the piece, 4 mm
  // Its +x end is up here: z of the set-up is x of the piece.
  const Placement upright{
      {0, 0, 0}, {0, 0, 1}, {1, 0, 0}, cross(geometry::Vec3{0, 0, 1}, geometry::Vec3{1, 0, 0})};
  geometry::Box3 box;
  for (const double x : {0.0, 20.0}) {
    for (const double y : {0.0, 10.0}) {
      for (const double z : {0.0, 8.0}) box.add(upright.to_parent({x, y, z}));
    }
  }
  HeightMap next = from_box(box, 1.0);
  take_over(next, upright, first, {});
  EXPECT_NEAR(next.at(4, 4).top_mm, 16.0F, 1e-5);
}

}  // namespace
}  // namespace capstan::stock
