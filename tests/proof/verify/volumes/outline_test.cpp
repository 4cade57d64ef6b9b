#include "planner/proof/verify/volumes/outline.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace capstan::verify::volumes {
namespace {

constexpr double kPi = std::numbers::pi;

Outline of(const std::vector<Edge>& edges) {
  Outline o;
  for (const Edge& e : edges) o.add(e);
  return o;
}

/// 20 x 10 about the origin with half circles of radius 5 at both ends: from x = -15 to x = 15.
Outline stadium() {
  return of({straight({-10, -5}, {10, -5}), round({10, 0}, 5, -kPi / 2, kPi), straight({10, 5}, {-10, 5}),
             round({-10, 0}, 5, kPi / 2, kPi)});
}

TEST(Outline, HoldsWhatItsArcsHoldAndNotTheirChordsOnly) {
  const Outline o = stadium();
  EXPECT_TRUE(inside(o, {14.99, 0}));
  EXPECT_FALSE(inside(o, {15.01, 0}));
  EXPECT_TRUE(inside(o, {10, 0}));   // on a chord
  EXPECT_TRUE(inside(o, {-10, 0}));  // on the other
  EXPECT_TRUE(inside(o, {10, 4.99}));
  // On the arc at 45 degrees: 10 + 5 cos 45 = 13.536.
  EXPECT_TRUE(inside(o, {13.52, 3.52}));
  EXPECT_FALSE(inside(o, {13.55, 3.55}));
  EXPECT_NEAR(twice_area(o), 2 * (200 + kPi * 25), 1e-9);
  EXPECT_EQ(o.lo.x, -15);
  EXPECT_EQ(o.hi.x, 15);
}

TEST(Outline, SortedIntoRowsHoldsTheSame) {
  // Waves of short lines, half circles upwards and one long upright line.
  Outline o;
  for (int i = 0; i < 100; ++i) {
    const double x = 0.3 * i, y = std::sin(0.7 * i);
    o.add(straight({x, y}, {x + 0.1, y + 0.05}));
    const double next = std::sin(0.7 * (i + 1));
    o.add(straight({x + 0.1, y + 0.05}, {x + 0.3, next}));
  }
  o.add(straight({30.0, std::sin(70.0)}, {30.0, 4.0}));
  for (int i = 0; i < 100; ++i) o.add(round({29.85 - 0.3 * i, 4.0}, 0.15, 0.0, kPi));
  o.add(straight({0.0, 4.0}, {0.0, 0.0}));
  Outline sorted = o;
  sorted.sort();
  ASSERT_TRUE(sorted.rows);
  int in = 0, asked = 0;
  for (double x = -1.0; x < 31.0; x += 0.0371) {
    for (double y = -2.0; y < 5.0; y += 0.0713) {
      EXPECT_EQ(turns_around(sorted, {x, y}), turns_around(o, {x, y})) << x << " " << y;
      in += turns_around(o, {x, y}) != 0 ? 1 : 0;
      ++asked;
    }
  }
  EXPECT_GT(in, asked / 3);
  EXPECT_LT(in, asked);
  // At the ends of edges, too.
  for (const Edge& e : o.edges) EXPECT_EQ(turns_around(sorted, e.from), turns_around(o, e.from));
  sorted.add(straight({0.0, 0.0}, {0.0, 0.0}));
  EXPECT_FALSE(sorted.rows) << "an edge that is new is in no row";
}

TEST(Outline, IsTheSameTheOtherWayRound) {
  const Outline o = stadium();
  Outline back;
  for (auto e = o.edges.rbegin(); e != o.edges.rend(); ++e) back.add(e->reversed());
  for (int i = -16; i <= 16; ++i) {
    for (int k = -6; k <= 6; ++k) {
      const geometry::Vec2 p{i * 1.0, k * 0.97};
      EXPECT_EQ(inside(o, p), inside(back, p)) << p.x << " " << p.y;
      EXPECT_NEAR(nearest(o, p).distance_mm, nearest(back, p).distance_mm, 1e-12);
    }
  }
  EXPECT_NEAR(twice_area(back), -twice_area(o), 1e-9);
}

TEST(Outline, AWholeCircleAndAnArcOf270DegreesHoldTheirMiddle) {
  const Outline circle = of({round({3, 4}, 2, 0, 2 * kPi)});
  EXPECT_TRUE(inside(circle, {3, 4}));
  EXPECT_TRUE(inside(circle, {4.99, 4}));
  EXPECT_FALSE(inside(circle, {5.01, 4}));
  // From (1, 0) by three quarters to (0, -1), and straight back.
  const Outline most = of({round({0, 0}, 1, 0, 1.5 * kPi), straight({0, -1}, {1, 0})});
  EXPECT_TRUE(inside(most, {0, 0}));
  EXPECT_TRUE(inside(most, {-0.7, -0.7}));
  EXPECT_FALSE(inside(most, {0.6, -0.6}));
}

TEST(Outline, ABayIsOutsideAndItsDistanceIsThatToTheArc) {
  // A square of 10 with a half circle of radius 3 cut into its right side.
  const Outline o =
      of({straight({0, 0}, {10, 0}), straight({10, 0}, {10, 2}), round({10, 5}, 3, -kPi / 2, -kPi),
          straight({10, 8}, {10, 10}), straight({10, 10}, {0, 10}), straight({0, 10}, {0, 0})});
  EXPECT_FALSE(inside(o, {8, 5}));
  EXPECT_TRUE(inside(o, {6.9, 5}));
  EXPECT_NEAR(nearest(o, {5, 5}).distance_mm, 2.0, 1e-12);
  EXPECT_NEAR(twice_area(o), 2 * (100 - kPi * 9 / 2), 1e-9);
}

TEST(Outline, ARadiusRoundsItsInsideCornersExactly) {
  const Outline square = of({straight({0, 0}, {10, 0}), straight({10, 0}, {10, 10}),
                             straight({10, 10}, {0, 10}), straight({0, 10}, {0, 0})});
  const Rounded r = rounded(square, 3);
  ASSERT_EQ(r.fault, "");
  EXPECT_EQ(r.outline.edges.size(), 8u);
  // Four corners of (1 - pi / 4) r^2 are missing.
  EXPECT_NEAR(twice_area(r.outline), 2 * (100 - (4 - kPi) * 9), 1e-9);
  // Nearest to a corner: 3 (sqrt 2 - 1) along the diagonal.
  const double gone = 3 * (std::numbers::sqrt2 - 1) / std::numbers::sqrt2;
  EXPECT_FALSE(inside(r.outline, {gone - 0.01, gone - 0.01}));
  EXPECT_TRUE(inside(r.outline, {gone + 0.01, gone + 0.01}));
  EXPECT_EQ(rounded(square, 5).fault, "");
  EXPECT_NE(rounded(square, 5.1).fault, "");
}

TEST(Outline, ARadiusBetweenALineAndAnArcTouchesBoth) {
  // A half disc of radius 10 above y = 0: its corners at (-10, 0) and (10, 0) are square.
  const Outline half = of({straight({-10, 0}, {10, 0}), round({0, 0}, 10, 0, kPi)});
  const Rounded r = rounded(half, 2);
  ASSERT_EQ(r.fault, "");
  // The centre of the circle is 2 above the line and 8 from the middle: x = sqrt(64 - 4) = 7.746.
  const geometry::Vec2 centre{std::sqrt(60.0), 2};
  EXPECT_NEAR(nearest(r.outline, centre).distance_mm, 2.0, 1e-9);
  EXPECT_TRUE(inside(r.outline, {centre.x + 1.4, centre.y - 1.4}));
  EXPECT_FALSE(inside(r.outline, {centre.x + 1.5, centre.y - 1.5}));
  EXPECT_TRUE(inside(half, {centre.x + 1.5, centre.y - 1.5}));
}

}  // namespace
}  // namespace capstan::verify::volumes
