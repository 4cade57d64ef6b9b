#include "planner/physics/stock/planar/part.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "planner/ground/memo/packed.h"
#include "planner/model/plan/path/own_frame.h"
#include "planner/physics/stock/planar/planar_stock.h"

namespace capstan::stock {
namespace {

using geometry::Vec2;
using model::CutterPath;
using model::MoveRole;

const geometry::Box3 kBlock{{-60, -60, -20}, {260, 140, 0}};

std::string bytes_of(const PlanarPart& part) {
  std::string out;
  memo::pack(out, part);
  return out;
}

/// Zigzag passes 3 mm apart with round ends, two levels of them, and a helix.
CutterPath passes(Vec2 at) {
  CutterPath p;
  p.start({at.x, at.y, 5.0});
  p.line({at.x, at.y, 0.0}, MoveRole::kApproach);
  for (int turn = 1; turn <= 3; ++turn)
    p.arc({at.x, at.y, -0.7 * turn}, {at.x + 1.3, at.y}, false, MoveRole::kRamp);
  for (const double z : {-2.1, -4.2}) {
    p.line({at.x, at.y, z}, MoveRole::kPlunge);
    for (int k = 0; k < 4; ++k) {
      const double side = k % 2 == 0 ? 20.1 : 0.0;
      p.line({at.x + side, at.y + 3.0 * k, z}, MoveRole::kCut);
      p.arc({at.x + side, at.y + 3.0 * (k + 1), z}, {at.x + side, at.y + 3.0 * k + 1.5}, k % 2 == 1,
            MoveRole::kCut);
    }
    p.rapid({at.x, at.y, z + 1.0});
  }
  return p;
}

const Vec2 kLo{-12, -12}, kHi{34, 26};

PlanarPart part_at(const PlanarStock& stock, Vec2 at) { return stock.part(kLo, kHi, at); }

TEST(PlanarPart, IsTheSameAboutEqualCutsWhereverTheyLie) {
  const auto mill = geometry::flat_profile(6.0, 30.0);
  auto stock = PlanarStock::from_box(kBlock);
  const std::vector<Vec2> places{{0, 0}, {71.3, 17.9}, {143.7, 60.1}};
  for (const Vec2 at : places) ASSERT_TRUE(stock.cut(mill, passes(at)));
  for (const Vec2 at : places) {
    EXPECT_GT(part_at(stock, at).trails.size(), 20U);
    EXPECT_EQ(bytes_of(part_at(stock, at)), bytes_of(part_at(stock, places[0])));
  }
  EXPECT_NE(bytes_of(part_at(stock, {0.1, 0})), bytes_of(part_at(stock, {0, 0})));
  EXPECT_NE(bytes_of(part_at(stock, {-50, 0})), bytes_of(part_at(stock, {100, -40}))) << "a side is near";
}

TEST(PlanarPart, StandsAsHighAsTheWholeThere) {
  for (const double bar_mm : {0.0, 55.0, 90.0}) {
    const Vec2 at{71.3, 17.9};
    const geometry::Box3 about{{at.x + 10 - bar_mm, at.y + 6 - bar_mm, -20},
                               {at.x + 10 + bar_mm, at.y + 6 + bar_mm, 0}};
    auto stock = bar_mm > 0.0 ? PlanarStock::from_cylinder(about, bar_mm) : PlanarStock::from_box(kBlock);
    ASSERT_TRUE(stock.cut(geometry::flat_profile(6.0, 30.0), passes(at)));
    ASSERT_TRUE(stock.cut(geometry::ball_profile(5.0, 30.0), [&] {
      CutterPath drop;
      drop.start({at.x - 8, at.y - 6, 3.0});
      drop.line({at.x - 8, at.y - 6, -3.0}, MoveRole::kPlunge);
      return drop;
    }()));
    const auto alone = PlanarStock::from_part(part_at(stock, at));
    int cut = 0;
    for (double x = kLo.x + 0.13; x < kHi.x; x += 0.31) {
      for (double y = kLo.y + 0.17; y < kHi.y; y += 0.29) {
        const double z = stock.height_at({x + at.x, y + at.y});
        EXPECT_NEAR(alone.height_at({x, y}), z, 1e-6) << x << ", " << y;
        cut += z < 0.0 ? 1 : 0;
      }
    }
    EXPECT_GT(cut, 1000);
  }
}

/// Passes of some 110 mm askew about a place, each deeper than the one before.
CutterPath skew_passes(Vec2 at) {
  CutterPath p;
  p.start({at.x - 40, at.y - 35, 2.0});
  for (int k = 0; k < 6; ++k) {
    const double side = k % 2 == 0 ? 1.0 : -1.0;
    const double z = -1.0 - 0.7 * k;
    p.line({at.x - side * 40, at.y - 35 + 5.3 * k, z}, MoveRole::kCut);
    p.line({at.x + side * (40 + 7 * k), at.y + 35 - 9.1 * k, z}, MoveRole::kCut);
  }
  return p;
}

/// With tiles of a millimetre, so that such passes are noted in stretches.
PlanarStock skewly_cut(Vec2 at) {
  auto stock = PlanarStock::from_box(kBlock, 1.0);
  EXPECT_TRUE(stock.cut(geometry::flat_profile(6.0, 30.0), skew_passes(at)));
  return stock;
}

TEST(PlanarPart, HoldsTheLongSkewPassesThatReachIntoItAndIsTheSameWhereverTheyLie) {
  const Vec2 here{30.0, 20.0}, there{101.3, 47.9};
  const auto stock = skewly_cut(here), moved = skewly_cut(there);
  std::size_t most = 0;
  for (double x = -45.0; x < 70.0; x += 6.7) {
    for (double y = -40.0; y < 40.0; y += 5.9) {
      const Vec2 lo{x, y}, hi{x + 8.0, y + 7.0};
      const PlanarPart part = stock.part(lo, hi, here);
      EXPECT_EQ(bytes_of(part), bytes_of(moved.part(lo, hi, there))) << x << ", " << y;
      const auto alone = PlanarStock::from_part(part);
      for (double u = x + 0.23; u < hi.x; u += 0.71) {
        for (double v = y + 0.31; v < hi.y; v += 0.67)
          EXPECT_NEAR(alone.height_at({u, v}), stock.height_at({u + here.x, v + here.y}), 1e-6)
              << u << ", " << v;
      }
      most = std::max(most, part.trails.size());
    }
  }
  EXPECT_GT(most, 2U);
  EXPECT_TRUE(stock.part({-36, 28}, {-28, 35}, here).trails.empty()) << "within rectangles of passes only";
}

TEST(PlanarPart, FollowsLongPassesThatAreUndone) {
  const Vec2 here{30.0, 20.0};
  auto stock = skewly_cut(here);
  const auto before = bytes_of(part_at(stock, here));
  const auto mark = stock.mark();
  ASSERT_TRUE(stock.cut(geometry::flat_profile(8.0, 30.0), skew_passes({33.0, 26.0})));
  const auto after = bytes_of(part_at(stock, here));
  EXPECT_NE(after, before);
  auto undone = stock.take_out(mark);
  EXPECT_EQ(bytes_of(part_at(stock, here)), before);
  stock.put_in(std::move(undone));
  EXPECT_EQ(bytes_of(part_at(stock, here)), after);
  stock.put_back(mark);
  EXPECT_EQ(bytes_of(part_at(stock, here)), before);
}

TEST(PlanarPart, FollowsWhatIsUndoneAndDoneAgain) {
  const auto mill = geometry::flat_profile(6.0, 30.0);
  auto stock = PlanarStock::from_box(kBlock);
  ASSERT_TRUE(stock.cut(mill, passes({0, 0})));
  const auto before = bytes_of(part_at(stock, {5, 5}));
  const auto mark = stock.mark();
  ASSERT_TRUE(stock.cut(mill, passes({3, 8})));
  const auto after = bytes_of(part_at(stock, {5, 5}));
  EXPECT_NE(after, before);
  auto undone = stock.take_out(mark);
  EXPECT_EQ(bytes_of(part_at(stock, {5, 5})), before);
  ASSERT_TRUE(stock.cut(mill, passes({6, 2})));
  stock.put_back(mark);
  EXPECT_EQ(bytes_of(part_at(stock, {5, 5})), before);
  stock.put_in(std::move(undone));
  EXPECT_EQ(bytes_of(part_at(stock, {5, 5})), after);
  stock.put_back(mark);
  EXPECT_EQ(bytes_of(part_at(stock, {5, 5})), before);
}

}  // namespace
}  // namespace capstan::stock
