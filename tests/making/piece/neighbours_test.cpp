#include "planner/making/piece/neighbours.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace capstan::piece {
namespace {

using geometry::Vec3;
using model::FeatureShape;

FeatureShape square(Vec3 at, Vec3 z, double side) {
  FeatureShape s;
  s.frame = geometry::make_placement(at, z).value();
  s.area = geometry::rectangle({-0.5 * side, -0.5 * side}, {0.5 * side, 0.5 * side});
  return s;
}

/// Distance of two balls, seen along an axis.
double apart(const Around& a, const Around& b, Vec3 axis) {
  const Vec3 way = b.centre - a.centre;
  const double along = dot(way, axis);
  return std::sqrt(std::max(0.0, dot(way, way) - along * along)) - a.radius_mm - b.radius_mm;
}

TEST(NeighboursProperty, AreAllThatLieWithinReachAndLittleMore) {
  std::mt19937 random(3);
  const auto between = [&](double lo, double hi) {
    return std::uniform_real_distribution<double>(lo, hi)(random);
  };
  for (const double spread : {0.0, 1.0, 300.0}) {
    std::vector<FeatureShape> shapes;
    for (int i = 0; i < 400; ++i) {
      const Vec3 z = i % 3 == 0   ? Vec3{0, 0, -1}
                     : i % 3 == 1 ? Vec3{0, 0, 1}
                                  : Vec3{std::sin(i), 0, std::cos(i)};
      shapes.push_back(square({between(0, spread), between(0, spread), between(-20, 0)}, z,
                              i % 50 == 0 ? 120.0 : between(1, 10)));
    }
    const Neighbours index(shapes);
    ASSERT_EQ(index.size(), shapes.size());
    std::size_t found = 0, near = 0;
    for (std::size_t i = 0; i < shapes.size(); i += 7) {
      const Vec3 axis = shapes[i].frame.z;
      for (const double reach : {0.0, 3.0, 40.0, 1000.0}) {
        const auto got = index.near(index.ball(i), axis, reach);
        EXPECT_TRUE(std::is_sorted(got.begin(), got.end()));
        EXPECT_EQ(std::adjacent_find(got.begin(), got.end()), got.end());
        found += got.size();
        for (std::size_t k = 0; k < shapes.size(); ++k) {
          const bool parallel = std::abs(dot(shapes[k].frame.z, axis)) >= 1.0 - 1e-6;
          const double d = apart(index.ball(i), index.ball(k), axis);
          const bool in = std::binary_search(got.begin(), got.end(), k);
          const bool wanted = parallel && d <= reach;
          EXPECT_TRUE(in || !wanted) << i << " and " << k << ", reach " << reach;
          EXPECT_FALSE(in && d > reach + 1.0) << i << " and " << k << ", reach " << reach;
          near += parallel && d <= reach;
        }
      }
    }
    EXPECT_GE(found, near);
    EXPECT_GT(near, 1000U);
  }
}

TEST(Neighbours, AreNoneOfNoShapes) {
  EXPECT_TRUE(Neighbours(std::vector<FeatureShape>{}).near({}, {0, 0, 1}, 1e9).empty());
  EXPECT_TRUE(Neighbours().near({}, {0, 0, 1}, 1e9).empty());
}

}  // namespace
}  // namespace capstan::piece
