#include "planner/making/toolpath/region/area/rings.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <utility>

#include "planner/making/toolpath/region/area/work_area.h"
#include "tests/making/toolpath/path_helpers.h"

namespace capstan::toolpath {
namespace {

using geometry::Region;
using geometry::Vec2;

constexpr double kRadius = 4.0;

/// A corner of this angle between sides of 100 mm; the third side is far from it.
Region corner(double angle_rad) {
  return geometry::clean({{{0, 0}, {100, 0}, {100 * std::cos(angle_rad), 100 * std::sin(angle_rad)}}});
}

/// Of a cutter's ends along all rings as they are followed, what lies within 30 mm of the corner and is not
/// cut, mm2.
double left_in_corner(const Region& centres, const std::vector<Ring>& all) {
  Region left = geometry::intersect(centres, geometry::disc({0, 0}, 30.0));
  for (const Ring& r : all) {
    for (const auto& loop : r.followed.loops) {
      std::vector<Vec2> line(loop.begin(), loop.end());
      line.push_back(loop.front());
      left = geometry::subtract(left, geometry::stroke(line, kRadius, true));
    }
  }
  return geometry::area(left);
}

TEST(Rings, AreAsWideApartAsACornerBears) {
  const double right = 0.5 * std::numbers::pi;
  const Region centres = geometry::rectangle({0, 0}, {100, 100});
  const double bears = kRadius * (1.0 + std::sin(0.5 * right));  // rings.h
  for (const double step : {0.98 * bears, 1.1 * bears}) {
    const auto all = rings(centres, step, kRadius);
    ASSERT_GE(all.size(), 2U);
    EXPECT_LT(left_in_corner(centres, all), 0.01) << step;
    const double apart = geometry::bounds(all[1].piece).lo.y - geometry::bounds(all[0].piece).lo.y;
    if (step < bears) {
      EXPECT_NEAR(apart, step, 0.01);
    } else {
      EXPECT_LT(apart, bears);
    }
  }
}

/// Two squares of 20 and 16 mm, joined by a passage of 10 mm, insets of 6 mm of which fall apart.
std::vector<Ring> two_limbs() {
  const Region centres = geometry::unite(
      geometry::unite(geometry::rectangle({0, 0}, {20, 20}), geometry::rectangle({50, 2}, {66, 18})),
      geometry::rectangle({15, 5}, {55, 15}));
  return rings(centres, 6.0, 6.0);
}

TEST(Turns, LeadOutwardsButForLimbsThatAreEnteredFromTheRingAround) {
  const auto all = two_limbs();
  ASSERT_EQ(all.size(), 3U);
  ASSERT_EQ(all[0].children.size(), 2U);
  const bool first = geometry::area(all[1].piece) > geometry::area(all[2].piece);
  const std::size_t large = first ? 1 : 2, small = first ? 2 : 1;
  const auto each_by_itself = turns(all, 0.0, [](const Ring&) { return false; });
  ASSERT_EQ(each_by_itself.size(), 3U);
  EXPECT_EQ(each_by_itself.back().ring, 0U);
  for (const Turn& t : each_by_itself) EXPECT_FALSE(t.inwards);
  const auto from_one = turns(all, 0.0, [](const Ring&) { return true; });
  ASSERT_EQ(from_one.size(), 3U);
  EXPECT_EQ(from_one[0].ring, large);
  EXPECT_FALSE(from_one[0].inwards);
  EXPECT_EQ(from_one[1].ring, 0U);
  EXPECT_EQ(from_one[2].ring, small);
  EXPECT_TRUE(from_one[2].inwards);
}

TEST(Turns, GoFromTheLoopRoundAnIslandIntoTheLimbBesideItBeforeTheOutside) {
  // Beside an island in the middle of a long area, both ends.
  const Region centres =
      geometry::subtract(geometry::rectangle({0, 0}, {60, 22}), geometry::rectangle({26, 6}, {34, 16}));
  const auto all = rings(centres, 6.0, 6.0);
  ASSERT_EQ(all.size(), 3U);
  const auto order = turns(all, 6.6, [](const Ring&) { return true; });
  ASSERT_EQ(order.size(), 4U);
  EXPECT_EQ(order[1].ring, 0U);
  EXPECT_EQ(order[1].loops, Loops::kIslands);
  EXPECT_TRUE(order[2].inwards);
  EXPECT_EQ(order[3].ring, 0U);
  EXPECT_EQ(order[3].loops, Loops::kOutside);
  // Not where the limb begins farther from the island.
  for (const Turn& t : turns(all, 5.9, [](const Ring&) { return true; })) EXPECT_EQ(t.loops, Loops::kAll);
}

TEST(Rings, AreNoFartherApartThanTheyClearInASharpCorner) {
  const Region centres = corner(std::numbers::pi / 9.0);  // 20 degrees: 1.17 of the radius
  const auto all = rings(centres, 1.6 * kRadius, kRadius);
  ASSERT_GE(all.size(), 2U);
  EXPECT_LT(left_in_corner(centres, all), 0.01);
}

TEST(Rings, LeaveNothingInTheMiddleOfTheLast) {
  // Half as wide as 1.5 radii: one inset of the whole step is none, and a strip would stay in the middle.
  const Region centres = geometry::rectangle({0, 0}, {60, 3.0 * kRadius});
  EXPECT_EQ(rings(centres, 1.6 * kRadius, kRadius).size(), 2U);
  EXPECT_EQ(rings(geometry::rectangle({0, 0}, {60, 1.9 * kRadius}), 1.6 * kRadius, kRadius).size(), 1U);
}

/// Length of the cuts of a job's path.
double way_mm(const PathJob& t) {
  Job job;
  const auto g = generate(t, job);
  EXPECT_TRUE(g) << (g ? "" : g.error().message);
  double out = 0.0;
  for (std::size_t i = 1; g && i < g->path.size(); ++i) {
    if (g->path.role[i] == model::MoveRole::kCut) out += model::move_length(g->path, i);
  }
  return out;
}

/// Directions of a move where it begins and where it ends, of length 1, in the plane.
std::pair<Vec2, Vec2> directions(const model::CutterPath& path, std::size_t i) {
  const Vec2 a = xy(path.point(i - 1)), b = xy(path.point(i)), c{path.cx[i], path.cy[i]};
  const auto unit = [](Vec2 v) { return (1.0 / norm(v)) * v; };
  if (path.kind[i] != model::MoveKind::kArcCw && path.kind[i] != model::MoveKind::kArcCcw)
    return {unit(b - a), unit(b - a)};
  const double sign = path.kind[i] == model::MoveKind::kArcCcw ? 1.0 : -1.0;
  const auto along = [&](Vec2 p) { return unit(sign * Vec2{-(p - c).y, (p - c).x}); };
  return {along(a), along(b)};
}

/// The largest change of direction between cuts that follow one another at the floor, degrees; nearer than
/// `from_mm` to the height of `middle_mm` none is counted.
double sharpest_turn_deg(const model::CutterPath& path, double floor_mm, double middle_mm, double from_mm) {
  double out = 0.0;
  bool follows = false;
  Vec2 before;
  for (std::size_t i = 1; i < path.size(); ++i) {
    const geometry::Vec3 a = path.point(i - 1), b = path.point(i);
    const bool cut = path.role[i] == model::MoveRole::kCut && std::abs(a.z - floor_mm) < 1e-9 &&
                     std::abs(b.z - floor_mm) < 1e-9;
    if (!cut) {
      follows = false;
      continue;
    }
    const auto [enters, leaves] = directions(path, i);
    if (follows && std::abs(a.y - middle_mm) > from_mm) {
      const double turn = std::atan2(std::abs(cross(before, enters)), dot(before, enters));
      out = std::max(out, turn * 180.0 / std::numbers::pi);
    }
    before = leaves;
    follows = true;
  }
  return out;
}

TEST(Rings, AreFollowedAndLeftForTheNextWithoutACorner) {
  PathJob t = area_job(geometry::rounded_rectangle({0, 0}, {80, 60}, 8.0), 5.0, 10.0);
  t.axial_depth_mm = 5.0;
  Job job;
  for (const double radial_mm : {3.0, 5.0, 6.5}) {
    t.radial_depth_mm = radial_mm;
    const auto g = generate(t, job);
    ASSERT_TRUE(g) << g.error().message;
    EXPECT_THAT(rule_breaks(t, *g), testing::IsEmpty());
    // A helix ends on the innermost ring, which is too narrow to be rounded.
    EXPECT_LT(sharpest_turn_deg(g->path, -5.0, 30.0, 1.5), 2.0) << radial_mm;
    HeightMap map({-5, -5}, {85, 65}, 0.25, 0.0);
    EXPECT_THAT(map.run(*g, t.cutter).faults, testing::IsEmpty());
    EXPECT_NEAR(map.highest(geometry::rounded_rectangle({0.3, 0.3}, {79.7, 59.7}, 7.7)), -5.0, 1e-4);
  }
}

TEST(Rings, AreFewerWhereTheyMayBeFartherApart) {
  PathJob t = area_job(geometry::rounded_rectangle({0, 0}, {60, 40}, 6.0), 5.0, 10.0);
  t.radial_depth_mm = 4.95;
  const double narrow_mm = way_mm(t);
  t.radial_depth_mm = 6.5;
  EXPECT_LT(way_mm(t), 0.95 * narrow_mm);
}

/// From the wall inwards, climbing, in four levels.
PathJob inwards() {
  PathJob t = area_job(geometry::rounded_rectangle({0, 0}, {60, 40}, 6.0), 16.0, 10.0);
  t.axial_depth_mm = 4.0;
  t.radial_depth_mm = 6.5;
  t.cutter.usable_length_mm = 30.0;
  t.rotation_ccw = false;
  t.climb = true;
  return t;
}

TEST(RingsInwards, RampAlongTheWallOnceForAllLevelsThatChipsAllow) {
  PathJob t = inwards();
  Job job;
  for (const auto& [depth_mm, ways] : {std::pair(20.0, 1), std::pair(9.0, 2), std::pair(0.0, 4)}) {
    t.ramp_depth_mm = depth_mm;
    const auto g = generate(t, job);
    ASSERT_TRUE(g) << g.error().message;
    EXPECT_THAT(rule_breaks(t, *g), testing::IsEmpty());
    int runs = 0;
    for (std::size_t i = 1; i < g->path.size(); ++i) {
      if (g->path.role[i] == model::MoveRole::kRamp && g->path.role[i - 1] != model::MoveRole::kRamp) ++runs;
    }
    EXPECT_EQ(runs, ways) << depth_mm;
    HeightMap map({-5, -5}, {65, 45}, 0.25, 0.0);
    EXPECT_THAT(map.run(*g, t.cutter).faults, testing::IsEmpty()) << depth_mm;
    EXPECT_NEAR(map.highest(geometry::rounded_rectangle({0.3, 0.3}, {59.7, 39.7}, 5.7)), -16.0, 1e-4);
  }
}

// The loads of a step are those of its depth: a ramp over a long ring falls by more than a level where its
// angle allows, and would cut all of that at once.
TEST(RingsInwards, RampThroughSeveralLevelsCutNoDeeperThanALevelAtOnce) {
  PathJob t = inwards();
  t.ramp_depth_mm = 20.0;
  Job job;
  for (const double level_mm : {2.0, 4.0, 8.0}) {
    t.axial_depth_mm = level_mm;
    const auto g = generate(t, job);
    ASSERT_TRUE(g) << g.error().message;
    HeightMap map({-5, -5}, {65, 45}, 0.25, 0.0);
    EXPECT_LE(map.run(*g, t.cutter).deepest_mm, level_mm + 1e-3);  // heights are in single precision
    EXPECT_NEAR(map.highest(geometry::rounded_rectangle({0.3, 0.3}, {59.7, 39.7}, 5.7)), -16.0, 1e-4);
  }
}

/// Length of the cuts along the wall's ring: between points on it.
double along_the_wall_mm(const PathJob& t, const Region& ring) {
  Job job;
  const auto g = generate(t, job);
  EXPECT_TRUE(g) << (g ? "" : g.error().message);
  double out = 0.0;
  const auto on = [&](std::size_t i) {
    return geometry::distance_to_boundary(ring, xy(g->path.point(i))) < 2e-3;
  };
  for (std::size_t i = 1; g && i < g->path.size(); ++i) {
    if (g->path.role[i] == model::MoveRole::kCut && on(i - 1) && on(i)) out += model::move_length(g->path, i);
  }
  return out;
}

// The slot down to the last level is cut round once; the levels above it begin with the next ring. The next
// ring is met past a corner, so that a piece of the wall's ring may be followed again in each of four levels.
TEST(RingsInwards, CutTheWallsRingOnceForAllLevels) {
  PathJob t = inwards();
  const Region ring = geometry::rounded_rectangle({5, 5}, {55, 35}, 1.0);
  const double wall_mm = 2.0 * (50.0 + 30.0) - (8.0 - 2.0 * std::numbers::pi) * 1.0;  // corners of 1 mm
  t.ramp_depth_mm = 20.0;
  EXPECT_LT(along_the_wall_mm(t, ring), wall_mm + 4.0 * 2.0 * t.radial_depth_mm);
  t.ramp_depth_mm = 0.0;
  EXPECT_GT(along_the_wall_mm(t, ring), 3.95 * wall_mm);
}

}  // namespace
}  // namespace capstan::toolpath
