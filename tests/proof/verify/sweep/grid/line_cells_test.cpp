#include "planner/proof/verify/sweep/grid/line_cells.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "planner/proof/verify/sweep/grid/way.h"
#include "tests/support/paths/outlines.h"

namespace capstan::verify {
namespace {

using geometry::Vec2;

std::vector<CutterOutline> outlines() {
  return {geometry::ball_profile(6.0, 20.0),
          geometry::bull_profile(8.0, 1.0, 20.0),
          geometry::flat_profile(5.0, 20.0),
          geometry::cone_profile(6.0, 2.0, 20.0),
          geometry::cone_profile(6.0, 1.2, 20.0, 1.0),
          test::lens(),
          test::barrel(),
          test::tapered_ball()};
}

/// How low the cutter comes over a point, at many places of the line: no lower than it really does.
double lowest(const CutterOutline& o, const Move& m, Vec2 p) {
  constexpr int kPlaces = 400;
  double out = 1e300;
  for (int i = 0; i <= kPlaces; ++i) {
    const double t = static_cast<double>(i) / kPlaces;
    const double apart = norm(p - (xy(m.from) + t * (xy(m.to) - xy(m.from))));
    if (apart < o.radius()) out = std::min(out, m.from.z + t * (m.to.z - m.from.z) + o.height(apart));
  }
  return out;
}

/// Lines of all directions, lengths from none to some radii, level or not, near the origin and far from it.
Move line(std::mt19937& random, int i) {
  std::uniform_real_distribution<double> at(-6.0, 6.0), rise(-3.0, 3.0);
  const double far = i % 3 == 0 ? 2000.0 : 0.0;
  Move m;
  m.kind = model::MoveKind::kLine;
  m.from = {far + at(random), at(random) - far, rise(random)};
  const double reach = i % 5 == 0 ? 0.0 : i % 5 == 1 ? 0.02 : 1.0;
  m.to = {m.from.x + reach * at(random), m.from.y + reach * at(random),
          i % 4 == 0 ? m.from.z : m.from.z + reach * rise(random)};
  return m;
}

struct Row {
  Vec2 first;
  double cell = 0.0;
  [[nodiscard]] Vec2 centre(int ix) const { return {first.x + ix * cell, first.y}; }
};

Row row_of(std::mt19937& random, const Move& m) {
  std::uniform_real_distribution<double> off(-2.0, 2.0);
  return {{m.from.x - 9.0 + off(random), m.from.y + off(random)}, 0.13};
}

TEST(LineCells, ThatTheCutterLowersAreAllGiven) {
  constexpr int kCells = 151;  // more than are marked at once, and not a multiple
  std::mt19937 random(7);
  std::uniform_real_distribution<double> over(1e-7, 0.4);
  const auto all = outlines();
  for (int i = 0; i < 300; ++i) {
    const Move m = line(random, i);
    const Row row = row_of(random, m);
    const CutterOutline& o = all[static_cast<std::size_t>(i) % all.size()];
    std::vector<double> stock(kCells);
    std::vector<int> lowered;
    for (int ix = 0; ix < kCells; ++ix) {
      const double z = lowest(o, m, row.centre(ix));
      stock[static_cast<std::size_t>(ix)] = z < 1e300 ? z + over(random) : 100.0;
      if (z < 1e300 && ix >= 3) lowered.push_back(ix);
    }
    for (const bool four : {false, LineCells::takes_four()}) {
      const LineCells cells(o, xy(m.from), xy(m.to) - xy(m.from), m.from.z, m.to.z, four);
      std::vector<int> given;
      cells.each(stock.data(), 3, kCells, row.first, row.cell, [&](int ix) { given.push_back(ix); });
      EXPECT_TRUE(std::is_sorted(given.begin(), given.end()));
      EXPECT_TRUE(std::includes(given.begin(), given.end(), lowered.begin(), lowered.end())) << i << four;
    }
  }
}

TEST(LineCells, ThatStandLowerThanTheCutterComesAreMostlyKeptBack) {
  constexpr int kCells = 128;
  std::mt19937 random(11);
  std::size_t of_all = 0, given = 0;
  const CutterOutline ball(geometry::ball_profile(6.0, 20.0));
  for (int i = 0; i < 200; ++i) {
    const Move m = line(random, 3 * i + 1);
    const Row row = row_of(random, m);
    std::vector<double> stock(kCells);
    // What a pass 0.4 mm beside this one left, and 0.05 mm less.
    Move before = m;
    before.from.y += 0.4;
    before.to.y += 0.4;
    for (int ix = 0; ix < kCells; ++ix) {
      const double z = std::min(lowest(ball, m, row.centre(ix)), lowest(ball, before, row.centre(ix)));
      stock[static_cast<std::size_t>(ix)] = z < 1e300 ? z - 0.05 : 100.0;
      of_all += z < 1e300 ? 1 : 0;
    }
    for (const bool four : {false, LineCells::takes_four()}) {
      const LineCells cells(ball, xy(m.from), xy(m.to) - xy(m.from), m.from.z, m.to.z, four);
      cells.each(stock.data(), 0, kCells, row.first, row.cell, [&](int) { ++given; });
    }
  }
  EXPECT_LT(static_cast<double>(given), 0.5 * 2.0 * static_cast<double>(of_all));
}

TEST(LineCells, OfABallThatStandATenthLowerThanItComesAreKeptBackButAtItsEnds) {
  constexpr int kCells = 128;
  std::mt19937 random(17);
  std::size_t between = 0, given = 0;
  const CutterOutline ball(geometry::ball_profile(6.0, 20.0));
  for (int i = 0; i < 200; ++i) {
    const Move m = line(random, 15 * i + 2);  // as long as a radius or some, and sloping
    const Row row = row_of(random, m);
    const Vec2 way = xy(m.to) - xy(m.from);
    std::vector<double> stock(kCells);
    std::vector<bool> inside(kCells);
    for (int ix = 0; ix < kCells; ++ix) {
      const double z = lowest(ball, m, row.centre(ix)),
                   foot = dot(row.centre(ix) - xy(m.from), way) / dot(way, way);
      stock[static_cast<std::size_t>(ix)] = z < 1e300 ? z - 0.1 : -100.0;
      // The ball touches the column where its surface slopes as the line does: that far downhill of the foot.
      const double rise = m.to.z - m.from.z;
      const double past = ball.radius() * std::abs(rise) / std::hypot(norm(way), rise) / norm(way);
      inside[static_cast<std::size_t>(ix)] = z < 1e300 && foot > past && foot < 1.0 - past;
      between += inside[static_cast<std::size_t>(ix)] ? 1 : 0;
    }
    for (const bool four : {false, LineCells::takes_four()}) {
      const LineCells cells(ball, xy(m.from), way, m.from.z, m.to.z, four);
      cells.each(stock.data(), 0, kCells, row.first, row.cell,
                 [&](int ix) { given += inside[static_cast<std::size_t>(ix)] ? 1 : 0; });
    }
  }
  EXPECT_GT(between, 500U);
  EXPECT_EQ(given, 0U);
}

TEST(LineWay, ABallMeetsEachPointThatItComesBelow) {
  std::mt19937 random(13);
  std::uniform_real_distribution<double> at(-6.0, 6.0);
  const CutterOutline ball(geometry::ball_profile(6.0, 20.0));
  int met = 0;
  for (int i = 0; i < 2000; ++i) {
    const Move m = line(random, i);
    const LineWay way(ball, m);
    const Vec2 p{m.from.x + at(random), m.from.y + at(random)};
    const double z = lowest(ball, m, p);
    if (z > 1e299) continue;
    Over over;
    ASSERT_TRUE(way.meets(p, z + 2e-6, over)) << i;
    EXPECT_LE(over.z, z + 1e-9) << i;
    ++met;
  }
  EXPECT_GT(met, 500);
}

TEST(CutterOutline, ItsFloorsLieUnderItsHeights) {
  for (const CutterOutline& o : outlines()) {
    for (double d = 0.0; d <= o.radius(); d += o.radius() / 997.0) {
      for (const auto& f : o.floors()) EXPECT_LE(f.at_0 + f.per_square * d * d, o.height(d)) << d;
    }
  }
}

}  // namespace
}  // namespace capstan::verify
