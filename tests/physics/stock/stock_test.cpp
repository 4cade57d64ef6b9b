#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "planner/physics/stock/coverage.h"
#include "planner/physics/stock/height_map.h"
#include "planner/physics/stock/sweep.h"
#include "tests/support/paths/outlines.h"

namespace capstan::stock {
namespace {

using geometry::Box3;
using geometry::Vec2;
using geometry::Vec3;

TEST(Coverage, EqualsAFineCountOfPoints) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> u(-1.0, 1.0);
  for (int k = 0; k < 200; ++k) {
    const double angle = std::numbers::pi * u(random);
    const Vec2 n{std::cos(angle), std::sin(angle)};
    const double inside = u(random);
    int hits = 0;
    const int m = 200;
    for (int i = 0; i < m; ++i) {
      for (int j = 0; j < m; ++j) {
        hits += dot(Vec2{(i + 0.5) / m - 0.5, (j + 0.5) / m - 0.5}, n) < inside;
      }
    }
    EXPECT_NEAR(coverage(inside, n, 1.0), static_cast<double>(hits) / (m * m), 0.006);
  }
}

TEST(Block, HoldsItsVolumeWhateverTheCell) {
  for (const double cell : {0.1, 0.37, 1.0, 3.0}) {
    const HeightMap map = from_box({{-3.0, 2.0, -12.5}, {47.3, 31.9, 0.0}}, cell);
    EXPECT_NEAR(volume(map), 50.3 * 29.9 * 12.5, 1e-3 * 50.3 * 29.9 * 12.5 * 1e-2) << cell;
  }
}

TEST(Cylinder, HoldsItsVolume) {
  const HeightMap map = from_cylinder({{0.0, 0.0, 0.0}, {60.0, 60.0, 20.0}}, 25.0, 0.5);
  const double expected = std::numbers::pi * 625.0 * 20.0;
  EXPECT_NEAR(volume(map), expected, 1e-3 * expected);
}

TEST(MeshStock, TakesTheUpperSurface) {
  geometry::Mesh mesh;
  mesh.vertices = {{0, 0, 1}, {10, 0, 1}, {10, 10, 3}, {0, 10, 3}, {0, 0, -5}, {10, 0, -5}, {10, 10, -5}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}, {4, 6, 5}};
  const HeightMap map = from_mesh(mesh, -5.0, 0.25);
  EXPECT_NEAR(volume(map), 100.0 * 7.0, 0.5);
  EXPECT_NEAR(height_at(map, {5.0, 5.0}), 2.0, 0.03);
}

TEST(MaxHeight, SeesOnlyWhatTheDiscCovers) {
  HeightMap map = from_box({{0, 0, 0}, {20, 20, 5}}, 0.5);
  EXPECT_EQ(max_height(map, {-6.0, 10.0}, 5.0), 0.0);
  EXPECT_EQ(max_height(map, {-4.9, 10.0}, 5.0), 5.0);
  EXPECT_EQ(max_height(map, {-50.0, 10.0}, {70.0, 10.0}, 1.0), 5.0);
  EXPECT_EQ(max_height(map, {-50.0, -3.0}, {70.0, -3.0}, 2.0), 0.0);
}

/// Least of z(t) + profile(distance) over a dense row of stamps.
double stamped(const geometry::CutterProfile& profile, double along, double across, double length,
               double rise) {
  double best = 1e300;
  for (int k = 0; k <= 20000; ++k) {
    const double t = k / 20000.0;
    best = std::min(best, t * rise + profile.height(std::hypot(along - t * length, across)));
  }
  return best;
}

TEST(SweptHeight, IsTheEnvelopeOfDenseStamps) {
  const geometry::CutterProfile profiles[] = {geometry::flat_profile(10.0, 20.0),
                                              geometry::ball_profile(10.0, 20.0),
                                              geometry::bull_profile(10.0, 1.5, 20.0),
                                              geometry::cone_profile(10.0, 2.0, 20.0),
                                              geometry::cone_profile(10.0, 1.5, 20.0, 3.0),
                                              test::lens(),
                                              test::barrel(),
                                              test::tapered_ball()};
  std::mt19937 random(11);
  std::uniform_real_distribution<double> u(0.0, 1.0);
  for (const auto& profile : profiles) {
    for (int k = 0; k < 60; ++k) {
      const double length = 0.2 + 8.0 * u(random);
      const double rise = 6.0 * (u(random) - 0.5);
      const double along = -5.0 + (length + 10.0) * u(random);
      const double across = -4.9 + 9.8 * u(random);
      const double dense = stamped(profile, along, across, length, rise);
      const double exact = swept_height(profile, along, across, length, rise);
      if (dense > 1e200) continue;
      EXPECT_LE(exact, dense + 1e-9);
      EXPECT_GE(exact, dense - 0.03) << "a rim's step between two stamps";
    }
  }
}

TEST(Sweep, ASlopeLeavesItsEnvelope) {
  std::mt19937 random(12);
  std::uniform_real_distribution<double> u(0.0, 1.0);
  for (const auto& profile :
       {geometry::flat_profile(6.0, 20.0), geometry::ball_profile(6.0, 20.0),
        geometry::bull_profile(6.0, 1.0, 20.0), geometry::bull_profile(6.0, 0.1, 20.0),
        geometry::cone_profile(6.0, 2.0, 20.0), geometry::cone_profile(6.0, 1.5, 20.0, 2.0), test::lens(),
        test::barrel(), test::tapered_ball()}) {
    for (int k = 0; k < 20; ++k) {
      HeightMap map = from_box({{0, 0, 0}, {20, 20, 20}}, 0.25);
      const double turned = 6.283 * u(random), length = 0.2 + 4.0 * u(random), rise = 4.0 * (u(random) - 0.5);
      const Vec3 from{10.0, 10.0, 12.0};
      const Vec2 unit{std::cos(turned), std::sin(turned)};
      const Vec3 to{10.0 + length * unit.x, 10.0 + length * unit.y, 12.0 + rise};
      Tally tally;
      sweep(map, profile, {.from = from, .to = to, .arc = false, .centre = {}, .clockwise = false}, false,
            unit, tally);
      for (int iy = 0; iy < map.ny; ++iy) {
        for (int ix = 0; ix < map.nx; ++ix) {
          const Vec2 p = Vec2{map.x_of(ix), map.y_of(iy)} - xy(from);
          const double along = dot(p, unit), across = cross(unit, p);
          const double past = along - std::clamp(along, 0.0, length);
          if (std::hypot(past, across) > profile.radius_mm - 0.2) continue;  // the rim covers a part of a cell
          const double z = std::min(20.0, 12.0 + swept_height(profile, along, across, length, rise));
          ASSERT_NEAR(height_at(map, {map.x_of(ix), map.y_of(iy)}), z, 2e-5);
        }
      }
    }
  }
}

TEST(Cut, AFullTurnLeavesTheIslandAlone) {
  HeightMap map = from_box({{0, 0, 0}, {60, 60, 10}}, 0.2);
  model::CutterPath p;
  p.start({45.0, 30.0, 6.0});
  p.arc({45.0, 30.0, 6.0}, {30.0, 30.0}, true, model::MoveRole::kCut);
  const double removed = cut(map, geometry::flat_profile(10.0, 20.0), p);
  const double ring = 4.0 * std::numbers::pi * (400.0 - 100.0);
  EXPECT_NEAR(removed, ring, 1e-3 * ring);
  EXPECT_EQ(height_at(map, {30.0, 30.0}), 10.0);
  EXPECT_EQ(height_at(map, {15.0, 30.0}), 6.0);
}

TEST(Cut, AHelixGoesDownEverywhereItPasses) {
  HeightMap map = from_box({{0, 0, 0}, {60, 60, 10}}, 0.2);
  model::CutterPath p;
  p.start({38.0, 30.0, 10.0});
  p.arc({38.0, 30.0, 8.0}, {30.0, 30.0}, false, model::MoveRole::kRamp);
  p.arc({38.0, 30.0, 8.0}, {30.0, 30.0}, false, model::MoveRole::kCut);
  const double removed = cut(map, geometry::flat_profile(10.0, 20.0), p);
  const double ring = 2.0 * std::numbers::pi * (169.0 - 9.0);
  EXPECT_NEAR(removed, ring, 1e-3 * ring);
}

}  // namespace
}  // namespace capstan::stock
