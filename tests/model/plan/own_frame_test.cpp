#include "planner/model/plan/path/own_frame.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace capstan::model {
namespace {

using geometry::Vec2;

/// Down a helix of two turns in halves, then a ring with rounded corners, about a place and from an angle on.
CutterPath pocket(Vec2 c, double angle) {
  CutterPath p;
  const Vec2 r{1.7 * std::cos(angle), 1.7 * std::sin(angle)};
  p.start({c.x + r.x, c.y + r.y, 2.0});
  p.line({c.x + r.x, c.y + r.y, 0.1}, MoveRole::kApproach);
  for (int half = 1; half <= 4; ++half) {
    const double side = half % 2 == 0 ? 1.0 : -1.0;
    p.arc({c.x + side * r.x, c.y + side * r.y, 0.1 - 0.3 * half}, c, false, MoveRole::kRamp);
  }
  p.line({c.x + 4.9, c.y - 2.3, -1.1}, MoveRole::kCut);
  p.arc({c.x + 5.6, c.y - 1.6, -1.1}, {c.x + 4.9, c.y - 1.6}, false, MoveRole::kCut);
  p.arc({c.x + 5.6, c.y - 1.6, -1.1}, {c.x + 5.1, c.y - 1.6}, true, MoveRole::kCut);  // a whole turn
  p.rapid({c.x + 5.6, c.y - 1.6, 2.0});
  return p;
}

CutterPath own(const CutterPath& p) { return in_own_frame(p, own_origin(p)); }

// Places that no double holds: the same path there differs in last bits.
TEST(OwnFrame, GivesEqualPathsTheSameBytesWhereverTheyLie) {
  const CutterPath here = own(pocket({0, 0}, 0.4));
  for (const Vec2 at : {Vec2{23.1, 7.7}, Vec2{-123.4, 56.3}, Vec2{411.9, 77.7}}) {
    EXPECT_EQ(own(pocket(at, 0.4)), here) << at.x << ", " << at.y;
    EXPECT_NE(own(pocket(at, 0.5)), here) << "another path is another";
  }
}

TEST(OwnFrame, MovesEndsOfLinesByHalfItsGridAtMostAndThoseOfArcsByOne) {
  const Vec2 at{23.1, 7.7};
  CutterPath p = pocket(at, 0.4);
  for (int k = 1; k <= 20; ++k) p.line({at.x + 0.37 * k, at.y - 1.3 * k, 0.1 * k}, MoveRole::kCut);
  const CutterPath q = own(p);
  const Vec2 origin = own_origin(p);
  const auto arc_at = [&](std::size_t i) { return i > 0 && i < p.size() && is_arc(p.kind[i]); };
  bool of_arc = false;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const bool stays = i > 0 && p.x[i] == p.x[i - 1] && p.y[i] == p.y[i - 1];
    if (!stays) of_arc = arc_at(i) || arc_at(i + 1);
    // An end of an arc is rounded about a centre that is rounded, too.
    const double most = (of_arc ? 1.0 : 0.5) * kOwnGrid + 1e-14;
    EXPECT_NEAR(q.x[i], p.x[i] - origin.x, most);
    EXPECT_NEAR(q.y[i], p.y[i] - origin.y, most);
    EXPECT_NEAR(q.z[i], p.z[i], 0.5 * kOwnGrid);
    EXPECT_EQ(q.kind[i], p.kind[i]);
    EXPECT_NEAR(move_length(q, i), move_length(p, i), 4.0 * std::numbers::pi * kOwnGrid);
  }
}

TEST(OwnFrame, KeepsTheTurnsOfAHelixOnOneRadius) {
  const CutterPath p = own(pocket({23.1, 7.7}, 0.4));
  for (std::size_t i = 2; i <= 5; ++i)
    EXPECT_EQ(std::hypot(p.x[i] - p.cx[i], p.y[i] - p.cy[i]), std::hypot(p.x[1] - p.cx[2], p.y[1] - p.cy[2]));
}

TEST(OwnFrame, MakesNoWholeTurnOfAnArcThatIsShorterThanItsGrid) {
  CutterPath p = pocket({23.1, 7.7}, 0.4);
  const geometry::Vec3 from = p.point(6);
  const Vec2 centre{from.x, from.y + 2.0};
  p.x.resize(7), p.y.resize(7), p.z.resize(7), p.cx.resize(7), p.cy.resize(7), p.kind.resize(7),
      p.role.resize(7);
  p.arc({from.x + 3e-9, from.y, from.z}, centre, false, MoveRole::kCut);
  ASSERT_LT(arc_sweep(p, 7), 1e-8);
  EXPECT_LT(move_length(own(p), 7), 1e-8);
  // Round the other way it is a whole turn but for that: it stays one.
  p.kind[7] = MoveKind::kArcCw;
  const CutterPath q = own(p);
  EXPECT_TRUE(is_arc(q.kind[7]));
  EXPECT_NEAR(move_length(q, 7), 4.0 * std::numbers::pi, 1e-7);
}

}  // namespace
}  // namespace capstan::model
