#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "planner/making/toolpath/freeform/freeform.h"
#include "planner/making/toolpath/freeform/hatch.h"
#include "planner/making/toolpath/freeform/rough/material.h"
#include "planner/making/toolpath/freeform/rough/ways_in.h"

namespace capstan::toolpath::freeform {
namespace {

using geometry::Mesh;
using geometry::Vec2;

constexpr double kSide = 48.0;
constexpr double kTop = 0.5;      // of the material, over a plate at 0
constexpr double kRadius = 5.0;   // of the cutter, which is flat
constexpr double kStands = 0.55;  // of the tip over a floor: the allowance of 0.5 and its margin, a tenth
// In the middle of four points of the grid that levels are read from, an eighth of the radius apart.
constexpr double kCentre = 38.5 * kRadius / 8.0;
// Half of where the axis may be in the smallest pits: passes of 1 mm, too short for a ramp.
constexpr double kSmall = 0.5;
// Half of that in a wide one. The next points of the grid stand higher than the material's top.
constexpr double kWide = 6.1;

/// A square pit, or one within another.
struct Pit {
  double free_half_mm = 0.0;  ///< half of where the axis may be
  double tip_z_mm = 0.0;      ///< over its floor
};

/// A plate with pits about kCentre, the widest first; their walls lean by kLean.
Mesh plate_with(const std::vector<Pit>& pits) {
  constexpr double kLean = 0.01;
  std::vector<double> at{0.0, kSide};
  for (const Pit& p : pits) {
    const double half = p.free_half_mm + kRadius + kStands;
    for (const double side : {-1.0, 1.0}) {
      at.push_back(kCentre + side * half);
      at.push_back(kCentre + side * (half - kLean));
    }
  }
  std::sort(at.begin(), at.end());
  Mesh m;
  for (const double y : at) {
    for (const double x : at) {
      const double d = std::max(std::abs(x - kCentre), std::abs(y - kCentre));
      double z = 0.0;
      for (const Pit& p : pits) {
        if (d < p.free_half_mm + kRadius + kStands - 0.5 * kLean) z = p.tip_z_mm - kStands;
      }
      m.vertices.push_back({x, y, z});
    }
  }
  const auto n = static_cast<std::uint32_t>(at.size());
  for (std::uint32_t j = 0; j + 1 < n; ++j) {
    for (std::uint32_t i = 0; i + 1 < n; ++i) {
      const std::uint32_t a = j * n + i;
      m.triangles.push_back({a, a + 1, a + n + 1});
      m.triangles.push_back({a, a + n + 1, a + n});
    }
  }
  return m;
}

/// A flat end mill that ramps and cuts to its centre, in terraces of half a millimetre.
FreeformJob job_on(const Mesh& mesh, const stock::HeightMap& map) {
  FreeformJob task;
  task.surface = &mesh;
  task.stock = &map;
  task.cutter.id = "t";
  task.cutter.cutter_class = model::CutterClass::kEndmill;
  task.cutter.cutting_diameter_mm = 2.0 * kRadius;
  task.cutter.maximum_depth_of_cut_mm = 40.0;
  task.cutter.maximum_ramp_angle_rad = 3.0 * std::numbers::pi / 180.0;
  task.cutter.centre_cutting = true;
  task.top_z_mm = kTop;
  task.security_z_mm = 10.0;
  task.bottom_z_mm = -20.0;
  task.allowance_mm = 0.5;
  task.axial_depth_mm = 8.0;
  task.stepover_mm = 0.5;
  task.terrace_mm = 0.5;
  return task;
}

stock::HeightMap block() { return stock::from_box({{0, 0, -20}, {kSide, kSide, kTop}}, 0.1); }

/// The number of passes that FRF-REST names; 0 where it is not told.
int left_out(const Job& job) {
  for (const Diagnostic& d : job.diagnostics()) {
    if (d.code == "FRF-REST") return std::stoi(d.message);
  }
  return 0;
}

/// Lines of the hatch that cross a small pit; none lies within 0.05 mm of its border.
int lines_over_small(const FreeformJob& task) {
  const Hatch lines = hatch(geometry::rectangle({0, 0}, {kSide, kSide}), 0.0, task.stepover_mm);
  return static_cast<int>(std::count_if(lines.stripes.begin(), lines.stripes.end(),
                                        [](const Stripe& s) { return std::abs(s.v - kCentre) < kSmall; }));
}

TEST(WaysIn, GoStraightDownThroughTwoTerracesAtMost) {
  const auto map = block();
  const double most = kStraightTerraces * 0.5;
  // 0.2 mm less and 0.6 mm more of material above the floor of the pit.
  const Mesh shallow = plate_with({{kSmall, kTop - (most - 0.2)}});
  const Mesh deep = plate_with({{kSmall, kTop - (most + 0.6)}});
  {
    Job job;
    const auto out = rough(job_on(shallow, map), job);
    ASSERT_TRUE(out) << out.error().message;
    EXPECT_EQ(left_out(job), 0);
    const auto& role = out->path.role;
    EXPECT_NE(std::find(role.begin(), role.end(), model::MoveRole::kPlunge), role.end());
  }
  {
    Job job;
    const FreeformJob task = job_on(deep, map);
    const auto out = rough(task, job);
    ASSERT_FALSE(out);
    EXPECT_EQ(out.error().code, "FRF-EMPTY");
    EXPECT_EQ(left_out(job), lines_over_small(task)) << "passes shorter than half a radius count, too";
  }
  {  // As deep as it wants where no terraces are asked for.
    Job job;
    FreeformJob task = job_on(deep, map);
    task.terrace_mm = 0.0;
    EXPECT_TRUE(rough(task, job));
    EXPECT_EQ(left_out(job), 0);
  }
  {  // Never with a cutter that does not cut to its centre.
    Job job;
    FreeformJob task = job_on(shallow, map);
    task.cutter.centre_cutting = false;
    EXPECT_FALSE(rough(task, job));
    EXPECT_EQ(left_out(job), lines_over_small(task));
  }
}

// Of the small pit in the wide one the lowest level is cut first. It lies 1.06 mm below what the wide one's
// level left, and fails; the level above it lies no more than 1 mm higher, as a terrace on the wall between
// two points of the grid may be 0.9 * 0.5 mm * sqrt(1 + (1.048 / 0.625)^2) = 0.88 mm.
TEST(Rough, TellsNothingOfPassesThatItCutsWhenALevelAboveIsCleared) {
  const auto map = block();
  const double lowest = -2.0 - 1.06;
  const Mesh mesh = plate_with({{kWide, -2.0}, {kSmall, lowest}});
  Job job;
  const auto out = rough(job_on(mesh, map), job);
  ASSERT_TRUE(out) << out.error().message;
  EXPECT_EQ(left_out(job), 0);
  EXPECT_NEAR(*std::min_element(out->levels_z_mm.begin(), out->levels_z_mm.end()), lowest, 0.01);
}

// Here that level stands 0.9 * 0.5 mm * sqrt(1 + (2.988 / 0.625)^2) = 2.2 mm above the lowest: this is tried
// again, and fails again.
TEST(Rough, CountsPassesOnceThatItTriesTwice) {
  const auto map = block();
  const Mesh mesh = plate_with({{kWide, -2.0}, {kSmall, -5.0}});
  const FreeformJob task = job_on(mesh, map);
  Job job;
  const auto out = rough(task, job);
  ASSERT_TRUE(out) << out.error().message;
  EXPECT_EQ(left_out(job), lines_over_small(task));
  EXPECT_GT(*std::min_element(out->levels_z_mm.begin(), out->levels_z_mm.end()), -5.0 + 0.5);
}

// Pillars on level ground, of which a corner of 3 mm passes some by.
TEST(Material, IsClearAndMeetsAsPointsOfItSay) {
  constexpr double kWorth = 0.05;  // more than that is worth a way
  constexpr double kClear = 1e-3;  // and less than that is nothing
  constexpr double kRounding = 1e-5;
  constexpr int kPoints = 4;  // of a cell's side
  auto map = stock::from_box({{0, 0, -20}, {20, 20, 0}}, 0.25);
  std::mt19937 random(7);
  const auto draw = [&](double lo, double hi) {
    return std::uniform_real_distribution<double>(lo, hi)(random);
  };
  for (int k = 0; k < 12; ++k) {
    const auto top = static_cast<float>(20.0 + draw(0.1, 1.0));
    map.set(static_cast<int>(draw(0.0, 80.0)), static_cast<int>(draw(0.0, 80.0)), {top, top, 0.0F});
  }
  model::Cutter c;
  c.cutter_class = model::CutterClass::kBullnoseEndmill;
  c.cutting_diameter_mm = 8.0;
  c.corner_radius_mm = 3.0;
  c.maximum_depth_of_cut_mm = 40.0;
  const Material material(map, c);
  int passed_by = 0;
  for (int k = 0; k < 500; ++k) {
    const Vec2 p{draw(0.0, 20.0), draw(0.0, 20.0)};
    const double z = draw(0.01, 1.0);
    double most = -1e300, most_in_middles = -1e300;  // above the outline; the latter of means
    for (int iy = 0; iy < map.ny; ++iy) {
      for (int ix = 0; ix < map.nx; ++ix) {
        const double top = map.origin.z + static_cast<double>(map.at(ix, iy).top_mm);
        for (int i = 0; i < kPoints * kPoints; ++i) {
          const Vec2 q{map.origin.x + (ix + (i % kPoints + 0.5) / kPoints) * map.cell_mm,
                       map.origin.y + (iy + (i / kPoints + 0.5) / kPoints) * map.cell_mm};
          const double r = norm(q - p);
          if (r <= material.profile.radius_mm) most = std::max(most, top - z - material.profile.height(r));
        }
        // To what is one part of eight of a cell farther out, as finely as the outline is told.
        const double r = norm(Vec2{map.x_of(ix), map.y_of(iy)} - p) + map.cell_mm / 8.0;
        if (r <= material.profile.radius_mm - map.cell_mm)
          most_in_middles = std::max(most_in_middles, top - z - material.profile.height(r));
      }
    }
    const bool clear = material.is_clear(p, z), meets = material.meets(p, z);
    EXPECT_FALSE(clear && most > kClear + kRounding) << k;
    EXPECT_FALSE(!meets && most_in_middles > kWorth + kRounding) << k;
    EXPECT_FALSE(meets && clear) << k;
    if (clear && !material.is_below(p, z)) ++passed_by;
  }
  EXPECT_GT(passed_by, 0);
}

}  // namespace
}  // namespace capstan::toolpath::freeform
