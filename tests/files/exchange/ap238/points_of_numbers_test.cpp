#include "planner/files/exchange/ap238/paths/points_of_numbers.h"

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cstddef>
#include <limits>
#include <vector>

#include "planner/model/nouns/all.h"
#include "planner/model/nouns/arena/model.h"

namespace capstan::exchange::ap238 {
namespace {

using Numbers = std::array<double, 2>;
using Point = model::Ref<model::CartesianPoint>;

constexpr std::size_t kMost = 4;

/// `kMost` pairs of numbers that begin at one slot of a table for as many.
std::vector<Numbers> colliding() {
  const std::size_t slots = std::bit_ceil(2 * kMost + 1);
  std::vector<Numbers> out;
  for (double x = 1.0; out.size() < kMost; x += 1.0) {
    if (HashOfNumbers()(Numbers{x, 0.5}) % slots == 3) out.push_back({x, 0.5});
  }
  return out;
}

TEST(PointsOfNumbers, GivesEachItsOwnWhereTheirHashesMeet) {
  model::Model m;
  PointsOfNumbers<Numbers> known(kMost);
  std::vector<Point> points;
  for (const Numbers& v : colliding()) {
    Point& p = known[v];
    EXPECT_FALSE(p);
    p = m.add<model::CartesianPoint>();
    points.push_back(p);
  }
  for (std::size_t i = 0; i < kMost; ++i) EXPECT_EQ(known[colliding()[i]], points[i]);
}

TEST(PointsOfNumbers, GivesNoOtherThePlaceThatWasLeftUnset) {
  model::Model m;
  PointsOfNumbers<Numbers> known(kMost);
  const auto of = colliding();
  EXPECT_FALSE(known[of[0]]);
  const Point second = m.add<model::CartesianPoint>();
  known[of[1]] = second;
  EXPECT_FALSE(known[of[0]]);
  EXPECT_EQ(known[of[1]], second);
}

TEST(PointsOfNumbers, TakesZerosOfBothSignsForOne) {
  model::Model m;
  PointsOfNumbers<Numbers> known(kMost);
  const Point p = m.add<model::CartesianPoint>();
  known[{0.0, -0.0}] = p;
  EXPECT_EQ(known[(Numbers{-0.0, 0.0})], p);
  EXPECT_EQ(known[(Numbers{-0.0, -0.0})], p);
  EXPECT_FALSE(known[(Numbers{0.0, std::numeric_limits<double>::denorm_min()})]);
}

TEST(PointsOfNumbers, KnowsNoNanAgain) {
  model::Model m;
  PointsOfNumbers<Numbers> known(kMost);
  const Numbers v{1.0, std::numeric_limits<double>::quiet_NaN()};
  for (std::size_t k = 0; k + 1 < kMost; ++k) {
    Point& p = known[v];
    EXPECT_FALSE(p) << k;
    p = m.add<model::CartesianPoint>();
  }
  EXPECT_FALSE(known[(Numbers{1.0, 0.0})]);
}

}  // namespace
}  // namespace capstan::exchange::ap238
