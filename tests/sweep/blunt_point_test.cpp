#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

#include "planner/door/pipeline/pipeline.h"
#include "tests/removal/drawing.h"
#include "tests/support/shop.h"

// A drill blunter than a conical bottom makes the hole to its full diameter's depth; what stays in the point
// is told by planning and by the check.

namespace capstan::testing::sweep {
namespace {

/// A hole of 8 mm, 20 mm deep, in C45, whose bottom is a cone of this full angle.
pipeline::Checked pointed(double angle_deg) {
  removal::Drawing d("POINTED", {{0.0, 0.0, -40.0}, {40.0, 40.0, 0.0}});
  d.hole("HOLE", d.placement({20, 20, 0}), 20, 8, d.conical_bottom(angle_deg));
  Job quiet;
  pipeline::ShopFiles files;
  files.machine = "generic_vmc";
  auto in = pipeline::load_shop(files, quiet);
  in->material_name = "C45";
  return *pipeline::bind_checked(*pipeline::read_plan(d.text(), "pointed.p21", quiet), *in, {}, quiet);
}

const model::Finding* of_point(const pipeline::Checked& made) {
  const auto at = std::find_if(made.findings.begin(), made.findings.end(),
                               [](const model::Finding& f) { return f.code == "CHK-LEFT-POINT"; });
  return at == made.findings.end() ? nullptr : &*at;
}

double point_deg(const pipeline::Checked& made) {
  for (const model::Cutter& c : made.plan.cutters)
    if (c.cutter_class == model::CutterClass::kTwistDrill)
      return c.point_angle_rad * 180.0 / std::numbers::pi;
  return 0.0;
}

// Between cones of 118 and 140 degrees on 8 mm: 4 / tan 59 - 4 / tan 70 = 2.403 - 1.456 = 0.948 mm.
TEST(BluntPoint, MakesTheHoleAndTellsWhatStaysInItsPoint) {
  const pipeline::Checked made = pointed(118.0);
  ASSERT_TRUE(made.plan.unplanned.empty()) << made.plan.unplanned.front().reason;
  ASSERT_NEAR(point_deg(made), 140.0, 0.1);
  for (const auto& f : made.findings) EXPECT_NE(f.severity, Severity::kError) << f.code << " " << f.message;
  const model::Finding* f = of_point(made);
  ASSERT_NE(f, nullptr);
  EXPECT_EQ(f->severity, Severity::kNote);
  EXPECT_NE(f->message.find("stays rest material, 0.9"), std::string::npos) << f->message;
}

TEST(BluntPoint, OfTheBottomsOwnAngleLeavesNothing) {
  const pipeline::Checked made = pointed(140.0);
  ASSERT_TRUE(made.plan.unplanned.empty()) << made.plan.unplanned.front().reason;
  ASSERT_NEAR(point_deg(made), 140.0, 0.1);
  EXPECT_EQ(of_point(made), nullptr) << of_point(made)->message;
}

// 8 mm through 20 mm of C45 on a router that turns no slower than 6000 1/min, where carbide of 5 mm bears 62
// m/min as a spot and of 4.3 mm 81 as a drill: a pilot, and a mill after it. The spot is as small as the
// pilot's.
TEST(BluntPoint, ASpotBeforeAPilotIsNoWiderThanThePilotNeeds) {
  removal::Drawing d("THROUGH", {{0.0, 0.0, -20.0}, {40.0, 40.0, 0.0}});
  d.hole("HOLE", d.placement({20, 20, 0}), 20, 8, d.through_bottom());
  Job quiet;
  pipeline::ShopFiles files;
  files.machine = "small_router";
  auto in = pipeline::load_shop(files, quiet);
  in->material_name = "C45";
  const auto made =
      *pipeline::bind_checked(*pipeline::read_plan(d.text(), "through.p21", quiet), *in, {}, quiet);
  ASSERT_TRUE(made.plan.unplanned.empty()) << made.plan.unplanned.front().reason;
  double drill = 0.0, spot = 0.0;
  for (const model::Cutter& c : made.plan.cutters) {
    if (c.cutter_class == model::CutterClass::kTwistDrill) drill = c.cutting_diameter_mm;
    if (c.cutter_class == model::CutterClass::kSpotDrill) spot = c.cutting_diameter_mm;
  }
  ASSERT_GT(drill, 0.0);
  EXPECT_LT(drill, 8.0);
  EXPECT_LE(spot, drill);
}

// A sharper drill goes deeper than is drawn.
TEST(BluntPoint, NeverASharperOne) {
  const pipeline::Checked made = pointed(150.0);
  EXPECT_TRUE(made.plan.steps.empty() || point_deg(made) >= 150.0 - 3.0) << point_deg(made);
}

}  // namespace
}  // namespace capstan::testing::sweep
