#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "planner/making/toolpath/region/area/track.h"
#include "tests/making/toolpath/path_helpers.h"

namespace capstan::toolpath {
namespace {

using model::MoveKind;
using model::MoveRole;

/// A cone of 90 degrees from 30 to 20 mm over a through hole of 20 mm, by a chamfer mill as wide as the hole.
PathJob cone() {
  PathJob t;
  t.shape.kind = model::ShapeKind::kHole;
  t.shape.name = "SUNK";
  t.shape.diameter.nominal_mm = 30.0;
  t.shape.bottom_diameter_mm = 20.0;
  t.shape.depth_mm = 5.0;
  t.shape.area = t.shape.reach = geometry::disc({0, 0}, 15.0);
  t.feature_in_setup.origin = {20, 60, 0};
  t.operation = model::TypeId::kSideFinishMilling;
  t.cutter = endmill(20.0);
  t.cutter.cutter_class = model::CutterClass::kChamferMill;
  t.cutter.point_angle_rad = 0.5 * std::numbers::pi;
  t.cutter.tip_diameter_mm = 3.0;
  t.cutter.maximum_depth_of_cut_mm = 8.0;
  t.hole_below_mm = 20.0;
  t.security_z_mm = 30.0;
  t.retract_z_mm = 10.0;
  return t;
}

TEST(ConeOfHolePath, MeetsTheConeAndLeavesItOnHalfCirclesFromTheMiddle) {
  for (const bool climb : {true, false}) {
    PathJob t = cone();
    t.climb = climb;
    Job job;
    const auto g = generate(t, job);
    ASSERT_TRUE(g) << g.error().message;
    EXPECT_THAT(rule_breaks(t, *g), testing::IsEmpty());
    // The tip, 3 mm wide, half a millimetre below the foot: its axis is 10 - 1.5 - 0.5 mm from the hole's.
    constexpr double kRadius = 8.0;
    double last = 0.0, farthest = 0.0, turned = 0.0;
    bool first = true;
    for (std::size_t i = 1; i < g->path.size(); ++i) {
      if (g->path.role[i] != MoveRole::kCut) continue;
      EXPECT_NEAR(g->path.z[i], -5.5, 1e-9);
      const double x = g->path.x[i] - 20.0, y = g->path.y[i] - 60.0;
      const double from_x = g->path.x[i - 1] - 20.0, from_y = g->path.y[i - 1] - 60.0;
      if (first) {
        EXPECT_NEAR(std::hypot(from_x, from_y), 0.0, 0.01);
        first = false;
      }
      if (g->path.kind[i] == MoveKind::kLine) {
        EXPECT_LT(std::hypot(x - from_x, y - from_y), kSmallestArc) << "no straight way to the cone";
        continue;
      }
      last = std::hypot(x, y);
      farthest = std::max(farthest, last);
      if (std::min(last, std::hypot(from_x, from_y)) < 0.5 * kRadius) continue;  // the half circles
      const double cross = from_x * y - from_y * x, dot = from_x * x + from_y * y;
      double turn = std::atan2(cross, dot);
      const bool ccw = g->path.kind[i] == MoveKind::kArcCcw;
      if (ccw && turn < 0.0) turn += 2.0 * std::numbers::pi;
      if (!ccw && turn > 0.0) turn -= 2.0 * std::numbers::pi;
      turned += turn;
    }
    EXPECT_NEAR(last, 0.0, 0.01);
    EXPECT_NEAR(farthest, kRadius, 0.001);
    // All round, and a tenth of the cutter's diameter, 2 mm, past the beginning: 0.25 rad of 8 mm.
    EXPECT_NEAR(std::abs(turned), 2.0 * std::numbers::pi + 2.0 / kRadius, 0.01);
    EXPECT_EQ(turned > 0.0, climb) << "inside a hole a climbing right-hand cutter goes counterclockwise";
  }
}

}  // namespace
}  // namespace capstan::toolpath
