#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "planner/ground/geometry/region.h"
#include "planner/making/toolpath/freeform/freeform.h"
#include "planner/making/toolpath/freeform/rough/level_contour.h"
#include "planner/making/toolpath/freeform/rough/levels.h"
#include "planner/making/toolpath/path_job.h"
#include "planner/physics/stock/sweep.h"

namespace capstan::toolpath::freeform {
namespace {

using geometry::Mesh;
using model::MoveRole;

constexpr double kSize = 48.0;

template <class F>
Mesh surface(const F& f) {
  constexpr int kN = 48;
  Mesh m;
  for (int j = 0; j <= kN; ++j) {
    for (int i = 0; i <= kN; ++i)
      m.vertices.push_back({kSize * i / kN, kSize * j / kN, f(kSize * i / kN, kSize * j / kN)});
  }
  const auto at = [](int i, int j) { return static_cast<std::uint32_t>(j * (kN + 1) + i); };
  for (int j = 0; j < kN; ++j) {
    for (int i = 0; i < kN; ++i) {
      m.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      m.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  }
  return m;
}

/// A bump: round on top, up to 38 degrees steep, level around; no place where a cutter does not reach.
double bump(double x, double y) {
  return -10.0 + 9.0 * std::exp(-((x - 24.0) * (x - 24.0) + (y - 24.0) * (y - 24.0)) / 100.0);
}
/// Hills and pits of 4 mm, 39 mm apart.
double waves(double x, double y) { return -6.0 + 4.0 * std::sin(0.16 * x) * std::cos(0.16 * y); }

model::Cutter bull(double diameter, double corner) {
  model::Cutter c;
  c.id = "t";
  c.cutter_class = model::CutterClass::kBullnoseEndmill;
  c.cutting_diameter_mm = diameter;
  c.corner_radius_mm = corner;
  c.maximum_depth_of_cut_mm = 40.0;
  c.maximum_ramp_angle_rad = 3.0 * std::numbers::pi / 180.0;
  return c;
}

FreeformJob job_on(const Mesh& mesh, const model::Cutter& c, double top) {
  FreeformJob task;
  task.surface = &mesh;
  task.cutter = c;
  task.top_z_mm = top;
  task.security_z_mm = 10.0;
  task.bottom_z_mm = -20.0;
  task.allowance_mm = 0.5;
  task.axial_depth_mm = 4.0;
  task.stepover_mm = 0.65 * c.cutting_diameter_mm;
  return task;
}

stock::HeightMap block(double top) { return stock::from_box({{0, 0, -20}, {kSize, kSize, top}}, 0.1); }

/// What stands over a surface after a path, square to it, at all places off the rim, from the least.
template <class F>
std::vector<double> standing(const F& f, const FreeformJob& task, const model::CutterPath& path) {
  auto map = block(task.top_z_mm);
  stock::cut(map, model::profile_of(task.cutter), path);
  std::vector<double> out;
  constexpr double kStep = 1e-4;
  for (double x = 1.03; x < kSize - 1.0; x += 0.5) {
    for (double y = 1.03; y < kSize - 1.0; y += 0.5) {
      const double dx = (f(x + kStep, y) - f(x, y)) / kStep, dy = (f(x, y + kStep) - f(x, y)) / kStep;
      out.push_back((stock::height_at(map, {x, y}) - f(x, y)) / std::sqrt(1.0 + dx * dx + dy * dy));
    }
  }
  std::sort(out.begin(), out.end());
  return out;
}

TEST(Rough, LeavesTerracesNoHigherThanItIsAsked) {
  const Mesh mesh = surface(bump);
  for (const auto& [d, corner] : {std::pair{10.0, 1.0}, {10.0, 3.0}}) {
    FreeformJob task = job_on(mesh, bull(d, corner), 0.0);
    Job job;
    const auto coarse = rough(task, job);
    task.terrace_mm = 0.5;
    const auto even = rough(task, job);
    ASSERT_TRUE(coarse && even);
    const auto before = standing(bump, task, coarse->path), after = standing(bump, task, even->path);
    // The margin is a tenth of the allowance; a cell's middle stands for all of it: half a cell, 0.05 mm, on
    // 38 degrees; facets of a millimetre lie (1/8) 0.2/mm 1 mm2 = 0.02 mm off the bump.
    const double most = task.allowance_mm + task.terrace_mm + 0.05 + 0.05 + 0.02;
    EXPECT_GT(before.back(), 2.0 * most) << "what levels of 4 mm leave";
    EXPECT_LE(after.back(), most) << corner;
    EXPECT_GE(after.front(), task.allowance_mm - 0.05 - 0.02) << corner;
    EXPECT_GT(even->levels_z_mm.size(), coarse->levels_z_mm.size());
  }
}

TEST(Rough, GoesDownIntoEveryPit) {
  // The only level of 8 mm was the height of the lowest place that the mill can be let down to.
  const Mesh mesh = surface(waves);
  FreeformJob task = job_on(mesh, bull(12.0, 3.0), -2.0);
  task.axial_depth_mm = 8.0;
  task.terrace_mm = 0.5;
  auto map = block(-2.0);
  task.stock = &map;
  Job job;
  const auto out = rough(task, job);
  ASSERT_TRUE(out) << out.error().message;
  const auto target = stock::from_mesh(mesh, -20.0, 0.1);
  const double whole = stock::volume(map) - stock::volume(target);
  auto cut = map;
  double plunged = 0.0;
  const auto profile = model::profile_of(task.cutter);
  for (std::size_t i = 1; i < out->path.size(); ++i) {
    const double removed = stock::cut(cut, profile, out->path, i);
    EXPECT_TRUE(out->path.kind[i] != model::MoveKind::kRapid || removed == 0.0) << i;
    if (out->path.role[i] == MoveRole::kPlunge || out->path.role[i] == MoveRole::kApproach)
      plunged += removed;
    EXPECT_TRUE(out->path.role[i] != MoveRole::kLink || removed < 0.01) << i;
  }
  const double left = stock::volume(cut) - stock::volume(target);
  std::printf("[ figures  ] pits: %.1f %% of %.0f mm3 taken, %.2f mm3 straight down\n",
              100.0 * (1.0 - left / whole), whole, plunged);
  // The allowance is 0.5 of some 4 mm, terraces and the margin as much at most, half of it on the whole.
  EXPECT_GT(1.0 - left / whole, 1.0 - (0.5 + 0.05 + 0.25) / 4.0 - 0.03);
  EXPECT_LT(plunged, 0.001 * whole) << "it comes in from the side, or on a ramp";
}

/// Up to so much over the surface, told vertically, may stay.
stock::HeightMap up_to(const Mesh& mesh, double over_mm, const stock::HeightMap& cells) {
  stock::HeightMap out = stock::from_mesh(mesh, cells.origin.z, cells);
  for (std::size_t i = 0; i < out.cells(); ++i) out.top[i] += static_cast<float>(over_mm);
  return out;
}

// A mill of 20 mm leaves the pits. A ball of 10 mm roughs these and nothing else: it cut the whole surface
// again before, for it meets terraces everywhere.
TEST(Rough, OfARestCutsOnlyWhereMoreStandsThanMayStay) {
  const Mesh mesh = surface(waves);
  FreeformJob first = job_on(mesh, bull(20.0, 4.0), -2.0);
  first.terrace_mm = 0.7;
  auto map = block(-2.0);
  Job job;
  const auto coarse = rough(first, job);
  ASSERT_TRUE(coarse) << coarse.error().message;
  stock::cut(map, model::profile_of(first.cutter), coarse->path);
  // What may stay square to the surface, 1.2 mm, on the steepest of its slopes, 4 mm 0.16/mm = 33 degrees.
  const double most = 1.2 / std::cos(std::atan(4.0 * 0.16));
  const auto may_stay = up_to(mesh, most, map);
  const auto rest_of = [&](const stock::HeightMap& m) {
    double mm3 = 0.0;
    for (std::size_t i = 0; i < m.cells(); ++i)
      mm3 += std::max(0.0, static_cast<double>(m.at(i).mean() - may_stay.top[i])) * m.cell_mm * m.cell_mm;
    return mm3;
  };
  FreeformJob second = job_on(mesh, bull(10.0, 5.0), -2.0);
  second.terrace_mm = 0.7;
  second.stepover_mm = 3.5;
  second.stock = &map;
  second.may_stay = &may_stay;
  const auto fine = rough(second, job);
  ASSERT_TRUE(fine) << fine.error().message;
  auto after = map;
  const auto profile = model::profile_of(second.cutter);
  double air_mm = 0.0, cut_mm = 0.0;
  const model::CutterPath& path = fine->path;
  for (std::size_t i = 1; i < path.size(); ++i) {
    // A piece of 2 cells at a time: of a long move the whole may lie in air but for its end.
    const auto from = path.point(i - 1), to = path.point(i);
    const int n = std::max(1, static_cast<int>(norm(to - from) / 0.2));
    for (int k = 1; k <= n; ++k) {
      model::CutterPath piece;
      piece.start(from + (static_cast<double>(k - 1) / n) * (to - from));
      piece.line(from + (static_cast<double>(k) / n) * (to - from), path.role[i]);
      const double removed = stock::cut(after, profile, piece, 1);
      EXPECT_TRUE(path.kind[i] != model::MoveKind::kRapid || removed == 0.0) << i;
      if (path.role[i] == MoveRole::kCut) (removed > 0.0 ? cut_mm : air_mm) += norm(to - from) / n;
    }
  }
  const double before = rest_of(map), left = rest_of(after);
  std::printf("[ figures  ] rest: %.0f mm3 before, %.1f after; %.0f mm cut, %.0f mm of it in air\n", before,
              left, cut_mm + air_mm, air_mm);
  ASSERT_GT(before, 50.0);
  EXPECT_LT(left, 0.1 * before);
  EXPECT_LT(air_mm, 0.1 * (air_mm + cut_mm));
  // Nothing is touched farther from a rest than the axis goes beside it and the cutter reaches from there:
  // a radius each, half a radius of a block of that area, and the run-in of a pass.
  const double reach = 3.0 * 5.0;
  for (int iy = 0; iy < map.ny; iy += 4) {
    for (int ix = 0; ix < map.nx; ix += 4) {
      if (!(after.at(ix, iy).top_mm < map.at(ix, iy).top_mm - 1e-3F)) continue;
      const int n = static_cast<int>(reach / map.cell_mm);
      bool near = false;
      for (int y = std::max(0, iy - n); y <= std::min(map.ny - 1, iy + n) && !near; ++y) {
        for (int x = std::max(0, ix - n); x <= std::min(map.nx - 1, ix + n) && !near; ++x)
          near = map.at(x, y).mean() > may_stay.at(x, y).top_mm;
      }
      EXPECT_TRUE(near) << map.x_of(ix) << ' ' << map.y_of(iy);
    }
  }
  // Where nothing stands too high there is nothing to rough.
  second.stock = &after;
  const auto high = up_to(mesh, 10.0, map);
  second.may_stay = &high;
  const auto none = rough(second, job);
  ASSERT_FALSE(none);
  EXPECT_EQ(none.error().code, kNothingToCut);
  // Heights of other cells tell nothing.
  const auto coarser = stock::from_mesh(mesh, map.origin.z, 2.0 * map.cell_mm);
  second.may_stay = &coarser;
  const auto other = rough(second, job);
  ASSERT_FALSE(other);
  EXPECT_EQ(other.error().code, "FRF-VALUE");
  auto aside = high;  // as many cells, elsewhere
  aside.origin.x += map.cell_mm;
  second.may_stay = &aside;
  const auto moved = rough(second, job);
  ASSERT_FALSE(moved);
  EXPECT_EQ(moved.error().code, "FRF-VALUE");
}

/// A block of 40 x 30 x 12 mm with a pocket of 24 x 14 x 6 mm in its middle, all walls upright.
Mesh block_with_pocket() {
  Mesh m;
  const auto quad = [&](geometry::Vec3 a, geometry::Vec3 b, geometry::Vec3 c, geometry::Vec3 d) {
    const auto n = static_cast<std::uint32_t>(m.vertices.size());
    m.vertices.insert(m.vertices.end(), {a, b, c, d});
    m.triangles.push_back({n, n + 1, n + 2});
    m.triangles.push_back({n, n + 2, n + 3});
  };
  const geometry::Vec2 out[] = {{0, 0}, {40, 0}, {40, 30}, {0, 30}},
                       in[] = {{8, 8}, {32, 8}, {32, 22}, {8, 22}};
  const auto at = [](geometry::Vec2 p, double z) { return geometry::Vec3{p.x, p.y, z}; };
  for (std::size_t i = 0; i < 4; ++i) {
    const std::size_t j = (i + 1) % 4;
    quad(at(out[i], -12), at(out[j], -12), at(out[j], 0), at(out[i], 0));
    quad(at(out[i], 0), at(out[j], 0), at(in[j], 0), at(in[i], 0));
    quad(at(in[i], 0), at(in[j], 0), at(in[j], -6), at(in[i], -6));
  }
  quad(at(in[0], -6), at(in[1], -6), at(in[2], -6), at(in[3], -6));
  quad(at(out[3], -12), at(out[2], -12), at(out[1], -12), at(out[0], -12));
  return m;
}

// The walls around were followed on every level, although the raw piece ends with them: nine tenths of the
// path of a pocket's walls lay in air.
TEST(Rough, OfWallsGoesOnlyWhereTheyAreToLoseSomething) {
  const Mesh mesh = block_with_pocket();
  FreeformJob task = job_on(mesh, bull(6.0, 0.0), 0.0);
  task.cutter.cutter_class = model::CutterClass::kEndmill;
  task.cutter.centre_cutting = true;
  task.allowance_mm = 0.0;
  task.axial_depth_mm = 2.0;
  task.stepover_mm = 3.0;
  task.left_mm = 0.5;
  task.bottom_z_mm = -12.0;
  task.floors_z_mm = {-6.0};
  task.beside_is_free = true;
  task.area = geometry::rectangle({-4, -4}, {44, 34});
  auto map = stock::from_box({{0, 0, -12}, {40, 30, 0}}, 0.1);
  const double left = *task.left_mm;
  for (int iy = 0; iy < map.ny; ++iy) {
    for (int ix = 0; ix < map.nx; ++ix) {
      const double x = map.x_of(ix), y = map.y_of(iy);
      if (x < 8.0 + left || x > 32.0 - left || y < 8.0 + left || y > 22.0 - left) continue;
      const auto height = static_cast<float>(-6.0 + left + 12.0);
      map.set(ix, iy, {height, height, 0.0F});
    }
  }
  task.stock = &map;
  Job job;
  const auto made = rough(task, job);
  ASSERT_TRUE(made) << made.error().message;
  int within = 0;
  for (std::size_t i = 1; i < made->path.size(); ++i) {
    if (made->path.role[i] != MoveRole::kCut) continue;
    const auto p = made->path.point(i);
    EXPECT_TRUE(p.x > 8.0 && p.x < 32.0 && p.y > 8.0 && p.y < 22.0) << p.x << ' ' << p.y << ' ' << p.z;
    ++within;
  }
  EXPECT_GT(within, 0);
  // All that was to go is gone: what stays lies in the pocket's corners and within a cell of its walls.
  stock::cut(map, model::profile_of(task.cutter), made->path);
  for (double x = 8.2; x < 31.9; x += 0.1) {
    for (double y = 8.2; y < 21.9; y += 0.1) {
      const bool corner = std::min(x - 8.0, 32.0 - x) < 3.0 && std::min(y - 8.0, 22.0 - y) < 3.0;
      if (!corner) {
        EXPECT_LT(stock::height_at(map, {x, y}), -6.0 + 2.0 * task.tolerance_mm + 1e-3) << x << ' ' << y;
      }
    }
  }
}

// A chord across a square inside corner was taken for the border: both its ends lay a little off it, and the
// place looked at beyond its middle was still free. Where the line began at another corner on the next level,
// the mill met all of the height above in one cut.
TEST(Border, IsFollowedIntoSquareCorners) {
  constexpr double kOff = 7e-4, kWithin = 0.0025, kFound = 1e-3;
  const auto is_free = [](geometry::Vec2 p) { return p.x >= 0.0 && p.y >= 0.0; };
  const auto border = [&](geometry::Vec2 free, geometry::Vec2 blocked) {
    while (norm(blocked - free) > kFound) {
      const geometry::Vec2 middle = 0.5 * (free + blocked);
      (is_free(middle) ? free : blocked) = middle;
    }
    return free;
  };
  // Free ground on the left.
  const auto line = refined({{kOff, 5.0}, {kOff, 0.24}, {0.24, kOff}, {5.0, kOff}}, kWithin, is_free, border);
  double nearest = 1e300;
  for (const geometry::Vec2 p : line) nearest = std::min(nearest, norm(p));
  EXPECT_LT(nearest, kWithin + kFound + std::sqrt(2.0) * kOff);
}

TEST(Levels, AreAsFewAsTerracesNeedAndEndOnFlats) {
  // A slope of 3 in 4 from 0 down to -9, then level ground.
  DropGrid reach;
  reach.step_mm = 0.5;
  reach.nx = 80;
  reach.ny = 3;
  for (int iy = 0; iy < reach.ny; ++iy) {
    for (int ix = 0; ix < reach.nx; ++ix) reach.z.push_back(std::max(-9.0, -0.75 * 0.5 * ix));
  }
  FreeformJob task;
  task.axial_depth_mm = 100.0;
  task.terrace_mm = 0.4;
  const auto levels = levels_of(task, reach, -9.0, 0.05).z_mm;
  // Square to it a terrace of height b stands 4/5 b: 0.5 mm each, and a tenth less is taken.
  EXPECT_GE(levels.size(), 18U);
  EXPECT_LE(levels.size(), 21U);
  for (std::size_t k = 1; k < levels.size(); ++k) EXPECT_LE(levels[k] - levels[k - 1], 0.5);
  EXPECT_NEAR(*std::min_element(levels.begin(), levels.end()), -9.0, 1e-9);
  EXPECT_TRUE(std::is_sorted(levels.begin(), levels.end())) << "of one group, cut from below";
  // A corner of 3 mm leaves cusps of 0.4 mm where it steps 2 sqrt(0.4 (6 - 0.4)) 3/5 = 1.8 mm down.
  task.cutter = bull(10.0, 3.0);
  EXPECT_LE(levels_of(task, reach, -9.0, 0.05).z_mm.size(), 7U);
  // No level is deeper than the cut may be.
  task.axial_depth_mm = 2.0;
  double at = 0.0;
  for (const double z : levels_of(task, reach, -9.0, 0.05).z_mm) {
    EXPECT_GE(z, at - 2.0 - 1e-9);
    at = std::min(at, z);
  }
}

TEST(Levels, EndAtTheFeetOfWallsWhoseFloorIsNotLevel) {
  FreeformJob task;
  task.axial_depth_mm = 100.0;
  DropGrid reach;
  reach.step_mm = 0.5;
  reach.nx = reach.ny = 2;
  reach.z = {-9.0, -9.0, -5.0, -5.0};
  // Feet from -6 to -3: a level at most 1 mm above each of them, and none that is not needed.
  std::vector<double> feet;
  for (int i = 0; i <= 30; ++i) feet.push_back(-6.0 + 0.1 * i);
  const auto levels = levels_of(task, reach, -9.0, 0.05, feet).z_mm;
  EXPECT_EQ(levels.size(), 4U);  // the lowest, and three for 3 mm
  for (const double foot : feet) {
    EXPECT_TRUE(std::any_of(levels.begin(), levels.end(), [&](double z) {
      return z >= foot && z <= foot + 1.0 + 1e-9;
    })) << foot;
  }
  EXPECT_EQ(levels_of(task, reach, -9.0, 0.05).z_mm.size(), 1U);
}

// Steps that exceed the axial depth by less than a share of it, but by more than rounding, were of no group:
// all levels became one, cut from below.
TEST(Levels, AreNoDeeperThanTheCutByMoreThanRounding) {
  constexpr double kDepth = 8.0, kMore = 5e-9, kMargin = 0.05, kAboveFloor = 1e-6;
  // Level ground at two heights, apart.
  DropGrid reach;
  reach.step_mm = 0.5;
  reach.nx = 9;
  reach.ny = 3;
  const double high = -(kDepth + kMore), low = 2.0 * high;
  for (int iy = 0; iy < reach.ny; ++iy) {
    for (int ix = 0; ix < reach.nx; ++ix)
      reach.z.push_back(ix < 4 ? high - kAboveFloor : ix > 4 ? low : std::nan(""));
  }
  FreeformJob task;
  task.axial_depth_mm = kDepth;
  task.terrace_mm = 0.5;
  task.floors_z_mm = {high - kMargin - kAboveFloor};
  const auto levels = levels_of(task, reach, low, kMargin).z_mm;
  ASSERT_FALSE(levels.empty());
  double at = 0.0;
  for (const double z : levels) {
    EXPECT_GE(z, at - kDepth - 0.5 * kMore);
    at = std::min(at, z);
  }
  EXPECT_EQ(at, low);
}

}  // namespace
}  // namespace capstan::toolpath::freeform
