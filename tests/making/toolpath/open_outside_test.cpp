#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "planner/making/toolpath/link/path_writer.h"
#include "planner/making/toolpath/path_job.h"
#include "planner/making/toolpath/region/area/track.h"
#include "tests/making/toolpath/path_helpers.h"

namespace capstan::toolpath {
namespace {

using geometry::Region;
using geometry::Vec2;
using model::MoveRole;

/// Beside the line y = 0 from x = 0 to 100, below it; the raw piece reaches from x = -8 to 120 and 6 mm below
/// it.
PathJob beside(double diameter) {
  PathJob t = area_job(geometry::rectangle({-100, -100}, {200, 0}), 30.0, diameter);
  t.shape.kind = model::ShapeKind::kOutside;
  t.shape.open = true;
  t.shape.spine = {{0, 0}, {100, 0}};
  t.shape.reach = geometry::rectangle({-200, -200}, {300, 0});
  t.stock = geometry::rectangle({-8, -6}, {120, 60});
  t.operation = model::TypeId::kSideRoughMilling;
  t.axial_depth_mm = 10.0;
  t.radial_depth_mm = 4.0;
  return t;
}

TEST(OpenOutsidePath, RunsFromAirToAirAlongTheWholeRawPiece) {
  const PathJob t = beside(20.0);
  Job job;
  const auto g = generate(t, job);
  ASSERT_TRUE(g) << g.error().message;
  EXPECT_THAT(rule_breaks(t, *g), testing::IsEmpty());
  EXPECT_LE(gouge_mm(*g, t.shape.reach, 10.0, -1e-6), 0.003) << "nothing above the line is touched";
  HeightMap map({-40, -40}, {160, 70}, 0.5, 0.0);
  map.only(t.stock);
  EXPECT_THAT(map.run(*g, t.cutter).faults, testing::IsEmpty());
  EXPECT_NEAR(map.highest(geometry::rectangle({-7.5, -5.5}, {119.5, -0.5})), -30.0, 1e-4);
  EXPECT_NEAR(map.lowest_outside(geometry::rectangle({-200, -200}, {300, 0.0})), 0.0, 1e-4);
}

TEST(OpenOutsidePath, ClimbsWithTheWallOnItsRight) {
  for (const bool climb : {true, false}) {
    PathJob t = beside(20.0);
    t.climb = climb;
    Job job;
    const auto g = generate(t, job);
    ASSERT_TRUE(g) << g.error().message;
    for (std::size_t i = 1; i < g->path.size(); ++i) {
      if (g->path.role[i] != MoveRole::kCut) continue;
      // The wall lies above: on the right of who goes to smaller x.
      EXPECT_EQ(g->path.x[i] < g->path.x[i - 1], climb);
    }
  }
}

TEST(OpenOutsidePath, GoesRoundACornerOfItsLine) {
  PathJob t = beside(16.0);
  // Along y = 0, then up x = 100: taken away on the right.
  t.shape.spine = {{0, 0}, {100, 0}, {100, 50}};
  const Region kept = geometry::rectangle({-500, 0}, {100, 500});
  t.shape.area = geometry::subtract(geometry::rectangle({-100, -100}, {200, 150}), kept);
  t.shape.reach = geometry::subtract(geometry::rectangle({-200, -200}, {300, 250}), kept);
  t.stock = geometry::rectangle({0, -5}, {106, 60});
  Job job;
  const auto g = generate(t, job);
  ASSERT_TRUE(g) << g.error().message;
  EXPECT_LE(gouge_mm(*g, t.shape.reach, 8.0, -1e-6), 0.003);
  HeightMap map({-40, -40}, {160, 110}, 0.5, 0.0);
  map.only(t.stock);
  EXPECT_THAT(map.run(*g, t.cutter).faults, testing::IsEmpty());
  EXPECT_NEAR(map.highest(geometry::rectangle({0.5, -4.5}, {105.5, -0.5})), -30.0, 1e-4);
  EXPECT_NEAR(map.highest(geometry::rectangle({100.5, -4.5}, {105.5, 59.5})), -30.0, 1e-4);
}

/// The same line, 28 mm of raw piece below it, more than a cutter of 20 mm takes in one pass; roughed to 0.3
/// beside the wall and 0.2 over the floor.
PathJob wide_beside() {
  PathJob t = beside(20.0);
  t.stock = geometry::rectangle({-8, -28}, {120, 60});
  t.operation = model::TypeId::kBottomAndSideFinishMilling;
  t.axial_depth_mm = 30.0;
  t.left_on_side_mm = 0.3;
  t.left_on_bottom_mm = 0.2;
  return t;
}

TEST(OpenOutsidePath, FinishesTheWholeFloorThatRoughingLeft) {
  for (const double level : {30.0, 10.0}) {
    PathJob t = wide_beside();
    t.axial_depth_mm = level;
    Job job;
    const auto g = generate(t, job);
    ASSERT_TRUE(g) << g.error().message;
    EXPECT_THAT(rule_breaks(t, *g), testing::IsEmpty());
    EXPECT_LE(gouge_mm(*g, t.shape.reach, 10.0, -1e-6), 0.003) << "nothing above the line is touched";
    HeightMap map({-40, -60}, {160, 70}, 0.5, -29.8);
    map.only(t.stock);
    map.set_top(geometry::rectangle({-8, -0.3}, {120, 60}), 0.0);
    EXPECT_THAT(map.run(*g, t.cutter).faults, testing::IsEmpty());
    EXPECT_NEAR(map.highest(geometry::rectangle({-7.5, -27.5}, {119.5, -0.1})), -30.0, 1e-4);
    EXPECT_NEAR(map.lowest_outside(geometry::rectangle({-200, -200}, {300, 0.0})), 0.0, 1e-4);
  }
}

TEST(OpenOutsidePath, TakesTheWallsAllowanceAfterTheFloor) {
  const PathJob t = wide_beside();
  Job job;
  const auto g = generate(t, job);
  ASSERT_TRUE(g) << g.error().message;
  // At the wall once, in the end: before, the cutter keeps off what is left on it.
  bool at_wall = false;
  for (std::size_t i = 0; i < g->path.size(); ++i) {
    if (g->path.role[i] != MoveRole::kCut) continue;
    const bool here = g->path.y[i] > -10.3 + 0.01;
    EXPECT_TRUE(here || !at_wall) << "back to the floor after the wall";
    at_wall = here;
  }
  EXPECT_TRUE(at_wall);
}

TEST(OpenOutsidePath, GoesOnceAlongTheWallWhereNothingIsLeftOnTheFloor) {
  PathJob t = wide_beside();
  t.left_on_bottom_mm = 0.0;
  PathJob side = wide_beside();
  side.operation = model::TypeId::kSideFinishMilling;
  PathJob narrow = wide_beside();
  narrow.stock = geometry::rectangle({-8, -19}, {120, 60});  // one pass covers it
  for (const PathJob& task : {t, side, narrow}) {
    Job job;
    const auto g = generate(task, job);
    ASSERT_TRUE(g) << g.error().message;
    double lowest = 0.0;
    for (const double y : g->path.y) lowest = std::min(lowest, y);
    EXPECT_NEAR(lowest, -10.0, 1e-3);
  }
}

TEST(Tracks, HaveNoArcThatAControlDoesNotResolve) {
  // A corner of six tenths of a micrometre, in chords: what insets leave of a fillet as wide as the cutter.
  geometry::Loop loop = {{0, 0}, {40, 0}};
  geometry::append_arc(loop, {40, 0.0006}, {40, 0}, 1.5707963, 1e-5);
  loop.push_back({40.0006, 30});
  loop.push_back({0, 30});
  const Track t = track_of(loop);
  for (const Segment& s : t.segments) EXPECT_EQ(s.bend, Bend::kStraight);
  // One of a hundredth of a millimetre stays.
  loop = {{0, 0}, {40, 0}};
  geometry::append_arc(loop, {40, 0.01}, {40, 0}, 1.5707963, 1e-5);
  loop.push_back({40.01, 30});
  loop.push_back({0, 30});
  const Track arc = track_of(loop);
  EXPECT_TRUE(std::any_of(arc.segments.begin(), arc.segments.end(),
                          [](const Segment& s) { return s.bend == Bend::kCcw; }));
}

/// Round a block of 30 x 30 that stays, 10 deep, roughed to 0.3 beside it and 0.2 over the floor.
PathJob round_a_block(double diameter) {
  const Region raw = geometry::rectangle({0, 0}, {100, 80});
  PathJob t = area_job(raw, 10.0, diameter);
  t.shape.kind = model::ShapeKind::kOutside;
  t.shape.open = true;
  t.shape.islands.push_back({geometry::rectangle({20, 20}, {50, 50}), 0.0});
  t.shape.reach = geometry::rectangle({-100, -100}, {200, 180});
  t.stock = raw;
  t.operation = model::TypeId::kBottomAndSideFinishMilling;
  t.axial_depth_mm = 10.0;
  t.left_on_side_mm = 0.3;
  t.left_on_bottom_mm = 0.2;
  return t;
}

TEST(OutsidePath, FinishesTheWholeFloorThatRoughingLeft) {
  const PathJob t = round_a_block(16.0);
  Job job;
  const auto g = generate(t, job);
  ASSERT_TRUE(g) << g.error().message;
  EXPECT_THAT(rule_breaks(t, *g), testing::IsEmpty());
  HeightMap map({-40, -40}, {140, 120}, 0.5, -9.8);
  map.only(t.stock);
  map.set_top(geometry::rectangle({19.7, 19.7}, {50.3, 50.3}), 0.0);
  EXPECT_THAT(map.run(*g, t.cutter).faults, testing::IsEmpty());
  const Region floor = geometry::subtract(geometry::rectangle({0.5, 0.5}, {99.5, 79.5}),
                                          geometry::rectangle({19.5, 19.5}, {50.5, 50.5}));
  EXPECT_NEAR(map.highest(floor), -10.0, 1e-4);
  EXPECT_NEAR(map.highest(geometry::rectangle({20.5, 20.5}, {49.5, 49.5})), 0.0, 1e-4);
  const Region kept = geometry::rectangle({20, 20}, {50, 50});
  EXPECT_LE(gouge_mm(*g, geometry::subtract(t.shape.reach, kept), 8.0, -1e-6), 0.003);
}

TEST(OutsidePath, GoesOnceRoundTheWallWhereNothingIsLeftOnTheFloor) {
  PathJob t = round_a_block(16.0);
  Job job;
  const auto whole = generate(t, job);
  t.left_on_bottom_mm = 0.0;
  const auto wall = generate(t, job);
  ASSERT_TRUE(whole && wall);
  EXPECT_LT(wall->path.size(), whole->path.size());
}

TEST(PathWriter, MakesNoArcWhoseEndsAControlDoesNotTellApart) {
  PathWriter writer(beside(16.0));
  writer.over({10, 0});
  // Six tenths of a micrometre of a circle of 10 mm: a line. The other way round all of it but that: two
  // arcs.
  const double a = 6e-5;
  const geometry::Vec3 next{10.0 * std::cos(a), 10.0 * std::sin(a), writer.at().z};
  writer.arc(next, {0, 0}, false, MoveRole::kCut);
  writer.arc({10, 0, next.z}, {0, 0}, false, MoveRole::kCut);
  const auto g = writer.finish();
  std::vector<model::MoveKind> cuts;
  for (std::size_t i = 1; i < g.path.size(); ++i) {
    if (g.path.kind[i] != model::MoveKind::kRapid) cuts.push_back(g.path.kind[i]);
  }
  using enum model::MoveKind;
  EXPECT_THAT(cuts, testing::ElementsAre(kLine, kArcCcw, kArcCcw));
}

}  // namespace
}  // namespace capstan::toolpath
