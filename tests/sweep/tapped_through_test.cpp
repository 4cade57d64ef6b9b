#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "planner/door/pipeline/pipeline.h"
#include "tests/removal/drawing.h"
#include "tests/support/shop.h"

// Threads deeper than a tap's own thread is long: its neck goes through the core.

namespace capstan::testing::sweep {
namespace {

/// M8 through so much of C45, as the generic centre taps it.
const pipeline::Checked& tapped_through_20() {
  static const pipeline::Checked made = [] {
    removal::Drawing d("TAPPED", {{0.0, 0.0, -20.0}, {40.0, 40.0, 0.0}});
    const auto at = d.placement({20, 20, 0});
    const auto core = d.hole_of("CORE", at, 20, d.length(6.8, 0.1, 0.1), d.through_bottom());
    d.thread("M8", at, 20, core, 8, 1.25);
    Job quiet;
    pipeline::ShopFiles files;
    files.machine = "generic_vmc";
    auto in = pipeline::load_shop(files, quiet);
    in->material_name = "C45";
    return *pipeline::bind_checked(*pipeline::read_plan(d.text(), "tapped.p21", quiet), *in, {}, quiet);
  }();
  return made;
}

/// Whether the flutes are found too short when the tap has another neck behind its thread.
bool flutes_are_short(double neck_diameter_mm) {
  model::Plan plan = tapped_through_20().plan;
  for (model::Cutter& c : plan.cutters)
    if (c.cutter_class == model::CutterClass::kTap) c.neck_diameter_mm = neck_diameter_mm;
  Job quiet;
  const auto findings = pipeline::checked(std::move(plan), quiet).findings;
  return std::any_of(findings.begin(), findings.end(),
                     [](const model::Finding& f) { return f.code == "CHK-FLUTE"; });
}

TEST(TappedThrough, TwoAndAHalfDiametersAreTapped) {
  const pipeline::Checked& made = tapped_through_20();
  ASSERT_TRUE(made.plan.unplanned.empty()) << made.plan.unplanned.front().reason;
  const auto tap =
      std::find_if(made.plan.cutters.begin(), made.plan.cutters.end(),
                   [](const model::Cutter& c) { return c.cutter_class == model::CutterClass::kTap; });
  ASSERT_NE(tap, made.plan.cutters.end());
  EXPECT_LT(tap->maximum_depth_of_cut_mm, 20.0) << "what follows is nothing new";
  for (const model::Finding& f : made.findings) EXPECT_NE(f.severity, Severity::kError) << f.message;
}

// The thread is 19 mm long (DIN 371); its end is 26 mm below the top.
TEST(TappedThrough, BehindItsThreadATapNeedsANeckThatPassesTheCore) {
  EXPECT_FALSE(flutes_are_short(6.1));
  EXPECT_TRUE(flutes_are_short(6.8)) << "as wide as the core";
  EXPECT_TRUE(flutes_are_short(0.0)) << "not stated";
}

}  // namespace
}  // namespace capstan::testing::sweep
