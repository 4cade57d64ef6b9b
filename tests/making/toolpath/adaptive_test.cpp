#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <random>
#include <string>

#include "planner/making/toolpath/path_job.h"
#include "tests/making/toolpath/front_raster.h"
#include "tests/making/toolpath/path_helpers.h"

namespace capstan::toolpath {
namespace {

using geometry::Region;
using geometry::Vec2;
using model::MoveRole;

constexpr double kPi = std::numbers::pi;
constexpr double kBlind = 0.05;  // mm: what a raster of 0.04 mm cannot tell

PathJob job_of(const Region& area, double diameter_mm, double radial_mm) {
  PathJob t = area_job(area, 10.0, diameter_mm);
  t.constant_engagement = true;
  t.radial_depth_mm = radial_mm;
  t.axial_depth_mm = 10.0;
  t.allowance_side_mm = 0.2;
  return t;
}

/// The first move after the way into the material: after the last ramp, and a turn at the bottom.
std::size_t after_entry(const GeneratedPath& g) {
  std::size_t last = 0;
  for (std::size_t i = 0; i < g.path.size(); ++i) {
    if (g.path.role[i] == MoveRole::kRamp) last = i;
  }
  return last == 0 ? 0 : last + 3;
}

std::string refusal(const PathJob& t) {
  Job job;
  const auto g = generate(t, job);
  return g ? "none" : g.error().code;
}

void expect_constant(const PathJob& task, const std::string& name) {
  Job job;
  const auto g = generate(task, job);
  ASSERT_TRUE(g) << name << ": " << g.error().message;
  plot(*g, task.shape.reach, "adaptive_" + name);
  EXPECT_THAT(rule_breaks(task, *g), testing::IsEmpty()) << name;
  const double radius = 0.5 * task.cutter.cutting_diameter_mm;
  const double margin = radius + task.allowance_side_mm;
  const Region reach = task.shape.reach.empty() ? task.shape.area : task.shape.reach;
  EXPECT_LE(gouge_mm(*g, reach, margin, task.start_z_mm - 1e-6), 0.003) << name;
  const auto box = geometry::bounds(reach);
  FrontRaster map(box.lo - Vec2{2, 2}, box.hi + Vec2{2, 2}, 0.04);
  if (!task.stock.empty()) map.only(task.stock);
  const auto r = map.run(*g, radius, -task.shape.depth_mm + 0.5, after_entry(*g), kBlind);
  const double straight = std::acos((radius - task.radial_depth_mm) / (radius - kBlind));
  // A degree is a ray of the raster. Where the last strip between two cleared places breaks, the cutter turns
  // into it, for less than half a millimetre.
  EXPECT_LE(r.held_arc_rad, 1.10 * straight + kPi / 180)
      << name << " at " << r.held_at.x << ", " << r.held_at.y;
  EXPECT_LE(r.peak_arc_rad, 1.35 * straight + kPi / 180) << name;
  EXPECT_LE(r.most_on_link_rad, 0.0) << name;
  // Square corners keep a tip, as deep as a twentieth of the radius.
  const double round = 0.125 * radius;
  const Region can = geometry::offset(geometry::offset(reach, -(margin + round)), radius + round - 0.06);
  const Region material = task.stock.empty() ? can : geometry::intersect(can, task.stock);
  EXPECT_LE(map.left_mm2(material), 1e-3 * geometry::area(material)) << name;
}

TEST(AdaptivePath, KeepsTheArcOfContactInARectangle) {
  expect_constant(job_of(geometry::rounded_rectangle({0, 0}, {100, 80}, 6.0), 10.0, 1.0), "rectangle");
}

TEST(AdaptivePath, KeepsTheArcOfContactInAnL) {
  const Region l = geometry::subtract(geometry::rounded_rectangle({0, 0}, {90, 70}, 5.5),
                                      geometry::rectangle({40, 30}, {120, 90}));
  expect_constant(job_of(l, 10.0, 1.5), "l");
}

TEST(AdaptivePath, KeepsTheArcOfContactAroundBosses) {
  Region r = geometry::rounded_rectangle({0, 0}, {100, 70}, 8.0);
  r = geometry::subtract(r, geometry::disc({30, 35}, 9.0));
  r = geometry::subtract(r, geometry::rectangle({60, 20}, {76, 36}));
  expect_constant(job_of(r, 8.0, 0.8), "bosses");
  PathJob conventional = job_of(r, 8.0, 1.6);
  conventional.climb = false;
  expect_constant(conventional, "bosses_conv");
}

TEST(AdaptivePath, KeepsTheArcOfContactInACircle) {
  expect_constant(job_of(geometry::disc({0, 0}, 30.0), 12.0, 1.2), "circle");
}

TEST(AdaptivePath, KeepsTheArcOfContactInANarrowSlot) {
  expect_constant(job_of(geometry::rounded_rectangle({0, 0}, {70, 16}, 8.0), 10.0, 1.0), "slot");
  expect_constant(job_of(geometry::rounded_rectangle({0, 0}, {70, 25}, 12.5), 16.0, 1.0), "slot25");
}

TEST(AdaptivePath, EntersAnOpenPocketFromOutside) {
  PathJob t = job_of(geometry::rectangle({0, 0}, {60, 40}), 10.0, 1.5);
  t.shape.open = true;
  t.shape.reach = geometry::rectangle({-40, 0}, {60, 40});
  t.stock = geometry::rectangle({0, -30}, {90, 70});
  expect_constant(t, "open");
}

TEST(AdaptivePath, ClearsRoundABossFromOutside) {
  PathJob t = job_of({}, 10.0, 1.5);
  t.stock = geometry::rectangle({0, 0}, {80, 60});
  const Region boss = geometry::rounded_rectangle({25, 20}, {60, 42}, 6.0);
  t.shape.area = geometry::subtract(t.stock, boss);
  t.shape.reach = geometry::subtract(geometry::rectangle({-40, -40}, {120, 100}), boss);
  t.shape.open = true;
  expect_constant(t, "boss_outside");
}

TEST(AdaptivePath, ClearsSharpCorners) {
  expect_constant(job_of(geometry::rectangle({0, 0}, {60, 40}), 10.0, 2.0), "sharp");
  expect_constant(job_of(geometry::clean({{{0, 0}, {80, 0}, {30, 50}}}), 8.0, 1.0), "triangle");
}

TEST(AdaptivePath, RepeatsTheSamePassesOnEveryLevel) {
  PathJob t = job_of(geometry::rounded_rectangle({0, 0}, {60, 50}, 7.0), 10.0, 1.5);
  t.shape.depth_mm = 20.0;
  Job job;
  const auto g = generate(t, job);
  ASSERT_TRUE(g) << g.error().message;
  EXPECT_THAT(rule_breaks(t, *g), testing::IsEmpty());
  ASSERT_EQ(g->levels_z_mm.size(), 2U);
  const auto places_at = [&](double z) {
    std::vector<Vec2> out;
    for (std::size_t i = 1; i < g->path.size(); ++i) {
      if (g->path.role[i] == MoveRole::kCut && g->path.z[i] == z) out.push_back(xy(g->path.point(i)));
    }
    return out;
  };
  const auto upper = places_at(-10.0);
  const auto lower = places_at(-20.0);
  // The ways in may differ.
  const std::size_t passes = std::min(upper.size(), lower.size()) - 8;
  ASSERT_GT(passes, 100U);
  EXPECT_TRUE(
      std::equal(upper.rbegin(), upper.rbegin() + static_cast<std::ptrdiff_t>(passes), lower.rbegin()));
}

TEST(AdaptivePath, IsTheSameForTheSameJob) {
  const PathJob t = job_of(geometry::rounded_rectangle({0, 0}, {60, 50}, 7.0), 10.0, 1.5);
  Job job;
  const auto a = generate(t, job);
  const auto b = generate(t, job);
  ASSERT_TRUE(a && b);
  EXPECT_TRUE(a->path == b->path);
}

TEST(AdaptivePath, LiftsToTheRetractPlaneOnlyAtTheEndInAClosedPocket) {
  const PathJob t = job_of(geometry::rounded_rectangle({0, 0}, {100, 80}, 6.0), 10.0, 1.0);
  Job job;
  const auto g = generate(t, job);
  ASSERT_TRUE(g) << g.error().message;
  EXPECT_EQ(std::count(g->path.role.begin(), g->path.role.end(), MoveRole::kRetract), 1);
}

TEST(AdaptivePath, SaysWhatItLeavesInCornersThatRingsReach) {
  // The corners are as round as the cutter and its allowance: those of the centres are square.
  PathJob t = job_of(geometry::rounded_rectangle({0, 0}, {60, 40}, 5.2), 10.0, 1.0);
  const auto left = [&] {
    Job job;
    EXPECT_TRUE(generate(t, job));
    return std::count_if(job.diagnostics().begin(), job.diagnostics().end(),
                         [](const Diagnostic& d) { return d.code == "TPA-REST"; });
  };
  EXPECT_EQ(left(), 1);
  t.constant_engagement = false;
  EXPECT_EQ(left(), 0);
}

TEST(AdaptivePath, IsRefusedWhereTheWayInLeavesNoHole) {
  PathJob t = job_of(geometry::rectangle({0, 0}, {60, 40}), 10.0, 1.0);
  t.approach.kind = Approach::Kind::kPlunge;
  EXPECT_EQ(refusal(t), "TPA-UNSUPPORTED");
  t.approach.kind = Approach::Kind::kFree;
  t.cutter.maximum_ramp_angle_rad = 0.0;
  EXPECT_EQ(refusal(t), "TPA-UNSUPPORTED");
}

TEST(AdaptivePath, IsRefusedWhereACutterCannotTurn) {
  EXPECT_EQ(refusal(job_of(geometry::rounded_rectangle({0, 0}, {70, 12}, 6.0), 10.0, 1.0)),
            "TPA-UNSUPPORTED");
  // Two chambers and a neck 11 mm wide.
  const Region chambers =
      geometry::unite(geometry::rectangle({0, 0}, {40, 40}), geometry::rectangle({70, 0}, {110, 40}));
  EXPECT_EQ(refusal(job_of(geometry::unite(chambers, geometry::rectangle({30, 10}, {80, 21})), 10.0, 1.0)),
            "TPA-UNSUPPORTED");
  EXPECT_EQ(refusal(job_of(geometry::unite(chambers, geometry::rectangle({30, 10}, {80, 26})), 10.0, 1.0)),
            "none");
}

TEST(AdaptivePath, IsRefusedForWallsThatAreNotUprightAndForFinishing) {
  PathJob t = job_of(geometry::rectangle({0, 0}, {60, 40}), 10.0, 1.0);
  t.shape.slope_rad = 0.05;
  EXPECT_EQ(refusal(t), "TPA-UNSUPPORTED");
  t.shape.slope_rad = 0.0;
  t.shape.bottom_radius_mm = 2.0;
  EXPECT_EQ(refusal(t), "TPA-UNSUPPORTED");
  t.shape.bottom_radius_mm = 0.0;
  t.operation = model::TypeId::kBottomAndSideFinishMilling;
  EXPECT_EQ(refusal(t), "TPA-UNSUPPORTED");
}

// The stock stands over the open sides by less than the cutter's radius.
TEST(AdaptivePath, SaysWhereNoPassReachesHowMuchIsLeftAndWhatMay) {
  PathJob t = job_of(geometry::rectangle({0, 0}, {60, 40}), 6.0, 0.6);
  t.shape.open = true;
  t.shape.reach = geometry::rectangle({-40, 0}, {100, 40});
  t.stock = geometry::rectangle({-2, 0}, {62, 40});
  for (const bool climb : {true, false}) {
    t.climb = climb;
    Job job;
    const auto g = generate(t, job);
    ASSERT_FALSE(g);
    const std::string& text = g.error().message;
    const auto figure = [&](const std::string& after) {
      const auto at = text.find(after);
      return at == std::string::npos ? std::nan("") : std::strtod(text.c_str() + at + after.size(), nullptr);
    };
    EXPECT_NEAR(figure("about x "), 30.0, 35.0) << text;
    EXPECT_NEAR(figure(", y "), 20.0, 20.0) << text;
    EXPECT_GT(figure("no pass reaches "), 1.0) << text;
    EXPECT_NE(text.find("; rings or a cutter of less than 6 mm may"), std::string::npos) << text;
  }
}

TEST(AdaptivePath, ClearsRandomStars) {
  for (unsigned seed = 1; seed <= 4; ++seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> radius(20.0, 45.0);
    geometry::Loop loop;
    const int n = 5 + static_cast<int>(seed % 7);
    for (int i = 0; i < n; ++i) {
      const double a = 2.0 * kPi * i / n;
      const double r = radius(random);
      loop.push_back({r * std::cos(a), r * std::sin(a)});
    }
    PathJob t = job_of(geometry::clean({loop}), 6.0 + seed % 3, 0.5 + 0.25 * (seed % 4));
    expect_constant(t, "star" + std::to_string(seed));
  }
}

}  // namespace
}  // namespace capstan::toolpath
