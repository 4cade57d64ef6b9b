#include "planner/ground/geometry/offset/raw_offset.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <random>

#include "tests/support/soak.h"

namespace capstan::geometry {
namespace {

/// r = 50 + 6 sin 5t mm: five lobes. The least radius of the tips, where r'' = -150 mm and r = 56 mm, is
/// r^2 / (1 - r'' / r) / r = 15.2 mm, that of the valleys 18 mm.
Loop lobes(int vertices, Vec2 centre = {}) {
  Loop out;
  for (int i = 0; i < vertices; ++i) {
    const double t = 2.0 * std::numbers::pi * i / vertices, r = 50.0 + 6.0 * std::sin(5.0 * t);
    out.push_back(centre + r * Vec2{std::cos(t), std::sin(t)});
  }
  return out;
}

constexpr int kPlaces = 1500;
/// Of the tolerance: chords, corners that stay sharp and vertices that are dropped (region.h).
constexpr double kMostBeyond = 1.5;

/// The most edges that stand over one height, in a grid of heights: what a sweep has in hand.
std::size_t most_at_once(const Loop& loop) {
  std::size_t most = 0;
  for (double y = -60.0; y < 60.0; y += 0.173) {
    std::size_t n = 0;
    for (std::size_t i = 0; i < loop.size(); ++i) n += (loop[i].y < y) != (loop[(i + 1) % loop.size()].y < y);
    most = std::max(most, n);
  }
  return most;
}

/// Every point far enough (inwards), or near enough (outwards), is in the offset and no other: told by
/// distances to the old boundary alone. What lies within the tolerance is not asked. How many places were
/// told.
int hold_by_distances(const Region& a, double delta, double tolerance, std::mt19937& random) {
  const Region moved = offset(a, delta, tolerance);
  const auto box = bounds(a);
  const double far = std::max(0.0, delta) + 1.0;
  std::uniform_real_distribution<double> x(box.lo.x - far, box.hi.x + far), y(box.lo.y - far, box.hi.y + far);
  int told = 0;
  for (int i = 0; i < kPlaces; ++i) {
    const Vec2 p{x(random), y(random)};
    const bool in = contains(a, p);
    const double beyond = distance_to_boundary(a, p) - std::abs(delta);
    const double slack = 10.0 * kRegionGrid;
    if (beyond > -slack && beyond < kMostBeyond * tolerance + slack) continue;
    ++told;
    EXPECT_EQ(contains(moved, p), delta < 0.0 ? in && beyond > 0.0 : in || beyond < 0.0)
        << p.x << ", " << p.y << " moved by " << delta;
  }
  for (const Loop& loop : moved.loops) {
    for (std::size_t i = 0; i < loop.size(); i += 3) {
      const Vec2 middle = 0.5 * (loop[i] + loop[(i + 1) % loop.size()]);
      EXPECT_GE(distance_to_boundary(a, loop[i]), std::abs(delta) - 10.0 * kRegionGrid);
      EXPECT_GE(distance_to_boundary(a, middle), std::abs(delta) - 10.0 * kRegionGrid);
    }
  }
  return told;
}

TEST(RawOffset, OfACurveHasAPointForEachVertexAndNoSpikeUpToItsLeastRadius) {
  for (const int n : {500, 2000, 8000}) {
    for (const double delta : {-15.0, -10.0, -1.0, 1.0, 10.0, 15.0}) {
      const RawOffset raw = raw_offset(lobes(n), delta, 0.01);
      EXPECT_EQ(raw.spikes, 0U) << n << " by " << delta;
      // Chords of a round corner, tolerance 0.01 mm, are 0.05 rad and more; here corners turn by 0.03 at most
      // and become two points where they do not stay sharp.
      EXPECT_LE(raw.loop.size(), 2U * static_cast<std::size_t>(n)) << n << " by " << delta;
    }
  }
}

// A sweep pays for the edges that it has in hand at each of n heights: n log n only if they do not grow with
// n. Clipper's own joins have n times the share of corners that close, some hundreds here.
TEST(RawOffset, OfMoreVerticesHasNotMoreEdgesAtOnce) {
  const std::size_t few = most_at_once(raw_offset(lobes(500), -10.0, 0.01).loop);
  EXPECT_LE(few, 8U);  // five lobes
  for (const int n : {2000, 4000, 16'000})
    EXPECT_LE(most_at_once(raw_offset(lobes(n), -10.0, 0.01).loop), few) << n;
}

TEST(RawOffset, ReachesTheRadiusOfACircle) {
  const Region circle = disc({3.0, 4.0}, 10.0, 0.0001);
  // An edge of 2 r sin(pi / n) over sin(2 pi / n).
  const double reach = 10.0 / std::cos(std::numbers::pi / static_cast<double>(circle.loops.front().size()));
  EXPECT_NEAR(reach_with_spikes(circle, false, 0), reach, 1e-6);
  EXPECT_EQ(reach_with_spikes(circle, true, 0), 1e300);
  EXPECT_EQ(raw_offset(circle.loops.front(), -0.999 * reach, 0.001).spikes, 1U);  // all close
  EXPECT_EQ(raw_offset(circle.loops.front(), -1.001 * reach, 0.001).spikes, circle.loops.front().size());
}

TEST(RawOffset, DropsCornersThatCloseAndSayLittle) {
  const Loop circle = disc({3.0, 4.0}, 10.0, 1e-6).loops.front();
  const Loop left = without_small_corners(circle, false, 0.001);
  // The sagitta of a chord over n-ths of a turn, 10 (1 - cos(pi / n)), is 0.001 mm at n = 222; runs are 32 at
  // most.
  EXPECT_LE(left.size(), 2U * 222U);
  const double lost = area(Region{{circle}}) - area(Region{{left}});
  EXPECT_GT(lost, 0.0);
  EXPECT_LE(lost, 20.0 * std::numbers::pi * 0.001);
  EXPECT_EQ(without_small_corners(circle, true, 0.001).size(), circle.size());
}

TEST(OffsetOfManyVertices, OfACircleIsNothingFromItsMiddleOn) {
  const Region circle = disc({3.0, 4.0}, 10.0, 1e-5);
  ASSERT_GT(circle.loops.front().size(), 1000U);
  EXPECT_NEAR(area(offset(circle, -9.0, 0.001)), std::numbers::pi, 2.0 * std::numbers::pi * 0.002);
  for (const double delta : {-10.0, -12.0, -19.0, -30.0}) EXPECT_TRUE(offset(circle, delta).empty()) << delta;
  const Region plate = subtract(rectangle({-50, -50}, {50, 50}), circle);
  EXPECT_EQ(offset(plate, 9.0).loops.size(), 2U);
  for (const double delta : {10.0, 12.0, 19.0, 30.0})
    EXPECT_EQ(offset(plate, delta).loops.size(), 1U) << delta;
}

TEST(OffsetOfManyVertices, IsWhatDistancesSay) {
  std::mt19937 random(7);
  Region a{{lobes(1200)}};
  for (const Vec2 c : {Vec2{20, 0}, Vec2{-15, 20}, Vec2{-10, -22}}) a = subtract(a, disc(c, 6.0, 0.0001));
  int told = 0;
  for (const double delta : {-0.5, -5.0, -9.0, -14.0, -30.0, 0.7, 4.0, 12.0, 40.0})
    told += hold_by_distances(a, delta, 0.003, random);
  EXPECT_GT(told, 9 * kPlaces * 95 / 100);
}

// Jagged outlines: edges of all lengths, corners of all angles, needles.
TEST(OffsetPropertyOfSeeds, OfAJaggedOutlineIsWhatDistancesSay) {
  const bool whole = soaking();
  const unsigned seed = whole ? static_cast<unsigned>(testing::UnitTest::GetInstance()->random_seed()) : 11U;
  for (int k = 0; k < rounds(3, 40); ++k) {
    std::mt19937 random(seed + static_cast<unsigned>(k));
    std::uniform_real_distribution<double> share(0.0, 1.0);
    const double depth = std::pow(10.0, -3.0 + 3.5 * share(random));
    Loop outline;
    for (int i = 0; i < 900; ++i) {
      const double t = 2.0 * std::numbers::pi * (i + 0.8 * share(random)) / 900.0;
      const double r = 30.0 + depth * share(random) + 4.0 * std::sin(3.0 * t);
      outline.push_back({r * std::cos(t), r * std::sin(t)});
    }
    const Region a = clean({outline});
    for (const double delta : {-20.0 * share(random), -1.0, 0.3, 15.0 * share(random)})
      EXPECT_GT(hold_by_distances(a, delta, 0.005, random), kPlaces * 3 / 4)
          << "seed " << seed + static_cast<unsigned>(k);
  }
}

}  // namespace
}  // namespace capstan::geometry
