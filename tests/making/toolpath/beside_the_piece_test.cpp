#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "planner/making/toolpath/defaults.h"
#include "planner/making/toolpath/path_job.h"
#include "tests/making/toolpath/path_helpers.h"

// Ways beside the raw piece, where nothing is cut.

namespace capstan::toolpath {
namespace {

using model::StrategyKind;

// The outermost ring runs 7 mm beside the edge, a radius and 2 mm; 0.2 mm of them are kept as air.
TEST(BesideThePiece, NoRingIsFollowedBesideThePieceAtTheFeedOfACut) {
  PathJob t = area_job(geometry::rectangle({0, 0}, {90, 40}), 6.0, 10.0);
  t.stock = geometry::rectangle({-20, -20}, {60, 60});
  constexpr double kClear = 60.0 + 5.0 + kAirBeyond;
  for (const auto operation :
       {model::TypeId::kBottomAndSideRoughMilling, model::TypeId::kBottomAndSideFinishMilling}) {
    t.operation = operation;
    Job job;
    const auto g = generate(t, job);
    ASSERT_TRUE(g) << g.error().message;
    double cut = 0.0;
    for (std::size_t i = 1; i < g->path.size(); ++i) {
      const bool beside = g->path.z[i] < -1.0 && std::min(g->path.x[i - 1], g->path.x[i]) >= kClear + 0.7;
      if (beside && g->path.role[i] == model::MoveRole::kCut) cut += model::move_length(g->path, i);
    }
    EXPECT_LT(cut, 0.5 * t.cutter.cutting_diameter_mm);
    HeightMap map({-5, -5}, {100, 45}, 0.25, 0.0);
    map.only(geometry::rectangle({-5, -5}, {60, 45}));
    EXPECT_THAT(map.run(*g, t.cutter).faults, testing::IsEmpty());
    EXPECT_NEAR(map.highest(geometry::rectangle({5.2, 5.2}, {59.8, 34.8})), -6.0, 1e-4);
  }
}

// A strip 12 mm wide along the right side of the piece, open there and at both ends; 0.3 mm stay on its wall.
TEST(BesideThePiece, PassesOfAStepMeetThePieceAndRunAlongItsWallOnce) {
  for (const double step_mm : {12.0, 6.0, 2.5}) {
    PathJob t = area_job(geometry::rectangle({58, 0}, {70, 50}), 6.0, 25.0);
    t.shape.kind = model::ShapeKind::kStep;
    t.shape.reach = geometry::rectangle({58, -60}, {130, 110});
    t.shape.open = true;
    t.stock = geometry::rectangle({0, 0}, {70, 50});
    t.operation = model::TypeId::kBottomAndSideRoughMilling;
    t.strategy = StrategyKind::kBidirectional;
    t.allowance_side_mm = 0.3;
    t.radial_depth_mm = step_mm;
    t.feed_direction = geometry::Vec2{0.0, 1.0};
    Job job;
    const auto g = generate(t, job);
    ASSERT_TRUE(g) << g.error().message;
    std::vector<double> at;  // x of the passes, in their order
    for (std::size_t i = 1; i < g->path.size(); ++i) {
      if (g->path.z[i] > -1.0 || std::abs(g->path.y[i] - g->path.y[i - 1]) < 40.0) continue;
      EXPECT_LT(g->path.x[i], 70.0 + 12.5) << "a pass through air";
      at.push_back(g->path.x[i]);
    }
    std::sort(at.begin(), at.end());
    EXPECT_EQ(at.size(), static_cast<std::size_t>(std::ceil(11.7 / step_mm))) << step_mm;
    ASSERT_FALSE(at.empty());
    EXPECT_NEAR(at.front(), 58.0 + 0.3 + 12.5, 1e-3);
    for (std::size_t i = 1; i < at.size(); ++i) EXPECT_LE(at[i] - at[i - 1], step_mm + 1e-6);
    EXPECT_LE(70.0 - (at.back() - 12.5), step_mm + 1e-6) << "the first pass cuts no more than a step";
    HeightMap map({50, -5}, {75, 55}, 0.25, 0.0);
    map.only(t.stock);
    EXPECT_THAT(map.run(*g, t.cutter).faults, testing::IsEmpty());
    EXPECT_NEAR(map.highest(geometry::rectangle({58.6, 0.2}, {69.8, 49.8})), -6.0, 1e-4);
  }
}

/// Length of the moves of a role at the depth of a level, mm.
double length_at(const GeneratedPath& g, double z_mm, model::MoveRole role) {
  double out = 0.0;
  for (std::size_t i = 1; i < g.path.size(); ++i)
    if (std::abs(g.path.z[i] - z_mm) < 1e-6 && g.path.role[i] == role) out += model::move_length(g.path, i);
  return out;
}

// A pocket whose floor is made: rings over it would be air. 40 x 30 mm less the mill, its centre round the
// wall 30 x 20; with a tenth of the diameter and two arcs it is a little more.
TEST(BesideThePiece, ALastPassGoesRoundTheWallsAloneWhereTheFloorIsMade) {
  PathJob t = area_job(geometry::rectangle({0, 0}, {40, 30}), 6.0, 10.0);
  t.operation = model::TypeId::kBottomAndSideFinishMilling;
  t.left_on_side_mm = 0.1;
  t.floor_made = true;
  const auto cut = [&](double left_on_floor_mm) {
    t.left_on_bottom_mm = left_on_floor_mm;
    Job job;
    const auto g = generate(t, job);
    EXPECT_TRUE(g);
    return g ? length_at(*g, -6.0, model::MoveRole::kCut) : 0.0;
  };
  EXPECT_GT(cut(0.2), 100.0 + 20.0);
  EXPECT_GT(cut(0.0), 100.0);
  EXPECT_LT(cut(0.0), 100.0 + 20.0);
  // What roughing left without an allowance is not finished.
  t.floor_made = false;
  EXPECT_GT(cut(0.0), 100.0 + 20.0);
}

// The edges of a mill of 45 degrees reach as much farther out as they cut deep: 3 mm here.
TEST(BesideThePiece, AFaceMillWhoseEdgesLeanComesDownClearOfThePiece) {
  PathJob t = area_job(geometry::rectangle({0, 0}, {160, 40}), 3.0, 50.0);
  t.shape.kind = model::ShapeKind::kFace;
  t.shape.open = true;
  t.shape.reach = geometry::offset_sharp(t.shape.area, 100.0);
  t.stock = t.shape.area;
  t.operation = model::TypeId::kPlaneRoughMilling;
  t.strategy = StrategyKind::kBidirectional;
  t.cutter.cutter_class = model::CutterClass::kFacemill;
  t.cutter.lead_angle_rad = std::numbers::pi / 4.0;
  t.cutter.maximum_depth_of_cut_mm = 5.0;
  Job job;
  const auto g = generate(t, job);
  ASSERT_TRUE(g) << g.error().message;
  double begins = 1e300;
  for (std::size_t i = 1; i < g->path.size(); ++i) {
    if (g->path.z[i] < -2.9) begins = std::min({begins, g->path.x[i], 160.0 - g->path.x[i]});
  }
  EXPECT_LE(begins, -(25.0 + 3.0) + 1e-6);
}

// 100 mm by passes of 45 mm at most: three of 33 mm and a tenth of a radius, not 45, 45 and 10.
TEST(BesideThePiece, PassesOverAFaceAreEquallyWideUnlessTheirDistanceIsGiven) {
  for (const bool given : {false, true}) {
    PathJob t = area_job(geometry::rectangle({0, 0}, {160, 100}), 2.0, 50.0);
    t.shape.kind = model::ShapeKind::kFace;
    t.shape.open = true;
    t.shape.reach = geometry::offset_sharp(t.shape.area, 100.0);
    t.stock = t.shape.area;
    t.operation = model::TypeId::kPlaneFinishMilling;
    t.strategy = StrategyKind::kBidirectional;
    t.radial_depth_mm = given ? 0.0 : 45.0;
    if (given) t.overlap = 0.1;
    Job job;
    const auto g = generate(t, job);
    ASSERT_TRUE(g) << g.error().message;
    std::vector<double> at;
    for (std::size_t i = 1; i < g->path.size(); ++i) {
      if (g->path.role[i] == model::MoveRole::kCut) at.push_back(g->path.y[i]);
    }
    ASSERT_EQ(at.size(), 3U);
    const double apart = given ? 45.0 : (100.0 + 0.1 * 25.0) / 3.0;
    EXPECT_NEAR(at[0] + 25.0, apart, 1e-6) << "width of the first";
    EXPECT_NEAR(at[1] - at[0], apart, 1e-6);
    EXPECT_NEAR(at[2] - at[1], apart, 1e-6);
    EXPECT_GE(at[2] + 25.0, 100.0);
  }
}

// Passes of a mill of 50 mm over 160 x 80 mm in two levels, to and fro and one way. The rear of the cutter
// runs out at the feed of the cut on the last level alone, where it leaves the pattern that stays.
TEST(BesideThePiece, AFaceIsMetFromALittleMoreThanTheRadiusAndLeftAtTheFeedOfAir) {
  for (const auto strategy : {StrategyKind::kBidirectional, StrategyKind::kUnidirectional}) {
    for (const double left_mm : {0.0, 0.3}) {
      PathJob t = area_job(geometry::rectangle({0, 0}, {160, 80}), 4.0, 50.0);
      t.shape.kind = model::ShapeKind::kFace;
      t.shape.open = true;
      t.shape.reach = geometry::offset_sharp(t.shape.area, 100.0);
      t.stock = t.shape.area;
      t.operation = model::TypeId::kPlaneRoughMilling;
      t.strategy = strategy;
      t.axial_depth_mm = 2.0;
      t.radial_depth_mm = 35.0;
      t.allowance_bottom_mm = left_mm;
      Job job;
      const auto g = generate(t, job);
      ASSERT_TRUE(g) << g.error().message;
      EXPECT_THAT(rule_breaks(t, *g), testing::IsEmpty());
      HeightMap map({-5, -5}, {165, 85}, 0.5, 0.0);
      map.only(t.stock);
      EXPECT_THAT(map.run(*g, t.cutter).faults, testing::IsEmpty());
      EXPECT_NEAR(map.highest(geometry::rectangle({0.5, 0.5}, {159.5, 79.5})), left_mm - 4.0, 1e-4);
      const double last_z = left_mm - 4.0;
      double cut = 0.0;
      std::size_t passes = 0;
      for (std::size_t i = 1; i < g->path.size(); ++i) {
        if (g->path.role[i] != model::MoveRole::kCut) continue;
        EXPECT_EQ(g->path.y[i], g->path.y[i - 1]) << "ways between passes are no cuts";
        for (const std::size_t k : {i - 1, i}) {
          EXPECT_GE(g->path.x[k], -25.0 - kAirBeyond - 1e-9);
          EXPECT_LE(g->path.x[k], 185.0 + kAirBeyond + 1e-9);
        }
        const bool pattern = left_mm == 0.0 && g->path.z[i] < last_z + 1e-6;
        cut = std::max(cut, model::move_length(g->path, i) - (pattern ? 25.0 : 0.0));
        ++passes;
      }
      EXPECT_EQ(passes, 6U) << "80 mm in three of 35 mm at most, twice";
      EXPECT_LE(cut, 160.0 + 25.0 + 2.0 * kAirBeyond + 1e-9);
    }
  }
}

}  // namespace
}  // namespace capstan::toolpath
