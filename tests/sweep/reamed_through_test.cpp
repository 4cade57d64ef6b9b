#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "planner/door/pipeline/pipeline.h"
#include "tests/removal/drawing.h"
#include "tests/support/shop.h"

// Through holes as deep as a reamer's flutes: the lead goes on below the piece, so the flutes end in the
// hole.

namespace capstan::testing::sweep {
namespace {

/// A through hole with H7's zone in C45; the shop's reamers of that size have this shank.
pipeline::Checked reamed(double diameter_mm, double upper_mm, double depth_mm, double shank_mm) {
  removal::Drawing d("REAMED", {{0.0, 0.0, -depth_mm}, {60.0, 60.0, 0.0}});
  d.hole_of("HOLE", d.placement({30, 30, 0}), depth_mm, d.length(diameter_mm, upper_mm, 0.0),
            d.through_bottom());
  Job quiet;
  pipeline::ShopFiles files;
  files.machine = "generic_vmc";
  auto in = pipeline::load_shop(files, quiet);
  in->material_name = "C45";
  for (model::Cutter& c : in->library)
    if (c.cutter_class == model::CutterClass::kReamer && c.cutting_diameter_mm == diameter_mm)
      c.shank_diameter_mm = shank_mm;
  return *pipeline::bind_checked(*pipeline::read_plan(d.text(), "reamed.p21", quiet), *in, {}, quiet);
}

/// How the hole is finished: the class of the cutter of its last step.
model::CutterClass finished_by(const pipeline::Checked& made) {
  const auto& last = made.plan.steps.back();
  return std::find_if(made.plan.cutters.begin(), made.plan.cutters.end(),
                      [&](const model::Cutter& c) { return c.id == last.cutter_id; })
      ->cutter_class;
}

/// That the hole is made whole, without an error, and finished by this kind of cutter.
void expect_finished_by(model::CutterClass kind, const pipeline::Checked& made) {
  ASSERT_TRUE(made.plan.unplanned.empty()) << made.plan.unplanned.front().reason;
  EXPECT_EQ(finished_by(made), kind);
  for (const model::Finding& f : made.findings) EXPECT_NE(f.severity, Severity::kError) << f.message;
}

// Flutes of 12 mm are 44 long (DIN 212), on a shank of 10.
TEST(ReamedThrough, IsAsDeepAsTheFlutesWhereTheShankIsThinner) {
  expect_finished_by(model::CutterClass::kReamer, reamed(12.0, 0.018, 44.0, 10.0));
}

// It goes 3 mm below the hole.
TEST(ReamedThrough, IsBoredWhereTheShankWouldRubInTheHole) {
  expect_finished_by(model::CutterClass::kBoringTool, reamed(12.0, 0.018, 41.1, 12.0));
}

TEST(ReamedThrough, WithFlutesThatStandOutIsReamedOnAnyShank) {
  expect_finished_by(model::CutterClass::kReamer, reamed(12.0, 0.018, 41.0, 12.0));
}

// A plan from elsewhere, whose shank goes 3 mm into the hole.
TEST(ReamedThrough, BehindFlutesByAShankAsWideIsFound) {
  model::Plan plan = reamed(12.0, 0.018, 44.0, 10.0).plan;
  for (model::Cutter& c : plan.cutters)
    if (c.cutter_class == model::CutterClass::kReamer) c.shank_diameter_mm = 12.0;
  Job quiet;
  const auto findings = pipeline::checked(std::move(plan), quiet).findings;
  EXPECT_TRUE(std::any_of(findings.begin(), findings.end(),
                          [](const model::Finding& f) { return f.code == "CHK-FLUTE"; }));
}

TEST(ReamedThrough, DeeperThanTheFlutesIsBored) {
  expect_finished_by(model::CutterClass::kBoringTool, reamed(12.0, 0.018, 45.0, 10.0));
}

}  // namespace
}  // namespace capstan::testing::sweep
