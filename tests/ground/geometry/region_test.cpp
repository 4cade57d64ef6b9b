#include "planner/ground/geometry/region.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "planner/ground/geometry/placement.h"
#include "planner/ground/geometry/profile.h"

namespace capstan::geometry {
namespace {

TEST(Region, OffsetOfARectangleHasTheAreaOfItsRoundedGrowth) {
  const Region r = rectangle({0, 0}, {40, 20});
  // Steiner: A + P d + pi d^2 (the chords stay within a tolerance of 1 um outside).
  const double exact = 800 + 120 * 3.0 + std::numbers::pi * 9.0;
  EXPECT_NEAR(area(offset(r, 3.0)), exact, 140 * 0.002);
  EXPECT_NEAR(area(offset(r, -3.0)), 34.0 * 14.0, 100 * 0.002);
  EXPECT_TRUE(offset(r, -10.1).empty());
}

TEST(Region, OffsetNeverComesNearerThanAsked) {
  // The wall ring of a pocket with an island: clipper's chords would fall on the gouge side.
  const Region pocket = subtract(rounded_rectangle({0, 0}, {50, 30}, 6.0), disc({25, 15}, 5.0));
  const Region ring = offset(pocket, -4.0);
  for (const Loop& loop : ring.loops) {
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const Vec2 a = loop[i];
      const Vec2 b = loop[(i + 1) % loop.size()];
      for (const double t : {0.0, 0.25, 0.5, 0.75}) {
        EXPECT_GE(distance_to_boundary(pocket, a + t * (b - a)), 4.0 - 2 * kRegionGrid);
      }
    }
  }
}

TEST(Region, PiecesKeepTheirHoles) {
  const Region two =
      unite(subtract(rectangle({0, 0}, {10, 10}), rectangle({2, 2}, {4, 4})), rectangle({20, 0}, {25, 5}));
  const auto parts = pieces(two);
  ASSERT_EQ(parts.size(), 2U);
  EXPECT_NEAR(area(parts[0]), 96.0, 1e-6);
  EXPECT_NEAR(area(parts[1]), 25.0, 1e-6);
  EXPECT_FALSE(contains(two, {3, 3}));
  EXPECT_TRUE(contains(two, {1, 1}));
}

// A star of 24 corners with a hole, held against the sign of the distance along rays computed in doubles: the
// sum of the angles under which a point sees the edges is a whole turn inside and nothing outside.
TEST(Region, ContainsWhatItsEdgesTurnAround) {
  Loop star;
  for (int i = 0; i < 24; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / 24, r = i % 2 == 0 ? 20.0 : 9.0;
    star.push_back({r * std::cos(angle), r * std::sin(angle)});
  }
  const Region a = subtract(Region{{star}}, rectangle({-3, -2}, {3, 2}));
  int inside = 0;
  for (double x = -21.0; x <= 21.0; x += 0.37) {
    for (double y = -21.0; y <= 21.0; y += 0.41) {
      const Vec2 p{x, y};
      if (distance_to_boundary(a, p) < 1e-3) continue;
      double turned = 0.0;
      for (const Loop& loop : a.loops) {
        for (std::size_t i = 0; i < loop.size(); ++i) {
          const Vec2 u = loop[i] - p, v = loop[(i + 1) % loop.size()] - p;
          turned += std::atan2(u.x * v.y - u.y * v.x, dot(u, v));
        }
      }
      EXPECT_EQ(contains(a, p), turned > std::numbers::pi) << x << ", " << y;
      inside += contains(a, p) ? 1 : 0;
    }
  }
  EXPECT_GT(inside, 1000);
}

TEST(Region, ContainsItsEdgesAndCorners) {
  const Region a = subtract(rectangle({0, 0}, {10, 6}), rectangle({2, 2}, {4, 4}));
  for (const Vec2 p : {Vec2{0, 0}, {10, 6}, {5, 0}, {5, 6}, {0, 3}, {10, 3}, {2, 3}, {3, 2}, {4, 4}})
    EXPECT_TRUE(contains(a, p)) << p.x << ", " << p.y;
  for (const Vec2 p : {Vec2{-1, 0}, {11, 6}, {-1, 2}, {12, 2}, {3, 3}, {5, -1e-3}, {5, 6.001}})
    EXPECT_FALSE(contains(a, p)) << p.x << ", " << p.y;
}

TEST(Placement, ToLocalUndoesToParent) {
  const auto p = make_placement({1, 2, 3}, {1, 1, 1}, {0, 1, 0.2});
  ASSERT_TRUE(p);
  const Vec3 q{0.3, -7.0, 11.0};
  EXPECT_LT(norm(p->to_local(p->to_parent(q)) - q), 1e-12);
  const Placement there_and_back = compose(*p, inverse(*p));
  EXPECT_LT(norm(there_and_back.origin), 1e-12);
  EXPECT_LT(norm(there_and_back.x - Vec3{1, 0, 0}), 1e-12);
}

TEST(Placement, RefusesDirectionsThatSpanNothing) {
  EXPECT_FALSE(make_placement({}, {0, 0, 0}, {1, 0, 0}));
  EXPECT_FALSE(make_placement({}, {0, 0, 1}, {0, 0, 2}));
  EXPECT_FALSE(make_placement({}, {0, 0, 1}, {0, 0, 0}));
}

TEST(CutterProfile, HeightFollowsTheClosedForms) {
  const auto ball = ball_profile(10, 20);
  for (double r = 0; r <= 5.0; r += 0.1) EXPECT_NEAR(ball.height(r), 5 - std::sqrt(25 - r * r), 1e-12);
  const auto bull = bull_profile(10, 2, 20);
  EXPECT_EQ(bull.height(2.9), 0.0);
  EXPECT_NEAR(bull.height(5.0), 2.0, 1e-12);
  const auto drill = cone_profile(10, 118 * std::numbers::pi / 180, 50);
  EXPECT_NEAR(drill.height(5.0), 5.0 / std::tan(59 * std::numbers::pi / 180), 1e-12);
  EXPECT_TRUE(std::isinf(drill.height(5.001)));
}

/// Appends an arc that begins below its centre, and holds each point against sine and cosine.
void expect_arc(double radius, double sweep, double tolerance, std::size_t more_than) {
  const Vec2 centre{0.25 * radius, -3.0}, start = centre + Vec2{0.0, -radius};
  Loop got;
  append_arc(got, centre, start, sweep, tolerance);
  ASSERT_GT(got.size(), more_than);
  const double from = std::atan2((start - centre).y, 0.0), r = norm(start - centre);
  for (std::size_t i = 0; i < got.size(); ++i) {
    const double a = from + sweep * static_cast<double>(i + 1) / static_cast<double>(got.size());
    ASSERT_EQ(got[i], (Vec2{centre.x + r * std::cos(a), centre.y + r * std::sin(a)})) << radius << ", " << i;
  }
}

TEST(AppendArc, GivesTheSamePointsHoweverManyArcsComeBetween) {
  // More sizes than are kept: one that is still known, one that was asked for a while ago, one long gone.
  constexpr int kSizes = 23, kPrime = 7;
  for (int k = 0; k < 3 * kSizes; ++k) {
    for (const int back : {0, 0, 5, 20}) {
      const int size = (k + kSizes - back) * kPrime % kSizes;
      expect_arc(0.5 + 0.3 * size, size % 2 == 0 ? 1.25 : -2.0 * std::numbers::pi, 1e-3, 3);
    }
  }
}

TEST(AppendArc, GivesTheSamePointsOfArcsWithMoreThanAreKept) {
  for (int i = 0; i < 2; ++i) {
    for (const double radius : {5.0, 7.0, 5.0}) expect_arc(radius, 2.0 * std::numbers::pi, 1e-6, 4096);
    expect_arc(5.0, 1.25, 1e-3, 3);
  }
}

}  // namespace
}  // namespace capstan::geometry
