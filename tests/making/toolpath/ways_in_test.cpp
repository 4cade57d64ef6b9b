#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "planner/making/toolpath/path_job.h"
#include "tests/making/toolpath/path_helpers.h"

// How often and how areas are entered: helices, bores, ramps, and from ring to ring.

namespace capstan::toolpath {
namespace {

using geometry::Region;

constexpr double kPi = std::numbers::pi;

/// Runs of ramping moves, and the steepest slope of them.
struct WaysIn {
  int runs = 0;
  double steepest_rad = 0.0, lowest_mm = 1e300;
  double most_air_mm = 0.0;  ///< of a run's begin over the floor that was cut before
};

WaysIn ways_in(const GeneratedPath& g, double raw_mm) {
  WaysIn out;
  const auto& p = g.path;
  double cut = raw_mm;  // lowest level so far
  for (std::size_t i = 1; i < p.size(); ++i) {
    const bool ramp = p.role[i] == model::MoveRole::kRamp;
    if (ramp && p.role[i - 1] != model::MoveRole::kRamp) {
      ++out.runs;
      if (cut < raw_mm) out.most_air_mm = std::max(out.most_air_mm, p.z[i - 1] - cut);
    }
    if (ramp) {
      const double fall = p.z[i - 1] - p.z[i];
      out.steepest_rad = std::max(out.steepest_rad, std::asin(fall / model::move_length(p, i)));
      out.lowest_mm = std::min(out.lowest_mm, p.z[i]);
    }
    if (p.role[i] == model::MoveRole::kCut) cut = std::min(cut, p.z[i]);
  }
  return out;
}

PathJob deep_pocket() {
  PathJob t = area_job(geometry::rounded_rectangle({0, 0}, {80, 50}, 8.0), 16.0, 10.0);
  t.axial_depth_mm = 4.0;
  t.cutter.maximum_ramp_angle_rad = 8.0 * kPi / 180.0;
  t.ramp_angle_rad = 5.0 * kPi / 180.0;
  t.cutter.usable_length_mm = 30.0;
  return t;
}

/// The pocket as it is cut: without a fault, down to its floor.
HeightMap cut_to_the_floor(const PathJob& t, const GeneratedPath& g) {
  HeightMap map({-5, -5}, {85, 55}, 0.25, 0.0);
  EXPECT_THAT(map.run(g, t.cutter).faults, testing::IsEmpty());
  EXPECT_NEAR(map.highest(geometry::offset(geometry::offset(t.shape.reach, -5.0), 4.7)), -16.0, 1e-4);
  return map;
}

TEST(WaysIntoAreas, EntersARegionOnceForAllItsLevels) {
  PathJob t = deep_pocket();
  t.ramp_depth_mm = 20.0;
  Job job;
  const auto g = generate(t, job);
  ASSERT_TRUE(g) << g.error().message;
  const WaysIn in = ways_in(*g, 0.0);
  EXPECT_EQ(in.runs, 1);
  EXPECT_NEAR(in.lowest_mm, -16.0, 1e-9);
  EXPECT_THAT(rule_breaks(t, *g), testing::IsEmpty());
  EXPECT_LE(gouge_mm(*g, t.shape.reach, 5.0, -1e-6), 0.003);
  cut_to_the_floor(t, *g);
}

TEST(WaysIntoAreas, EntersALimbFromTheRingAroundItWhereTheWayDownIsLonger) {
  // An island in the middle: rings fall apart into two ends, each with a ring of about 100 mm.
  PathJob t = deep_pocket();
  t.ramp_depth_mm = 20.0;
  const Region island = geometry::disc({40, 25}, 12.0);
  t.shape.islands.push_back({island, 0.0});
  t.shape.reach = geometry::subtract(t.shape.area, island);
  Job job;
  for (const auto& [level_mm, ways] : {std::pair{16.0, 1}, std::pair{4.0, 2}}) {
    t.axial_depth_mm = level_mm;  // of 5 degrees: 184 mm of way down a level, or 46
    const auto g = generate(t, job);
    ASSERT_TRUE(g) << g.error().message;
    EXPECT_EQ(ways_in(*g, 0.0).runs, ways) << level_mm;
    EXPECT_THAT(rule_breaks(t, *g), testing::IsEmpty());
    EXPECT_LE(gouge_mm(*g, t.shape.reach, 5.0, -1e-6), 0.003);
    cut_to_the_floor(t, *g);
  }
}

TEST(WaysIntoAreas, BoresNoDeeperThanChipsComeOutAndTheCutterReaches) {
  PathJob t = deep_pocket();
  t.ramp_depth_mm = 9.0;  // two levels of four
  Job job;
  auto g = generate(t, job);
  ASSERT_TRUE(g) << g.error().message;
  EXPECT_EQ(ways_in(*g, 0.0).runs, 2);
  t.ramp_depth_mm = 20.0;
  t.cutter.usable_length_mm = 13.0;  // three: what is above them is thinner only from there
  g = generate(t, job);
  ASSERT_TRUE(g) << g.error().message;
  EXPECT_EQ(ways_in(*g, 0.0).runs, 2);
}

TEST(WaysIntoAreas, BoresNotIntoAnIslandThatBeginsLowerDown) {
  PathJob t = deep_pocket();
  t.ramp_depth_mm = 20.0;
  const Region island = geometry::disc({40, 25}, 8.0);
  t.shape.islands.push_back({island, -8.0});
  t.shape.reach = geometry::subtract(t.shape.area, island);
  Job job;
  const auto g = generate(t, job);
  ASSERT_TRUE(g) << g.error().message;
  EXPECT_LE(gouge_mm(*g, t.shape.reach, 5.0, -8.0 - 1e-6), 0.003);
  const HeightMap map = cut_to_the_floor(t, *g);
  EXPECT_NEAR(map.highest(geometry::offset(island, -0.5)), -8.0, 1e-4);
}

TEST(WaysIntoAreas, RampsAsSteepAsTheJobSaysAndNoSteeperThanTheCutterMay) {
  PathJob t = deep_pocket();
  Job job;
  for (const double most_deg : {2.0, 5.0, 8.0}) {
    t.cutter.maximum_ramp_angle_rad = most_deg * kPi / 180.0;
    const auto g = generate(t, job);
    ASSERT_TRUE(g) << g.error().message;
    const WaysIn in = ways_in(*g, 0.0);
    const double asked = std::min(t.ramp_angle_rad, t.cutter.maximum_ramp_angle_rad);
    EXPECT_LE(in.steepest_rad, asked + 1e-9);
    EXPECT_GE(in.steepest_rad, 0.6 * asked);  // half turns are whole
  }
}

TEST(WaysIntoAreas, RampsBeginCloseOverAFloorThatWasCut) {
  PathJob t = deep_pocket();  // each level by itself
  Job job;
  const auto g = generate(t, job);
  ASSERT_TRUE(g) << g.error().message;
  const WaysIn in = ways_in(*g, 0.0);
  EXPECT_EQ(in.runs, 4);
  EXPECT_LE(in.most_air_mm, 0.2 + 1e-9);
}

}  // namespace
}  // namespace capstan::toolpath
