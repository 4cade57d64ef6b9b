#include "planner/ground/geometry/mesh/turned_alike.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "planner/ground/geometry/mesh/mesh_form.h"

namespace capstan::geometry {
namespace {

/// A sheet of n x n squares of 1 mm, z = 0.1 x y, facing up; each triangle has vertices of its own.
Mesh loose_sheet(int n) {
  Mesh m;
  const auto at = [](int x, int y) { return Vec3{double(x), double(y), 0.1 * x * y}; };
  const auto add = [&](Vec3 a, Vec3 b, Vec3 c) {
    const auto i = static_cast<std::uint32_t>(m.vertices.size());
    m.vertices.insert(m.vertices.end(), {a, b, c});
    m.triangles.push_back({i, i + 1, i + 2});
  };
  for (int y = 0; y < n; ++y) {
    for (int x = 0; x < n; ++x) {
      add(at(x, y), at(x + 1, y), at(x + 1, y + 1));
      add(at(x, y), at(x + 1, y + 1), at(x, y + 1));
    }
  }
  return m;
}

TEST(TurnedAlike, FindsEveryTriangleThatWasTurnedWhileTheyAreTheSmallerPart) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    const Mesh asked = loose_sheet(8);  // 128 triangles
    Mesh m = asked;
    std::mt19937 random(seed);
    std::size_t turned = 0;
    for (auto& t : m.triangles) {
      if (random() % 5 != 0 || turned == 40) continue;
      std::swap(t[1], t[2]);
      ++turned;
    }
    const TurnedAlike out = turned_alike(std::move(m));
    EXPECT_EQ(out.turned, turned) << seed;
    EXPECT_EQ(out.mesh.triangles, asked.triangles) << seed;
    EXPECT_EQ(form_of(out.mesh).turned_edges, 0U);
  }
}

TEST(TurnedAlike, LooksOverTrianglesWhoseCornersAreOne) {
  Mesh m = loose_sheet(4);
  std::swap(m.triangles[9][1], m.triangles[9][2]);
  // Beside its first edge a sliver whose corners weld to the edge's ends.
  const Vec3 a = m.vertices[m.triangles[9][0]], b = m.vertices[m.triangles[9][1]];
  const auto i = static_cast<std::uint32_t>(m.vertices.size());
  m.vertices.insert(m.vertices.end(), {a, b, b + Vec3{0.0, 0.0, 0.5 * kWeldMm}});
  m.triangles.push_back({i, i + 1, i + 2});
  EXPECT_EQ(turned_alike(std::move(m)).turned, 1U);
}

TEST(TurnedAlike, TellsTheMiddleOfTheFirst) {
  Mesh m = loose_sheet(3);
  std::swap(m.triangles[2][1], m.triangles[2][2]);  // (1, 0), (2, 0), (2, 1)
  const TurnedAlike out = turned_alike(std::move(m));
  EXPECT_EQ(out.turned, 1U);
  EXPECT_NEAR(out.first.x, 5.0 / 3.0, 1e-12);
  EXPECT_NEAR(out.first.y, 1.0 / 3.0, 1e-12);
}

TEST(TurnedAlike, LeavesAMeshThatIsAlikeAndAStripWithoutTwoSidesAsTheyAre) {
  const Mesh sheet = loose_sheet(4);
  EXPECT_EQ(turned_alike(sheet).turned, 0U);
  Mesh strip;  // a Moebius strip of 12 squares
  constexpr std::uint32_t kSquares = 12;
  for (std::uint32_t i = 0; i < kSquares; ++i) {
    const double a = 2.0 * std::numbers::pi * i / kSquares, half = 0.5 * a;
    for (const double r : {-2.0, 2.0}) {
      const double out = 10.0 + r * std::cos(half);
      strip.vertices.push_back({out * std::cos(a), out * std::sin(a), r * std::sin(half)});
    }
  }
  for (std::uint32_t i = 0; i < kSquares; ++i) {
    const bool last = i + 1 == kSquares;
    const std::uint32_t a = 2 * i, b = a + 1, c = last ? 1 : a + 2, d = last ? 0 : a + 3;
    strip.triangles.push_back({a, c, d});
    strip.triangles.push_back({a, d, b});
  }
  EXPECT_EQ(turned_alike(strip).turned, 0U);
}

}  // namespace
}  // namespace capstan::geometry
