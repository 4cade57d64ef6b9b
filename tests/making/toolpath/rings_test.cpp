#include "planner/making/toolpath/region/area/rings.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "planner/making/toolpath/region/area/biarc.h"
#include "planner/making/toolpath/region/area/cutting_part.h"
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

/// Of a cutter's ends along all rings, what lies within 30 mm of the corner and is not cut, mm2.
double left_in_corner(const Region& centres, const std::vector<Ring>& all) {
  Region left = geometry::intersect(centres, geometry::disc({0, 0}, 30.0));
  for (const Ring& r : all) {
    for (const auto& loop : r.piece.loops) {
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

// The slot down to the last level is cut round once; the levels above it begin with the next ring.
TEST(RingsInwards, CutTheWallsRingOnceForAllLevels) {
  PathJob t = inwards();
  t.ramp_depth_mm = 20.0;
  const double once_mm = way_mm(t);
  t.ramp_depth_mm = 0.0;
  const double wall_mm = 2.0 * (50.0 + 30.0) - (8.0 - 2.0 * std::numbers::pi) * 1.0;  // corners of 1 mm
  EXPECT_NEAR(way_mm(t) - once_mm, 3.0 * wall_mm, 0.1 * wall_mm);
}

/// Unit direction of a move in the plane at its start (0) or its end (1).
Vec2 heading(const model::CutterPath& p, std::size_t i, double t) {
  const auto at = [&](double f) {
    const auto q = model::point_on_move(p, i, f);
    return Vec2{q.x, q.y};
  };
  const Vec2 d = t > 0.5 ? at(1.0) - at(1.0 - 1e-6) : at(1e-6) - at(0.0);
  return (1.0 / norm(d)) * d;
}

/// Ways from ring to ring of a closed pocket: cuts that come nearer to its boundary, or leave it, by half a
/// millimetre and more. Of each the largest angle to the moves before and behind it, degrees.
std::vector<double> turns_at_links(const PathJob& t, const GeneratedPath& g) {
  std::vector<double> out;
  const auto off = [&](std::size_t i) {
    const auto q = g.path.point(i);
    return geometry::distance_to_boundary(t.shape.area, {q.x, q.y});
  };
  const auto cut = [&](std::size_t i) {
    return g.path.role[i] == model::MoveRole::kCut && g.path.z[i] == g.path.z[i - 1];
  };
  for (std::size_t i = 2; i + 1 < g.path.size(); ++i) {
    if (!cut(i) || std::abs(off(i) - off(i - 1)) < 0.5) continue;
    double most = 0.0;
    if (cut(i - 1))
      most = std::acos(std::min(1.0, dot(heading(g.path, i - 1, 1.0), heading(g.path, i, 0.0))));
    if (cut(i + 1))
      most =
          std::max(most, std::acos(std::min(1.0, dot(heading(g.path, i, 1.0), heading(g.path, i + 1, 0.0)))));
    out.push_back(most * 180.0 / std::numbers::pi);
  }
  return out;
}

// Straight across to the next ring the cutter is in the solid with its whole width, and stops twice.
TEST(RingLinks, LeaveOneRingAndMeetTheNextInArcs) {
  for (const Region& area :
       {geometry::rounded_rectangle({0, 0}, {90, 60}, 6.0), geometry::disc({45, 30}, 28.0)}) {
    for (const bool climb : {true, false}) {
      PathJob t = area_job(area, 4.0, 10.0);
      t.radial_depth_mm = 4.95;
      t.climb = climb;
      Job job;
      const auto g = generate(t, job);
      ASSERT_TRUE(g) << g.error().message;
      EXPECT_THAT(rule_breaks(t, *g), testing::IsEmpty());
      const auto turns = turns_at_links(t, *g);
      EXPECT_GE(turns.size(), 6U);  // three rings outwards of the first, two arcs each
      EXPECT_THAT(turns, testing::Each(testing::Lt(2.0))) << area.loops.front().size() << climb;
    }
  }
}

TEST(RingLinks, InwardsBendAsWell) {
  const PathJob t = inwards();
  Job job;
  const auto g = generate(t, job);
  ASSERT_TRUE(g) << g.error().message;
  const auto turns = turns_at_links(t, *g);
  EXPECT_FALSE(turns.empty());
  EXPECT_THAT(turns, testing::Each(testing::Lt(2.0)));
}

// The outermost ring runs 7 mm beside the edge, a radius and 2 mm; kAirBeside of them is 0.2 mm.
TEST(Rings, RunBesideThePieceAtTheFeedOfAir) {
  PathJob t = area_job(geometry::rectangle({0, 0}, {90, 40}), 6.0, 10.0);
  t.stock = geometry::rectangle({-20, -20}, {60, 60});
  constexpr double kClear = 60.0 + 5.0 + 0.2;
  for (const auto operation :
       {model::TypeId::kBottomAndSideRoughMilling, model::TypeId::kBottomAndSideFinishMilling}) {
    t.operation = operation;
    Job job;
    const auto g = generate(t, job);
    ASSERT_TRUE(g) << g.error().message;
    double cut = 0.0, link = 0.0;
    for (std::size_t i = 1; i < g->path.size(); ++i) {
      if (g->path.z[i] > -1.0 || std::min(g->path.x[i - 1], g->path.x[i]) < kClear + 0.7) continue;
      const double length = model::move_length(g->path, i);
      if (g->path.role[i] == model::MoveRole::kLink) link += length;
      if (g->path.role[i] == model::MoveRole::kCut) cut += length;
    }
    EXPECT_GT(link, 20.0) << "of the 30 mm that the ring has there";
    EXPECT_LT(cut, 2.5 * std::numbers::pi) << "the quarter circles of 2.5 mm in and out, which are cuts";
    HeightMap map({-5, -5}, {100, 45}, 0.25, 0.0);
    map.only(geometry::rectangle({-5, -5}, {60, 45}));
    EXPECT_THAT(map.run(*g, t.cutter).faults, testing::IsEmpty());
    EXPECT_NEAR(map.highest(geometry::rectangle({5.2, 5.2}, {59.8, 34.8})), -6.0, 1e-4);
  }
}

TEST(CuttingPart, IsTheStretchThatTakesWhatIsLeft) {
  const Track round = track_of(geometry::rectangle({0, 0}, {40, 2}).loops.front());
  Region uncut = geometry::rectangle({10, 0.5}, {30, 1.5});
  const Track one = cutting_part(round, uncut, 4.0, Begun::kAnywhere);
  EXPECT_FALSE(one.closed);
  EXPECT_GT(length_of(one),
            12.0);  // 20 mm less the reach of the cutter's disc at both ends, and pieces of 1 mm
  EXPECT_LT(length_of(one), 30.0);
  EXPECT_LT(geometry::area(uncut), 1e-3);
  Region nothing = geometry::rectangle({10, 20}, {30, 21});
  EXPECT_TRUE(cutting_part(round, nothing, 4.0, Begun::kAnywhere).segments.empty());
  Region all = geometry::rectangle({-4, -4}, {44, 6});
  EXPECT_TRUE(cutting_part(round, all, 4.0, Begun::kAtStart).closed);
}

TEST(Biarc, LeavesAndMeetsAlongTheGivenDirections) {
  const Vec2 along{1.0, 0.0};
  const auto parallel = biarc({0, 0}, along, {5.0 * std::sqrt(3.0), 5.0}, along);  // leans by 60 degrees
  ASSERT_TRUE(parallel);
  ASSERT_EQ(parallel->segments.size(), 2U);
  const Segment& first = parallel->segments.front();
  EXPECT_NEAR(norm(first.centre), 5.0, 1e-9);
  EXPECT_EQ(first.bend, Bend::kCcw);
  EXPECT_EQ(parallel->segments.back().bend, Bend::kCw);
  const Vec2 lean = direction_at(parallel->start, first, 1.0);
  EXPECT_NEAR(lean.x, 0.5, 1e-9);
  const Vec2 onto = direction_at(first.to, parallel->segments.back(), 0.0);
  EXPECT_NEAR(onto.x, lean.x, 1e-9);
  EXPECT_NEAR(onto.y, lean.y, 1e-9);
  const Vec2 end = direction_at(first.to, parallel->segments.back(), 1.0);
  EXPECT_NEAR(end.x, 1.0, 1e-9);
  EXPECT_TRUE(biarc({0, 0}, along, {10.0, 4.0}, {0.8, 0.6}));
  EXPECT_FALSE(biarc({0, 0}, along, {0.0, 5.0}, along)) << "three quarters of a turn";
  EXPECT_FALSE(biarc({0, 0}, along, {-5.0, 1.0}, along)) << "back";
}

}  // namespace
}  // namespace capstan::toolpath
