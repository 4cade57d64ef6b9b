#include "planner/ground/geometry/mesh/mesh_corners.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <utility>
#include <vector>

namespace capstan::geometry {
namespace {

/// An L of 4 x 4 mm, its notch from (2, 2) on, extruded from z = 0 to 3.
Mesh l_shape() {
  const std::vector<Vec2> outline = {{0, 0}, {4, 0}, {4, 2}, {2, 2}, {2, 4}, {0, 4}};
  Mesh m;
  for (const double z : {0.0, 3.0}) {
    for (const Vec2 p : outline) m.vertices.push_back({p.x, p.y, z});
  }
  for (std::uint32_t i = 0; i < 6; ++i) {
    const std::uint32_t k = (i + 1) % 6;
    m.triangles.push_back({i, k, k + 6});
    m.triangles.push_back({i, k + 6, i + 6});
  }
  const std::vector<std::array<std::uint32_t, 3>> caps = {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 5}};
  for (const auto& t : caps) {
    m.triangles.push_back({t[0] + 6, t[1] + 6, t[2] + 6});
    m.triangles.push_back({t[0], t[2], t[1]});
  }
  return m;
}

TEST(MeshCorners, AnLHasOneWithItsDirectionAngleAndHeights) {
  const auto corners = sharp_corners(l_shape(), false);
  ASSERT_EQ(corners.size(), 1U);
  const MeshCorner& c = corners.front();
  EXPECT_NEAR(norm(c.at - Vec2{2, 2}), 0.0, 1e-12);
  EXPECT_NEAR(c.into.x, std::sqrt(0.5), 1e-12);
  EXPECT_NEAR(c.into.y, std::sqrt(0.5), 1e-12);
  EXPECT_NEAR(c.half_rad, 0.25 * std::numbers::pi, 1e-12);
  EXPECT_EQ(c.low, 0.0);
  EXPECT_EQ(c.high, 3.0);
}

TEST(MeshCorners, KeepWhatLiesBetweenTheWallsAndAMillThatTouchesBoth) {
  const MeshCorner c = sharp_corners(l_shape(), false).front();
  // A mill of radius 1 stands at (3, 3): it touches the walls at (3, 2) and (2, 3), and comes as near to the
  // corner as 1.414 - 1 mm.
  EXPECT_TRUE(c.keeps({2.1, 2.1}, 1.0, 0.0));
  EXPECT_TRUE(c.keeps({2.29, 2.29}, 1.0, 0.0));
  EXPECT_FALSE(c.keeps({2.30, 2.30}, 1.0, 0.0));
  EXPECT_TRUE(c.keeps({2.9, 2.001}, 1.0, 0.0));
  EXPECT_FALSE(c.keeps({2.9, 2.1}, 1.0, 0.0));
  EXPECT_FALSE(c.keeps({3.1, 2.001}, 1.0, 0.0)) << "past where the mill touches the wall";
  EXPECT_FALSE(c.keeps({1.9, 1.9}, 1.0, 0.0)) << "in the solid";
  EXPECT_FALSE(c.keeps({3.9, 3.9}, 1.0, 0.0)) << "beyond the mill";
}

TEST(MeshCorners, HigherThanAFloorIsWhatStandsAboveIt) {
  // 16 less the notch of 4 mm2; an area turned inside out is the same.
  EXPECT_NEAR(area(higher_than(l_shape(), false, 1.0)), 12.0, 1e-6);
  EXPECT_TRUE(higher_than(l_shape(), false, 3.0).empty());
  Mesh turned = l_shape();
  for (auto& t : turned.triangles) std::swap(t[1], t[2]);
  EXPECT_NEAR(area(higher_than(turned, true, 1.0)), 12.0, 1e-6);
  EXPECT_EQ(sharp_corners(turned, true).size(), 1U);
}

}  // namespace
}  // namespace capstan::geometry
