#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
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

}  // namespace
}  // namespace capstan::toolpath
