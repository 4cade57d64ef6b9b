#include "planner/making/piece/mesh/thin_places.h"

#include <gtest/gtest.h>

#include <cmath>
#include <initializer_list>
#include <numbers>
#include <utility>

#include "planner/ground/geometry/region.h"

namespace capstan::piece {
namespace {

using geometry::Vec2;
using geometry::Vec3;

constexpr double kLong = 60.0, kWide = 50.0, kDeep = 20.0;
const geometry::Box3 kRaw{{0, 0, -kDeep}, {kLong, kWide, 0}};

/// Rings of four corners, joined from the first to the last, both closed.
geometry::Mesh of_rings(std::initializer_list<std::pair<geometry::Box2, double>> rings) {
  geometry::Mesh m;
  for (const auto& [b, z] : rings) {
    for (const Vec2 p : {b.lo, Vec2{b.hi.x, b.lo.y}, b.hi, Vec2{b.lo.x, b.hi.y}})
      m.vertices.push_back({p.x, p.y, z});
  }
  m.triangles = {{0, 2, 1}, {0, 3, 2}};
  const auto last = static_cast<std::uint32_t>(m.vertices.size()) - 4;
  for (std::uint32_t r = 0; r < last; r += 4) {
    for (std::uint32_t k = 0; k < 4; ++k) {
      const std::uint32_t a = r + k, b = r + (k + 1) % 4;
      m.triangles.push_back({a, b, b + 4});
      m.triangles.push_back({a, b + 4, a + 4});
    }
  }
  m.triangles.push_back({last, last + 1, last + 2});
  m.triangles.push_back({last, last + 2, last + 3});
  return m;
}
geometry::Box2 middle(double along, double across) {
  const Vec2 c{0.5 * kLong, 0.5 * kWide};
  return {{c.x - 0.5 * along, c.y - 0.5 * across}, {c.x + 0.5 * along, c.y + 0.5 * across}};
}
const geometry::Box2 kAll{{0, 0}, {kLong, kWide}};

/// A rib on a base, as thick at its head and at its foot as this.
geometry::Mesh rib(double head_mm, double foot_mm, double high_mm) {
  return of_rings(
      {{kAll, -kDeep}, {kAll, -high_mm}, {middle(40, foot_mm), -high_mm}, {middle(40, head_mm), 0}});
}
geometry::Mesh pocket(double floor_mm) {
  return of_rings({{kAll, -kDeep}, {kAll, 0}, {middle(40, 30), 0}, {middle(40, 30), floor_mm - kDeep}});
}

TEST(ThinPlaces, ARibHasItsThicknessAndItsHeight) {
  const ThinPlaces found = thin_places(rib(0.4, 0.4, 18.0), kRaw);
  ASSERT_TRUE(found.wall);
  EXPECT_NEAR(found.wall->thickness_mm, 0.4, 1e-6);
  EXPECT_NEAR(found.wall->extent_mm, 18.0, 0.01 * 18.0);
  EXPECT_NEAR(found.wall->at.y, 0.5 * kWide, 1e-6);
}

TEST(ThinPlaces, ARibThatLeansIsAsThickAsAtTheFootOfItsHeight) {
  const ThinPlaces found = thin_places(rib(1.0, 2.0, 15.0), kRaw);
  ASSERT_TRUE(found.wall);
  EXPECT_NEAR(found.wall->ratio(), 15.0 / 2.0, 0.02 * 15.0 / 2.0);
}

TEST(ThinPlaces, ASheetsRibIsThinToo) {
  geometry::Mesh m = rib(0.4, 0.4, 18.0);
  m.triangles.erase(m.triangles.begin(), m.triangles.begin() + 10);  // underside and sides
  const ThinPlaces found = thin_places(m, kRaw);
  ASSERT_TRUE(found.wall);
  EXPECT_NEAR(found.wall->thickness_mm, 0.4, 1e-6);
}

TEST(ThinPlaces, AStoutRibAndThePartsOwnSidesAreNone) {
  EXPECT_FALSE(thin_places(rib(4.0, 4.0, 15.0), kRaw).wall);
  EXPECT_FALSE(thin_places(pocket(8.0), kRaw).wall);
}

// The part seen from above is a triangle of 60 degrees: thin at its edges, which the thick middle holds.
TEST(ThinPlaces, ASharpEdgeOfAThickBlockIsNone) {
  const double half = 30.0 * std::tan(std::numbers::pi / 6.0);
  geometry::Mesh m;
  for (const double z : {-kDeep, 0.0}) {
    for (const Vec2 p : {Vec2{0, 0}, Vec2{30, -half}, Vec2{30, half}}) m.vertices.push_back({p.x, p.y, z});
  }
  m.triangles = {{0, 2, 1}, {3, 4, 5}};
  for (std::uint32_t k = 0; k < 3; ++k) {
    m.triangles.push_back({k, (k + 1) % 3, (k + 1) % 3 + 3});
    m.triangles.push_back({k, (k + 1) % 3 + 3, k + 3});
  }
  EXPECT_FALSE(thin_places(m, geometry::bounds(m)).wall);
}

TEST(ThinPlaces, AFloorHasTheCircleBetweenItsWalls) {
  const ThinPlaces found = thin_places(pocket(0.3), kRaw);
  ASSERT_TRUE(found.floor);
  EXPECT_NEAR(found.floor->thickness_mm, 0.3, 1e-6);
  EXPECT_NEAR(found.floor->extent_mm, 30.0, 4 * 0.3);  // cells of 60 / 200 mm, two on either side
  EXPECT_FALSE(thin_places(pocket(3.5), kRaw).floor);
}

// As thick before as after: 4 of 6 mm stay.
TEST(ThinPlaces, APlateThatWasThinBeforeIsNone) {
  const geometry::Mesh m = of_rings({{kAll, -6}, {kAll, 0}, {middle(58, 48), 0}, {middle(58, 48), -2}});
  EXPECT_FALSE(thin_places(m, {{0, 0, -6}, {kLong, kWide, 0}}).floor);
}

TEST(ThinPlaces, AreFoundInAMeshThatIsInsideOut) {
  geometry::Mesh m = rib(0.4, 0.4, 18.0);
  for (auto& t : m.triangles) std::swap(t[1], t[2]);
  EXPECT_TRUE(thin_places(m, kRaw).wall);
}

}  // namespace
}  // namespace capstan::piece
