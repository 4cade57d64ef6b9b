#include "planner/making/piece/mesh/surface_form.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace capstan::piece {
namespace {

using geometry::Mesh;
using geometry::Vec3;

constexpr double kSize = 80.0;

/// A sheet of a height field, in so many squares along each side.
template <class F>
Mesh sheet(int n, const F& height) {
  Mesh m;
  for (int j = 0; j <= n; ++j) {
    for (int i = 0; i <= n; ++i) {
      const double x = kSize * i / n, y = kSize * j / n;
      m.vertices.push_back({x, y, height(x, y)});
    }
  }
  const auto at = [&](int i, int j) { return static_cast<std::uint32_t>(j * (n + 1) + i); };
  for (int j = 0; j < n; ++j) {
    for (int i = 0; i < n; ++i) {
      m.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      m.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  }
  return m;
}

/// A gutter of this radius along y, in facets of so many degrees.
Mesh gutter(double radius, double degrees) {
  Mesh m;
  const int n = static_cast<int>(std::round(90.0 / degrees));
  for (int i = -n; i <= n; ++i) {
    const double a = i * degrees / 180.0 * 3.14159265358979;
    for (const double y : {0.0, kSize})
      m.vertices.push_back({radius * std::sin(a), y, -radius * std::cos(a)});
  }
  for (std::uint32_t k = 0; k < static_cast<std::uint32_t>(2 * n); ++k) {
    m.triangles.push_back({2 * k, 2 * k + 2, 2 * k + 1});
    m.triangles.push_back({2 * k + 2, 2 * k + 3, 2 * k + 1});
  }
  return m;
}

TEST(SurfaceRadius, OfAGutterIsItsOwnAndNeverMore) {
  // In a half round a ball that is larger by e leaves sqrt(8 e): none may be.
  for (const double degrees : {1.0, 2.0, 5.0}) {
    const double radius = surface_radius(gutter(4.0, degrees));
    EXPECT_LE(radius, 4.0) << degrees;
    EXPECT_GE(radius, 0.998 * 4.0) << degrees;
  }
}

TEST(SurfaceRadius, IsNotThatOfNeedlesWhoseCoordinatesAreRounded) {
  // Two facets a micrometre wide, as a fan has them in its middle: the last bits of single precision tilt
  // them.
  Mesh m = sheet(4, [](double, double) { return 0.0; });
  EXPECT_EQ(surface_radius(m), 0.0);
  const auto first = static_cast<std::uint32_t>(m.vertices.size());
  const double wide = 1e-6, off = 5e-8;
  for (const Vec3& v : {Vec3{0, 0, off}, Vec3{10, 0, off}, Vec3{0, wide, 0}, Vec3{10, wide, 0},
                        Vec3{0, 2 * wide, off}, Vec3{10, 2 * wide, off}})
    m.vertices.push_back(v);
  for (const auto& t : {std::array<std::uint32_t, 3>{0, 1, 3}, {0, 3, 2}, {2, 3, 5}, {2, 5, 4}})
    m.triangles.push_back({first + t[0], first + t[1], first + t[2]});
  EXPECT_EQ(surface_radius(m), 0.0);
}

TEST(SurfaceRadius, InACreaseThatStatesNoneIsWhatMayStayInAnUnstatedCorner) {
  // Valleys in facets of 2 mm: of 90 degrees, and of 15, in which a ball of 3 mm leaves 0.026 mm.
  for (const double lean : {45.0, 7.5}) {
    const double slope = std::tan(lean / 180.0 * 3.14159265358979);
    const Mesh m = sheet(40, [&](double x, double) { return slope * std::abs(x - 0.5 * kSize); });
    const double deep = 0.5 * kSize * slope;
    EXPECT_DOUBLE_EQ(surface_radius(m), std::max(3.0, deep / 6.0)) << lean;
  }
}

TEST(LowestSeen, IsThatOfWhatFacesUpWhereverThePartIsDrawn) {
  // A dish in a block that goes 30 mm deeper.
  Mesh m = sheet(20, [](double x, double y) {
    return 100.0 + 0.01 * ((x - 0.5 * kSize) * (x - 0.5 * kSize) + (y - 0.5 * kSize) * (y - 0.5 * kSize));
  });
  EXPECT_EQ(lowest_seen_mm(m, {}), 100.0);
  const auto n = static_cast<std::uint32_t>(m.vertices.size());
  for (const Vec3 v : {Vec3{0, 0, 70}, Vec3{kSize, 0, 70}, Vec3{kSize, kSize, 70}, Vec3{0, kSize, 70}})
    m.vertices.push_back(v);
  m.triangles.push_back({n, n + 2, n + 1});
  m.triangles.push_back({n, n + 3, n + 2});
  EXPECT_EQ(lowest_seen_mm(m, {}), 100.0);
  for (auto& t : m.triangles) std::swap(t[1], t[2]);  // inside out
  EXPECT_EQ(lowest_seen_mm(m, {}), 100.0);
}

}  // namespace
}  // namespace capstan::piece
