#include "planner/proof/verify/sweep/grid/closer_look.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "planner/proof/verify/sweep/grid/way.h"
#include "tests/support/paths/outlines.h"

// A closer look leaves out what decides nothing. Held here against a look that leaves out nothing: all points
// of the place, each cut made again on them.

namespace capstan::verify {
namespace {

using geometry::Vec2;
using geometry::Vec3;
using OutlinePtr = std::shared_ptr<const CutterOutline>;

constexpr double kCell = 0.4, kCloser = 8.0, kPoints = 40e3;

std::vector<OutlinePtr> cutters() {
  std::vector<OutlinePtr> out;
  for (const auto& p :
       {geometry::flat_profile(6, 20), geometry::ball_profile(6, 20), geometry::bull_profile(8, 1.5, 20),
        geometry::cone_profile(8, 90 * std::numbers::pi / 180, 20, 2), test::lens(), test::barrel()})
    out.push_back(std::make_shared<const CutterOutline>(p));
  return out;
}

/// A block of 40 x 40 x 20 about the origin, its top at 0, with a step in it and an underside that is cut
/// away.
Grid block() {
  Grid g({-20, -20}, {20, 20}, kCell, 100000);
  g.floor = -20.0;
  for (int iy = 0; iy < g.ny(); ++iy) {
    for (int ix = 0; ix < g.nx(); ++ix) {
      const Vec2 p = g.centre(ix, iy);
      g.stock[g.index(ix, iy)] = p.x > 8.0 ? -0.7 : 0.0;
      g.base[g.index(ix, iy)] = p.y < -6.0 ? -2.0 : -20.0;
    }
  }
  g.find_top();
  return g;
}

/// A way no longer than four radii, so that it is looked at in one piece.
class Ways {
 public:
  explicit Ways(unsigned seed) : random_(seed) {}
  double between(double lo, double hi) { return std::uniform_real_distribution<double>(lo, hi)(random_); }
  Move next() {
    Move m;
    m.kind = model::MoveKind::kLine;
    m.from = last_;
    const double turn = between(0.0, 2.0 * std::numbers::pi), level = between(-2.5, 0.2);
    const bool again = between(0.0, 1.0) < 0.6;  // at the height of the move before
    m.to = {std::clamp(last_.x + between(0.2, 5.0) * std::cos(turn), -19.0, 19.0),
            std::clamp(last_.y + between(0.2, 5.0) * std::sin(turn), -19.0, 19.0), again ? last_.z : level};
    if (between(0.0, 1.0) < 0.4) {
      m.kind = between(0.0, 1.0) < 0.5 ? model::MoveKind::kArcCw : model::MoveKind::kArcCcw;
      const double r = between(0.5, 4.0);
      m.centre = xy(last_) + r * Vec2{std::cos(turn), std::sin(turn)};
      const double end = turn + std::numbers::pi + between(0.0, 2.0 * std::numbers::pi);
      m.to = {m.centre.x + r * std::cos(end), m.centre.y + r * std::sin(end), m.to.z};
    }
    last_ = m.to;
    return m;
  }

 private:
  std::mt19937 random_;
  Vec3 last_{0.0, 0.0, -0.5};
};

/// All points of a move's place, as what stood at the beginning and these cuts leave them.
Grid all_points(const Grid& begun, const std::vector<std::pair<Move, OutlinePtr>>& cuts, const Move& m,
                double radius_mm, bool where_all_have_it) {
  const geometry::Box3 box = box_of(m);
  const Vec2 lo{box.lo.x - radius_mm, box.lo.y - radius_mm}, hi{box.hi.x + radius_mm, box.hi.y + radius_mm};
  Grid g(lo, hi, std::max(kCell / kCloser, std::sqrt((hi.x - lo.x) * (hi.y - lo.y) / kPoints)), 80000);
  for (int iy = 0; iy < g.ny(); ++iy) {
    for (int ix = 0; ix < g.nx(); ++ix) {
      const Vec2 p = g.centre(ix, iy);
      const auto [x0, x1] = begun.columns(p.x - 1.01 * kCell, p.x + 1.01 * kCell);
      const auto [y0, y1] = begun.rows(p.y - 1.01 * kCell, p.y + 1.01 * kCell);
      const bool beside = x1 - x0 < 2 || y1 - y0 < 2;
      double stock = where_all_have_it && !beside ? 1e300 : Grid::kNothing;
      double base = where_all_have_it ? Grid::kNothing : 1e300;
      for (int y = y0; y < y1; ++y) {
        for (int x = x0; x < x1; ++x) {
          const double s = begun.stock[begun.index(x, y)], b = begun.base[begun.index(x, y)];
          stock = where_all_have_it ? std::min(stock, s) : std::max(stock, s);
          base = where_all_have_it ? std::max(base, b) : std::min(base, b);
        }
      }
      g.stock[g.index(ix, iy)] = stock > base ? stock : Grid::kNothing;
      g.base[g.index(ix, iy)] = base;
    }
  }
  g.find_top();
  for (const auto& [move, cutter] : cuts) (void)cut(g, move, *cutter, {});
  return g;
}

TEST(CloserLook, FindsTheChipThatALookAtAllPointsFinds) {
  int found = 0, none = 0;
  for (unsigned seed = 0; seed < 12; ++seed) {
    const OutlinePtr cutter = cutters()[seed % 4];
    Ways ways(seed);
    const Grid begun = block();
    EarlierCuts earlier;
    earlier.begin(begun);
    std::vector<std::pair<Move, OutlinePtr>> cuts;
    for (int i = 0; i < 24; ++i) {
      const Move m = ways.next();
      const double advance = ways.between(0.05, 0.3), least = advance * ways.between(0.2, 0.95);
      int pieces = 1;
      const Chip chip = earlier.look(begun, m, cutter, advance, least, pieces);
      Grid all = all_points(begun, cuts, m, cutter->radius(), true);
      const Bite bite = cut(all, m, *cutter, {.advance_mm = advance});
      EXPECT_EQ(chip.mm, bite.chip_mm > least ? bite.chip_mm : 0.0) << "seed " << seed << ", move " << i;
      EXPECT_TRUE(chip.mm == 0.0 || norm(chip.at - bite.chip_at) == 0.0) << "seed " << seed << ", move " << i;
      ++(chip.mm > 0.0 ? found : none);
      earlier.add(m, cutter);
      cuts.emplace_back(m, cutter);
    }
  }
  // Neither is rare.
  EXPECT_GT(found, 40);
  EXPECT_GT(none, 40);
}

TEST(CloserLook, TakesWhatALookAtAllPointsTakes) {
  int takes = 0, nothing = 0;
  for (unsigned seed = 100; seed < 112; ++seed) {
    const OutlinePtr cutter = cutters()[seed % 4];
    Ways ways(seed);
    const Grid begun = block();
    EarlierCuts earlier;
    earlier.begin(begun);
    std::vector<std::pair<Move, OutlinePtr>> cuts;
    for (int i = 0; i < 16; ++i) {
      Move m = ways.next();
      if (i % 3 == 2) {  // the way of the one before once more
        m = cuts.back().first;
        if (i % 2 == 0) m.from.z = m.to.z += 0.001;
      }
      double cell = 0.0;
      const bool took = earlier.takes(begun, {m}, *cutter, earlier.mark(), cell);
      Grid all = all_points(begun, cuts, m, cutter->radius(), false);
      EXPECT_EQ(took, cut(all, m, *cutter, {}).volume_mm3 > 0.0) << "seed " << seed << ", move " << i;
      EXPECT_EQ(cell, all.cell());
      ++(took ? takes : nothing);
      earlier.add(m, cutter);
      cuts.emplace_back(m, cutter);
    }
  }
  EXPECT_GT(takes, 40);
  EXPECT_GT(nothing, 40);
}

TEST(CloserLook, OfALongWaySeesWhatItsOwnBeginningTook) {
  // Six pieces along y = 0: what stands before the second is what the first has left.
  const OutlinePtr cutter = cutters()[0];
  const Grid begun = block();
  EarlierCuts earlier;
  earlier.begin(begun);
  Move m;
  m.kind = model::MoveKind::kLine;
  m.from = {-40, 0, -1};
  m.to = {7, 0, -1};
  int pieces = 8;
  // Nowhere thicker than the advance, which the middle of the way meets square on.
  const Chip chip = earlier.look(begun, m, cutter, 0.1, 0.05, pieces);
  EXPECT_EQ(pieces, 8 - 4);
  EXPECT_NEAR(chip.mm, 0.1, 1e-3);
  // Once more along the same way there is nothing.
  earlier.add(m, cutter);
  pieces = 8;
  EXPECT_EQ(earlier.look(begun, m, cutter, 0.1, 0.05, pieces).mm, 0.0);
}

TEST(Way, LeavesNoPointHigherThanItSaysOfWhatLiesAboutIt) {
  Ways ways(7);
  for (int i = 0; i < 400; ++i) {
    const OutlinePtr cutter = cutters()[static_cast<std::size_t>(i) % 4];
    const Move m = ways.next();
    along_way(*cutter, m, [&](const auto& way) {
      const Vec2 middle =
          xy(point_of(m, ways.between(0.0, 1.0))) + Vec2{ways.between(-4.0, 4.0), ways.between(-4.0, 4.0)};
      const double apart = ways.between(0.0, 0.5), most = way.leaves(way.distance(middle), apart);
      if (most > 1e299) return;
      for (int k = 0; k < 16; ++k) {
        const double turn = 2.0 * std::numbers::pi * k / 16;
        const Vec2 p = middle + apart * Vec2{std::cos(turn), std::sin(turn)};
        Over over;
        ASSERT_TRUE(way.meets(p, 1e6, over)) << "move " << i;
        EXPECT_LE(over.z, most) << "move " << i;
      }
    });
  }
}

}  // namespace
}  // namespace capstan::verify
