#include "planner/proof/verify/sweep/grid/grid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "tests/support/paths/outlines.h"

// Heights after a move, held against the cutter set at each of 5,000 points of its way.

namespace capstan::verify {
namespace {

using geometry::CutterProfile;
using geometry::Vec2;
using geometry::Vec3;

Grid block() {
  Grid g({-12, -9}, {12, 9}, 0.5, 100000);
  std::fill(g.stock.begin(), g.stock.end(), 10.0);
  std::fill(g.base.begin(), g.base.end(), -20.0);
  g.find_top();
  return g;
}

std::vector<CutterProfile> cutters() {
  return {geometry::flat_profile(6, 20),
          geometry::ball_profile(6, 20),
          geometry::bull_profile(8, 1.5, 20),
          geometry::cone_profile(8, 118 * std::numbers::pi / 180, 20),
          geometry::cone_profile(8, 90 * std::numbers::pi / 180, 20, 2),
          test::lens(),
          test::barrel(),
          test::tapered_ball()};
}

Move line(Vec3 from, Vec3 to) {
  Move m;
  m.kind = model::MoveKind::kLine;
  m.from = from;
  m.to = to;
  return m;
}

Move helix(Vec3 from, Vec3 to, Vec2 centre) {
  Move m = line(from, to);
  m.kind = model::MoveKind::kArcCcw;
  m.centre = centre;
  return m;
}

std::vector<Move> ways() {
  return {line({-8, -5, 6}, {7, 4, 1}),        line({7, 4, 1}, {-8, -5, 6}),
          line({-3, 0, 8}, {3, 0.5, -2}),      line({-9, 3, 4}, {9, 3, 4}),
          line({2, -1, 9}, {2, -1, 3}),        line({-1, 2, 5}, {-0.5, 2, 4.9}),
          helix({4, 0, 7}, {4, 0, 5}, {0, 0}), helix({3, 1, 6}, {-2, 2, 6}, {0.5, 1.5})};
}

TEST(Grid, IsCutToTheLowestHeightOfTheCutterOnItsWay) {
  constexpr int kPlaces = 5000;
  for (const CutterProfile& cutter : cutters()) {
    for (const Move& m : ways()) {
      // Between two places.
      const double between = 1e-6 + std::abs(m.to.z - m.from.z) / kPlaces;
      std::vector<Vec3> tips;
      for (int i = 0; i <= kPlaces; ++i) tips.push_back(point_of(m, static_cast<double>(i) / kPlaces));
      Grid g = block();
      (void)cut(g, m, cutter, {});
      for (int iy = 0; iy < g.ny(); ++iy) {
        for (int ix = 0; ix < g.nx(); ++ix) {
          double lowest = 10.0, nearest = 1e300, there = 0.0;
          for (const Vec3& tip : tips) {
            const Vec2 apart = g.centre(ix, iy) - xy(tip);
            if (std::abs(apart.x) > cutter.radius_mm || std::abs(apart.y) > cutter.radius_mm) continue;
            const double d = std::sqrt(dot(apart, apart));
            nearest = std::min(nearest, d);
            if (d > cutter.radius_mm || tip.z + cutter.height(d) >= lowest) continue;
            lowest = tip.z + cutter.height(d);
            there = d;
          }
          // At the rim one of the two may be beside the cutter.
          if (std::abs(nearest - cutter.radius_mm) < 0.01) continue;
          // Places are up to 4 um apart in the plane: as much height as the surface rises over 6 um there.
          const double rise = cutter.height(std::min(cutter.radius_mm, there + 0.006)) - cutter.height(there);
          EXPECT_NEAR(g.stock[g.index(ix, iy)], lowest, rise + between)
              << "cutter of " << cutter.radius_mm << " mm, way from z = " << m.from.z << " at ("
              << g.centre(ix, iy).x << ", " << g.centre(ix, iy).y << ")";
        }
      }
    }
  }
}

TEST(Grid, IsTheSameWhateverTheOrderOfTheCuts) {
  for (const CutterProfile& cutter : cutters()) {
    Grid forwards = block(), backwards = block();
    const std::vector<Move> all = ways();
    for (const Move& m : all) (void)cut(forwards, m, cutter, {.advance_mm = 0.1});
    for (auto m = all.rbegin(); m != all.rend(); ++m) (void)cut(backwards, *m, cutter, {.contact = false});
    EXPECT_EQ(forwards.stock, backwards.stock);
  }
}

TEST(Grid, DepthOfContactOfAHelixIsThatWhereItMeetsThePiece) {
  const CutterProfile flat = geometry::flat_profile(6, 20);
  // It begins 0.15 mm deep at the piece's side, goes half a turn away from it and 32 mm down. The last
  // centres, at x = 11.75, are 3 mm from the axis after acos(3.85 / 4) = 0.275 rad, which is 2.8 mm down.
  Grid beside = block();
  const Bite away = cut(beside, helix({14.6, 0, 9.85}, {22.6, 0, -22.15}, {18.6, 0}), flat, {});
  EXPECT_GE(away.contact_mm, 0.15);
  EXPECT_LE(away.contact_mm, 0.15 + 32 * std::acos(3.85 / 4) / std::numbers::pi);
  // It begins 2 mm over the piece, whose top is at 10, and ends a turn later 2 mm deep: the last points that
  // it meets, at its end, are the deepest.
  Grid below = block();
  const Bite turn = cut(below, helix({4, 0, 12}, {4, 0, 8}, {0, 0}), flat, {});
  EXPECT_GT(turn.contact_mm, 1.8);
  EXPECT_LE(turn.contact_mm, 2.0);
}

TEST(Grid, KnowsTheTopOfEachRowAfterCuts) {
  for (const CutterProfile& cutter : cutters()) {
    Grid g = block();
    for (const Move& m : ways()) {
      (void)cut(g, m, cutter, {});
      g.find_top_after_cuts();
      for (int iy = 0; iy < g.ny(); ++iy) {
        const auto row = g.stock.begin() + static_cast<std::ptrdiff_t>(g.index(0, iy));
        EXPECT_EQ(g.row_top(iy), *std::max_element(row, row + g.nx())) << "row " << iy;
      }
      EXPECT_EQ(g.top(), *std::max_element(g.stock.begin(), g.stock.end()));
    }
  }
}

TEST(Grid, ThatFollowsAnotherIsAsNew) {
  for (const double size : {24.0, 8.0, 24.0, 60.0}) {
    {
      Grid gone({0, 0}, {24, 18}, 0.5, 100000);
      for (auto* heights : {&gone.stock, &gone.part, &gone.base})
        std::fill(heights->begin(), heights->end(), 7.0);
      gone.find_top();
      const Grid copy = gone;
      EXPECT_EQ(copy.stock, gone.stock);
      EXPECT_NE(copy.stock.data(), gone.stock.data());
    }
    const Grid g({0, 0}, {size, 18}, 0.5, 100000);
    const std::vector<double> nothing(static_cast<std::size_t>(2 * size * 36), Grid::kNothing);
    EXPECT_EQ(g.stock, nothing);
    EXPECT_EQ(g.part, nothing);
    EXPECT_EQ(g.base, nothing);
    EXPECT_EQ(g.top(), Grid::kNothing);
    EXPECT_EQ(g.row_top(0), Grid::kNothing);
  }
}

TEST(Grid, HasTheMemoryOfTheOneBeforeAndIsNoOthers) {
  const double* before = nullptr;
  {
    const Grid gone({0, 0}, {200, 200}, 0.5, 1000000);
    before = gone.stock.data();
  }
  const Grid g({0, 0}, {200, 200}, 0.5, 1000000), other({0, 0}, {200, 200}, 0.5, 1000000);
  const auto has = [&](const Grid& some) {
    return some.stock.data() == before || some.part.data() == before || some.base.data() == before;
  };
  EXPECT_TRUE(has(g));
  EXPECT_FALSE(has(other));
}

TEST(CutterOutline, IsNeverBelowItsFloor) {
  for (const CutterProfile& cutter : cutters()) {
    const CutterOutline outline(cutter);
    for (int i = 0; i <= 10000; ++i) {
      const double d = cutter.radius_mm * i / 10000;
      EXPECT_LE(outline.at_least(d * d), outline.height(d)) << d;
    }
  }
}

}  // namespace
}  // namespace capstan::verify
