#include "planner/ground/geometry/mesh/mesh_creases.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

namespace capstan::geometry {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

/// A sheet of this profile in x and z, 20 mm along y, in strips so wide along y.
Mesh sheet(const std::vector<Vec2>& profile, double strip_mm) {
  Mesh m;
  const int strips = static_cast<int>(std::round(20.0 / strip_mm));
  for (int j = 0; j <= strips; ++j) {
    for (const Vec2 p : profile) m.vertices.push_back({p.x, j * strip_mm, p.y});
  }
  const auto n = static_cast<std::uint32_t>(profile.size());
  for (std::uint32_t j = 0; j < static_cast<std::uint32_t>(strips); ++j) {
    for (std::uint32_t i = 0; i + 1 < n; ++i) {
      const std::uint32_t a = j * n + i;
      m.triangles.push_back({a, a + 1, a + n + 1});
      m.triangles.push_back({a, a + n + 1, a + n});
    }
  }
  return m;
}

/// A valley whose sides lean as much as this, drawn in facets a millimetre wide.
std::vector<Vec2> valley(double lean_rad) {
  std::vector<Vec2> out;
  for (int i = -10; i <= 10; ++i) out.push_back({1.0 * i, std::abs(1.0 * i) * std::tan(lean_rad)});
  return out;
}

/// A gutter of radius 4 between the angles of -60 and 60 degrees, in facets of ten.
std::vector<Vec2> gutter() {
  std::vector<Vec2> out;
  for (int i = -6; i <= 6; ++i)
    out.push_back({4.0 * std::sin(10.0 * i * kDegree), -4.0 * std::cos(10.0 * i * kDegree)});
  return out;
}

TEST(Creases, OfAValleyAreItsBottomAndDrawNoCurveHoweverNarrowTheFacets) {
  for (const double lean : {7.5, 30.0}) {
    const auto found = creases(sheet(valley(lean * kDegree), 1.0));
    ASSERT_EQ(found.size(), 20U) << lean;  // one for each strip
    for (const MeshCrease& c : found) {
      EXPECT_NEAR(c.turn_rad, 2.0 * lean * kDegree, 1e-9);
      EXPECT_NEAR(c.across_mm, 1.0 / std::cos(lean * kDegree), 1e-9);
      EXPECT_TRUE(c.alone);
      EXPECT_TRUE(std::isinf(c.curve_mm()));
    }
  }
}

TEST(Creases, OfAGutterDrawItsRadius) {
  const auto found = creases(sheet(gutter(), 2.0));
  ASSERT_EQ(found.size(), 11U * 10U);
  for (const MeshCrease& c : found) {
    EXPECT_FALSE(c.alone);
    // A chord of ten degrees over its turn: 2 sin(5 degrees) / 10 degrees of the radius.
    EXPECT_NEAR(c.curve_mm(), 4.0 * 2.0 * std::sin(5.0 * kDegree) / (10.0 * kDegree), 1e-9);
  }
}

TEST(Creases, OfARidgeAreNone) {
  auto ridge = valley(30.0 * kDegree);
  for (Vec2& p : ridge) p.y = -p.y;
  EXPECT_TRUE(creases(sheet(ridge, 1.0)).empty());
}

/// A block of 20 x 20 with an upright wall at x = 10: beside it the floor rises to the wall by so much.
Mesh step(double rise) {
  const std::vector<Vec2> profile = {{0, 0}, {20, 0}, {20, 12}, {10, 12}, {10, 5 + rise}, {0, 5}};
  Mesh m;
  for (const double y : {0.0, 20.0}) {
    for (const Vec2 p : profile) m.vertices.push_back({p.x, y, p.y});
  }
  for (std::uint32_t i = 0; i < 6; ++i) {
    const std::uint32_t k = (i + 1) % 6;
    m.triangles.push_back({i, k + 6, k});
    m.triangles.push_back({i, i + 6, k + 6});
  }
  // Its ends, from the corner at the wall's foot.
  for (const std::uint32_t i : {5U, 0U, 1U, 2U}) {
    m.triangles.push_back({4, i, (i + 1) % 6});
    m.triangles.push_back({10, (i + 1) % 6 + 6, i + 6});
  }
  return m;
}

TEST(Creases, AtTheFootOfAWallAreNoneWhereTheFloorIsLevel) {
  EXPECT_TRUE(creases(step(0.0)).empty());
  const auto found = creases(step(1.0));
  ASSERT_EQ(found.size(), 1U);
  EXPECT_NEAR(found.front().turn_rad, 0.5 * std::numbers::pi - std::atan(0.1), 1e-9);
  EXPECT_DOUBLE_EQ(found.front().a.x, 10.0);
  EXPECT_DOUBLE_EQ(found.front().a.z, 6.0);
}

}  // namespace
}  // namespace capstan::geometry
