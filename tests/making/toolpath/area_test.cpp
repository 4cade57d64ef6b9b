#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "planner/making/toolpath/path_job.h"
#include "tests/making/toolpath/path_helpers.h"
#include "tests/support/soak.h"

namespace capstan::toolpath {
namespace {

using geometry::Region;
using geometry::Vec2;
using model::MoveKind;
using model::StrategyKind;

constexpr double kPi = std::numbers::pi;

Region pocket_with_islands() {
  Region r = geometry::rounded_rectangle({0, 0}, {100, 60}, 6.0);
  r = geometry::subtract(r, geometry::disc({30, 30}, 8.0));
  r = geometry::subtract(r, geometry::rectangle({60, 20}, {75, 35}));
  return r;
}

Region star(unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> radius(14.0, 45.0);
  geometry::Loop loop;
  const int n = 5 + static_cast<int>(seed % 9);
  for (int i = 0; i < n; ++i) {
    const double a = 2.0 * kPi * i / n;
    const double r = radius(random);
    loop.push_back({50 + r * std::cos(a), 50 + r * std::sin(a)});
  }
  return geometry::clean({loop});
}

/// Everything that must hold of a pocket cut from the solid.
void expect_sound(const PathJob& task, const std::string& name) {
  Job job;
  const auto g = generate(task, job);
  ASSERT_TRUE(g) << name << ": " << g.error().message;
  plot(*g, task.shape.reach, name);
  EXPECT_THAT(rule_breaks(task, *g), testing::IsEmpty()) << name;
  const double radius = 0.5 * task.cutter.cutting_diameter_mm;
  EXPECT_LE(gouge_mm(*g, task.shape.reach, radius + task.allowance_side_mm, task.start_z_mm - 1e-6), 0.003)
      << name;
  const auto box = geometry::bounds(task.shape.area);
  HeightMap map(box.lo - Vec2{5, 5}, box.hi + Vec2{5, 5}, 0.25, task.start_z_mm);
  const auto report = map.run(*g, task.cutter);
  EXPECT_THAT(report.faults, testing::IsEmpty()) << name;
  // All that a disc can reach is at the bottom, but for the grid's own coarseness.
  const double margin = radius + task.allowance_side_mm;
  const Region can = geometry::offset(geometry::offset(task.shape.reach, -margin), radius - 0.3);
  EXPECT_NEAR(map.highest(can), -task.shape.depth_mm + task.allowance_bottom_mm, 1e-4) << name;
}

TEST(AreaPath, EveryStrategyClearsAPocketWithIslandsAndTouchesNoWall) {
  for (const auto strategy :
       {StrategyKind::kContourParallel, StrategyKind::kContourSpiral, StrategyKind::kBidirectional,
        StrategyKind::kUnidirectional, StrategyKind::kContourBidirectional}) {
    for (const bool climb : {true, false}) {
      PathJob t = area_job(pocket_with_islands(), 8.0, 8.0);
      t.axial_depth_mm = 3.0;
      t.radial_depth_mm = 3.5;
      t.allowance_side_mm = 0.3;
      t.allowance_bottom_mm = 0.2;
      t.strategy = strategy;
      t.climb = climb;
      expect_sound(t, "islands_" + std::to_string(static_cast<int>(strategy)) + (climb ? "_climb" : "_conv"));
    }
  }
}

TEST(AreaPath, ClearsTriangularPockets) {
  for (const double step : {2.0, 5.0, 8.0}) {
    PathJob t = area_job(geometry::clean({{{0, 0}, {80, 0}, {30, 50}}}), 5.0, 10.0);
    t.radial_depth_mm = step;
    expect_sound(t, "triangle");
    t.strategy = StrategyKind::kContourSpiral;
    expect_sound(t, "triangle_spiral");
  }
}

TEST(AreaPath, ClearsRandomStarsByEveryStrategy) {
  for (unsigned seed = 1; seed <= 12; ++seed) {
    for (const auto strategy :
         {StrategyKind::kContourParallel, StrategyKind::kContourSpiral, StrategyKind::kBidirectional,
          StrategyKind::kUnidirectional, StrategyKind::kContourBidirectional}) {
      PathJob t = area_job(star(seed), 4.0, 6.0);
      t.strategy = strategy;
      t.radial_depth_mm = 2.7;
      expect_sound(t, "star" + std::to_string(seed) + "_" + std::to_string(static_cast<int>(strategy)));
    }
  }
}

/// A star with holes, turned; everything about it and its job drawn from the seed.
PathJob random_job(unsigned seed) {
  std::mt19937 random(seed);
  const auto draw = [&](double lo, double hi) {
    return std::uniform_real_distribution<double>(lo, hi)(random);
  };
  Region area = star(seed);
  const int holes = static_cast<int>(draw(0.0, 3.99));
  for (int i = 0; i < holes; ++i) {
    const Vec2 at{draw(25, 75), draw(25, 75)};
    area = geometry::subtract(area, draw(0, 1) < 0.5
                                        ? geometry::disc(at, draw(1, 7))
                                        : geometry::rectangle(at, at + Vec2{draw(1, 12), draw(1, 12)}));
  }
  PathJob t = area_job(area, draw(2.0, 9.0), draw(2.5, 9.0));
  t.strategy = static_cast<StrategyKind>(1 + static_cast<int>(draw(0.0, 4.99)));
  t.climb = draw(0, 1) < 0.5;
  t.cutter.centre_cutting = draw(0, 1) < 0.7;
  t.radial_depth_mm = draw(0.2, 0.98) * t.cutter.cutting_diameter_mm;
  t.axial_depth_mm = draw(1.0, 5.0);
  t.ramp_depth_mm = draw(0.0, 10.0);
  t.cutter.usable_length_mm = 15.0;
  t.allowance_side_mm = draw(0.0, 0.5);
  t.allowance_bottom_mm = draw(0.0, 0.4);
  const double a = draw(0.0, 6.28);
  t.feed_direction = Vec2{std::cos(a), std::sin(a)};
  if (draw(0, 1) < 0.2) t.rotation_ccw = draw(0, 1) < 0.5;
  return t;
}

TEST(AreaPath, HoldsForRandomPocketsToolsAndStrategies) {
  constexpr unsigned kCount = 30;
  const unsigned first =
      100 +
      (soaking() ? kCount * static_cast<unsigned>(::testing::UnitTest::GetInstance()->random_seed()) : 0U);
  for (unsigned seed = first; seed < first + kCount; ++seed) {
    const PathJob t = random_job(seed);
    Job job;
    const auto g = generate(t, job);
    if (!g) {  // an outcome, not a fault: the cutter is too large, or has no way in
      EXPECT_THAT(g.error().code, testing::AnyOf("TPA-NO-FIT", "TPA-ENTRY")) << seed;
      if (g.error().code == "TPA-ENTRY") {
        EXPECT_FALSE(t.cutter.centre_cutting);
      }
      continue;
    }
    expect_sound(t, "random" + std::to_string(seed) + "_" + std::to_string(static_cast<int>(t.strategy)));
  }
}

TEST(AreaPath, RunsASpiralWithoutStepsBetweenItsTurns) {
  PathJob t = area_job(geometry::rounded_rectangle({0, 0}, {70, 50}, 10.0), 4.0, 10.0);
  t.strategy = StrategyKind::kContourSpiral;
  t.radial_depth_mm = 4.0;
  expect_sound(t, "spiral");
  Job job;
  const auto g = generate(t, job);
  // Between helix and end no corner is sharper than the pocket's own rings have: 90 degrees.
  double sharpest = 0.0;
  Vec2 before{};
  for (std::size_t i = 1; i < g->path.size(); ++i) {
    if (g->path.role[i] != model::MoveRole::kCut || g->path.kind[i] != MoveKind::kLine) {
      before = {};
      continue;
    }
    const Vec2 d = xy(g->path.point(i) - g->path.point(i - 1));
    if (norm(before) > 0.0)
      sharpest = std::max(sharpest, std::atan2(std::abs(cross(before, d)), dot(before, d)));
    before = d;
  }
  EXPECT_LT(sharpest, 0.5 * kPi + 0.2);
}

TEST(AreaPath, ClearsFromOutsideInWhenRotationAndCutModeSaySo) {
  PathJob t = area_job(pocket_with_islands(), 5.0, 8.0);
  t.rotation_ccw = false;
  t.climb = true;  // clockwise and climbing: material inside
  expect_sound(t, "outside_in");
}

TEST(AreaPath, EntersWithoutPlungingWhenTheCutterDoesNotCutToItsCentre) {
  for (const double width : {40.0, 14.0, 11.0}) {
    PathJob t = area_job(geometry::rounded_rectangle({0, 0}, {60, width}, 5.0), 6.0, 10.0);
    t.cutter.centre_cutting = false;
    expect_sound(t, "narrow_" + std::to_string(static_cast<int>(width)));
  }
  PathJob t = area_job(geometry::disc({0, 0}, 6.0), 6.0, 10.0);
  t.cutter.centre_cutting = false;
  Job job;
  const auto g = generate(t, job);
  ASSERT_FALSE(g);
  EXPECT_EQ(g.error().code, "TPA-ENTRY");
}

TEST(AreaPath, DividesTheDepthEqually) {
  // NIST's example: 29.5 mm by at most 6.5 makes five levels of 5.9.
  PathJob t = area_job(geometry::rectangle({45, 30}, {95, 110}), 30.0, 18.0);
  t.axial_depth_mm = 6.5;
  t.allowance_side_mm = 1.0;
  t.allowance_bottom_mm = 0.5;
  Job job;
  const auto g = generate(t, job);
  ASSERT_TRUE(g);
  ASSERT_EQ(g->levels_z_mm.size(), 5U);
  for (std::size_t i = 0; i < 5; ++i) EXPECT_NEAR(g->levels_z_mm[i], -5.9 * static_cast<double>(i + 1), 1e-9);
  // The wall ring of the pocket lies at exactly radius and allowance.
  double x_hi = -1e9;
  for (std::size_t i = 0; i < g->path.size(); ++i) x_hi = std::max(x_hi, g->path.x[i]);
  EXPECT_NEAR(x_hi, 95.0 - 9.0 - 1.0, 1e-5);
}

TEST(AreaPath, FinishesTheShellThatRoughingLeft) {
  PathJob t = area_job(pocket_with_islands(), 9.0, 8.0);
  t.operation = model::TypeId::kBottomAndSideFinishMilling;
  t.strategy = StrategyKind::kContourParallel;
  t.axial_depth_mm = 3.0;
  t.left_on_side_mm = 0.5;
  t.left_on_bottom_mm = 0.3;
  Job job;
  const auto g = generate(t, job);
  ASSERT_TRUE(g) << g.error().message;
  plot(*g, t.shape.reach, "finish");
  EXPECT_THAT(rule_breaks(t, *g), testing::IsEmpty());
  EXPECT_LE(gouge_mm(*g, t.shape.reach, 4.0, -1e-6), 0.003);
  HeightMap map({-5, -5}, {105, 65}, 0.25, 0.0);
  map.set_top(geometry::offset(geometry::offset(t.shape.reach, -4.5), 4.0), -8.7);
  EXPECT_THAT(map.run(*g, t.cutter).faults, testing::IsEmpty());
  EXPECT_NEAR(map.highest(geometry::offset(geometry::offset(t.shape.reach, -4.0), 3.7)), -9.0, 1e-4);
}

TEST(AreaPath, FollowsAFinishedWallPastWhereItBegan) {
  PathJob t = area_job(geometry::rectangle({0, 0}, {60, 40}), 6.0, 8.0);
  t.operation = model::TypeId::kBottomAndSideFinishMilling;
  t.strategy = StrategyKind::kContourParallel;
  t.axial_depth_mm = 6.0;
  t.left_on_side_mm = 0.5;
  t.left_on_bottom_mm = 0.3;
  Job job;
  const auto g = generate(t, job);
  ASSERT_TRUE(g) << g.error().message;
  EXPECT_LE(gouge_mm(*g, t.shape.reach, 4.0, -1e-6), 0.003);
  // The centre's way along the wall: the rectangle shrunk by the radius, which the path meets and leaves
  // once.
  const auto on_wall = [&](std::size_t i) {
    const double x = g->path.x[i], y = g->path.y[i];
    return g->path.z[i] < -5.9 && x > 4.0 - 1e-6 && x < 56.0 + 1e-6 && y > 4.0 - 1e-6 && y < 36.0 + 1e-6 &&
           (std::abs(x - 4.0) < 1e-6 || std::abs(x - 56.0) < 1e-6 || std::abs(y - 4.0) < 1e-6 ||
            std::abs(y - 36.0) < 1e-6);
  };
  double along = 0.0;
  std::size_t met = 0;
  for (std::size_t i = 1; i < g->path.size(); ++i) {
    if (!on_wall(i)) continue;
    if (on_wall(i - 1)) {
      along += model::move_length(g->path, i);
    } else {
      ++met;
    }
  }
  EXPECT_EQ(met, 1U);
  // Once around, 2 (52 + 32) mm, and a tenth of the diameter once more.
  EXPECT_NEAR(along, 168.0 + 0.8, 1e-3);
}

TEST(AreaPath, StopsAtTheTopOfALowIsland) {
  PathJob t = area_job(geometry::rectangle({0, 0}, {80, 60}), 10.0, 8.0);
  const Region island = geometry::disc({40, 30}, 10.0);
  t.shape.islands.push_back({island, -4.0});
  t.shape.reach = geometry::subtract(t.shape.area, island);
  t.axial_depth_mm = 3.0;
  Job job;
  const auto g = generate(t, job);
  ASSERT_TRUE(g) << g.error().message;
  plot(*g, t.shape.reach, "low_island");
  // 4 mm to the island's top in two, 6 mm below in two.
  ASSERT_EQ(g->levels_z_mm.size(), 4U);
  EXPECT_NEAR(g->levels_z_mm[1], -4.0, 1e-9);
  EXPECT_LE(gouge_mm(*g, t.shape.reach, 4.0, -4.0 - 1e-6), 0.003);
  HeightMap map({-5, -5}, {85, 65}, 0.25, 0.0);
  EXPECT_THAT(map.run(*g, t.cutter).faults, testing::IsEmpty());
  EXPECT_NEAR(map.highest(geometry::offset(island, -0.5)), -4.0, 1e-4);
  EXPECT_NEAR(map.highest(geometry::offset(geometry::offset(t.shape.reach, -4.0), 3.7)), -10.0, 1e-4);
}

TEST(AreaPath, FinishesTheTopsOfLowIslandsAndFloorsThickerThanALevel) {
  for (const double left : {0.3, 2.5}) {
    PathJob t = area_job(geometry::rectangle({0, 0}, {80, 60}), 10.0, 8.0);
    const Region island = geometry::disc({40, 30}, 10.0);
    t.shape.islands.push_back({island, -4.0});
    t.shape.reach = geometry::subtract(t.shape.area, island);
    t.operation = model::TypeId::kBottomAndSideFinishMilling;
    t.axial_depth_mm = 1.0;
    t.left_on_side_mm = 0.5;
    t.left_on_bottom_mm = left;
    Job job;
    const auto g = generate(t, job);
    ASSERT_TRUE(g) << g.error().message;
    EXPECT_THAT(rule_breaks(t, *g), testing::IsEmpty());
    EXPECT_LE(gouge_mm(*g, t.shape.reach, 4.0, -4.0 - 1e-6), 0.003);
    HeightMap map({-5, -5}, {85, 65}, 0.25, 0.0);
    map.set_top(geometry::offset(geometry::rectangle({0, 0}, {80, 60}), -0.5), -4.0 + left);
    map.set_top(geometry::offset(geometry::offset(t.shape.reach, -4.5), 4.0), -10.0 + left);
    EXPECT_THAT(map.run(*g, t.cutter).faults, testing::IsEmpty()) << left;
    EXPECT_NEAR(map.highest(geometry::offset(island, -0.3)), -4.0, 1e-4) << left;
    EXPECT_NEAR(map.highest(geometry::offset(geometry::offset(t.shape.reach, -4.0), 3.7)), -10.0, 1e-4);
  }
}

TEST(AreaPath, FollowsSlopedWallsAndKeepsClearOfTheFilletAtTheirFoot) {
  PathJob t = area_job(geometry::rectangle({0, 0}, {60, 40}), 10.0, 8.0);
  t.axial_depth_mm = 2.0;
  t.shape.slope_rad = 10.0 * kPi / 180.0;
  t.shape.reach = t.shape.area;
  Job job;
  auto g = generate(t, job);
  ASSERT_TRUE(g) << g.error().message;
  // The ring at height h above the bottom lies h tan(slope) further out.
  for (const double h : {8.0, 4.0, 0.0}) {
    double x = -1e9;
    for (std::size_t i = 1; i < g->path.size(); ++i) {
      if (std::abs(g->path.z[i] - (h - 10.0)) < 1e-9) x = std::max(x, g->path.x[i]);
    }
    EXPECT_NEAR(x, 60.0 - 4.0 + h * std::tan(t.shape.slope_rad), 1e-4) << h;
  }
  // A fillet of 3 mm under a sharp cutter: at its foot the cutter stays 3 mm from the wall.
  t.shape.slope_rad = 0.0;
  t.shape.bottom_radius_mm = 3.0;
  t.axial_depth_mm = 1.0;
  g = generate(t, job);
  ASSERT_TRUE(g);
  for (const double h : {3.0, 2.0, 1.0, 0.0}) {
    double x = -1e9;
    for (std::size_t i = 1; i < g->path.size(); ++i) {
      if (std::abs(g->path.z[i] - (h - 10.0)) < 1e-9) x = std::max(x, g->path.x[i]);
    }
    EXPECT_NEAR(x, 60.0 - 4.0 - (3.0 - std::sqrt(9.0 - (3.0 - h) * (3.0 - h))), 1e-4) << h;
  }
}

TEST(AreaPath, KeepsOffWhatMustBeAvoided) {
  PathJob t = area_job(geometry::rectangle({0, 0}, {60, 40}), 4.0, 8.0);
  t.avoid = geometry::rectangle({40, 25}, {70, 50});
  Job job;
  const auto g = generate(t, job);
  ASSERT_TRUE(g);
  EXPECT_LE(gouge_mm(*g, geometry::subtract(t.shape.reach, t.avoid), 4.0, -1e-6), 0.003);
}

TEST(AreaPath, EntersAnOpenPocketFromOutside) {
  PathJob t = area_job(geometry::rectangle({0, 0}, {60, 40}), 6.0, 10.0);
  t.shape.open = true;
  t.shape.reach = geometry::rectangle({0, 0}, {160, 40});
  t.cutter.centre_cutting = false;
  t.cutter.maximum_ramp_angle_rad = 0.0;  // no other way in
  for (const auto strategy : {StrategyKind::kContourParallel, StrategyKind::kBidirectional}) {
    t.strategy = strategy;
    Job job;
    const auto g = generate(t, job);
    ASSERT_TRUE(g) << g.error().message;
    plot(*g, t.shape.reach, "open_" + std::to_string(static_cast<int>(strategy)));
    EXPECT_THAT(rule_breaks(t, *g), testing::IsEmpty());
    EXPECT_LE(gouge_mm(*g, t.shape.reach, 5.0, -1e-6), 0.003);
    HeightMap map({-5, -5}, {90, 45}, 0.25, 0.0);
    map.only(geometry::rectangle({-5, -5}, {60, 45}));
    EXPECT_THAT(map.run(*g, t.cutter).faults, testing::IsEmpty());
    EXPECT_NEAR(map.highest(geometry::rectangle({5.2, 0.2}, {59.8, 39.8})), -6.0, 1e-4);
  }
}

TEST(AreaPath, EntersAClosedPocketThatRunsOverTheEdgeFromOutside) {
  PathJob t = area_job(geometry::rectangle({0, 0}, {90, 40}), 6.0, 10.0);
  t.stock = geometry::rectangle({-20, -20}, {60, 60});
  t.cutter.centre_cutting = false;
  t.cutter.maximum_ramp_angle_rad = 0.0;  // no other way in
  for (const auto strategy : {StrategyKind::kContourParallel, StrategyKind::kBidirectional}) {
    t.strategy = strategy;
    Job job;
    const auto g = generate(t, job);
    ASSERT_TRUE(g) << g.error().message;
    EXPECT_THAT(rule_breaks(t, *g), testing::IsEmpty());
    EXPECT_LE(gouge_mm(*g, t.shape.reach, 5.0, -1e-6), 0.003);
    HeightMap map({-5, -5}, {100, 45}, 0.25, 0.0);
    map.only(geometry::rectangle({-5, -5}, {60, 45}));
    EXPECT_THAT(map.run(*g, t.cutter).faults, testing::IsEmpty());
    EXPECT_NEAR(map.highest(geometry::rectangle({5.2, 5.2}, {59.8, 34.8})), -6.0, 1e-4);
    // Beyond the edge it goes as far as it has to to leave the material, and 2 mm.
    for (std::size_t i = 0; i < g->path.size(); ++i) EXPECT_LE(g->path.x[i], 60.0 + 5.0 + 2.0 + 0.01);
  }
}

TEST(AreaPath, SaysWhichCutterWouldFit) {
  PathJob t = area_job(geometry::rectangle({0, 0}, {60, 9}), 6.0, 10.0);
  Job job;
  const auto g = generate(t, job);
  ASSERT_FALSE(g);
  EXPECT_EQ(g.error().code, "TPA-NO-FIT");
  EXPECT_THAT(g.error().hint, testing::HasSubstr("9"));
}

TEST(AreaPath, KeepsRoundWallsAsArcs) {
  PathJob t = area_job(geometry::disc({0, 0}, 30.0), 3.0, 10.0);
  Job job;
  const auto g = generate(t, job);
  ASSERT_TRUE(g);
  double length = 0.0;
  for (std::size_t i = 1; i < g->path.size(); ++i) {
    const double r = std::hypot(g->path.x[i] - g->path.cx[i], g->path.y[i] - g->path.cy[i]);
    const bool arc = g->path.kind[i] == MoveKind::kArcCcw || g->path.kind[i] == MoveKind::kArcCw;
    if (arc && std::abs(r - 25.0) < 0.003) length += model::move_length(g->path, i);
  }
  EXPECT_NEAR(length, 2.0 * kPi * 25.0, 0.05);
}

TEST(AreaPath, GivesTheSamePathTwice) {
  PathJob t = area_job(star(3), 4.0, 6.0);
  Job job;
  EXPECT_EQ(generate(t, job)->path, generate(t, job)->path);
}

}  // namespace
}  // namespace capstan::toolpath
