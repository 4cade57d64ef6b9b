// A part that every shop makes, in the materials that every shop cuts: with the tools and passes of a shop.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "planner/model/nouns/all.h"
#include "planner/proof/verify/verify.h"
#include "tests/support/corpus.h"
#include "tests/support/shop.h"

namespace capstan::pipeline {
namespace {

model::Plan bracket_of(const std::string& material, bool carbide_drills = true) {
  Job job;
  Inputs in = load_shop({}, job).value();
  std::erase_if(in.library, [&](const model::Cutter& c) {
    return !carbide_drills && c.cutter_class == model::CutterClass::kTwistDrill &&
           c.substrate == model::Substrate::kCarbide;
  });
  in.material_name = material;
  const std::string path = capstan::testing::source_dir() + "/examples/bracket.p21";
  auto plan = read_plan(testing::slurp(path), "bracket.p21", job);
  return bind(plan.value(), in, {}, job).value();
}

const model::StepResult& step_of(const model::Plan& plan, const std::string& id) {
  const auto at = std::find_if(plan.steps.begin(), plan.steps.end(),
                               [&](const auto& s) { return model::step_id(plan, s) == id; });
  EXPECT_NE(at, plan.steps.end()) << id;
  return at == plan.steps.end() ? plan.steps.front() : *at;
}

TEST(Bracket, IsDrilledAndReamedWithCarbideWhereCarbideMakesTheHole) {
  for (const char* material : {"C45", "304", "GG25"}) {
    const model::Plan plan = bracket_of(material);
    EXPECT_TRUE(plan.unplanned.empty()) << material;
    EXPECT_EQ(step_of(plan, "MOUNTING HOLES[1] drill").cutter_id, "generic/drill_carbide/6.6") << material;
    EXPECT_EQ(step_of(plan, "CAP SCREW HOLE[2] drill").cutter_id, "generic/drill_carbide/6.6") << material;
    EXPECT_EQ(step_of(plan, "DOWEL HOLE 1 drill").cutter_id, "generic/drill_carbide/7.8") << material;
    EXPECT_EQ(step_of(plan, "DOWEL HOLE 1 ream").cutter_id, "generic/reamer_carbide_h7/8") << material;
    // The file states a bottom of 118 degrees, which has no tolerance: a point of 140 leaves rest there.
    EXPECT_EQ(step_of(plan, "M6 CORE drill").cutter_id, "generic/drill_carbide/5") << material;
    Job job;
    for (const auto& f : verify::check_plan(plan, job))
      EXPECT_EQ(f.severity, Severity::kNote) << material << ": " << f.message;
  }
}

/// Length of the straight cuts of a step, mm.
double cut_length(const model::StepResult& s) {
  double cut = 0.0;
  for (std::size_t i = 1; i < s.path->size(); ++i) {
    if (s.path->role[i] != model::MoveRole::kCut) continue;
    cut += std::hypot(s.path->x[i] - s.path->x[i - 1], s.path->y[i] - s.path->y[i - 1]);
  }
  return cut;
}

TEST(Bracket, IsFacedOnceInWholePasses) {
  // Nothing asks for a surface of the top face: its millimetre is one cut. The face is 80 mm wide: in
  // aluminium one pass of 120 mm and the radius of a cutter of 100 mm and a millimetre at either end; in
  // stainless steel the torque of the spindle makes two passes of a smaller cutter as quick.
  const model::Plan soft = bracket_of("EN AW-6061"), tough = bracket_of("304");
  const model::StepResult& one = step_of(soft, "TOP FACE plane_finish");
  EXPECT_EQ(one.cutter_id, "generic/face_mill_45/100");
  EXPECT_NEAR(cut_length(one), 120.0 + 2.0 * 51.0, 1e-6);
  const model::StepResult& two = step_of(tough, "TOP FACE plane_finish");
  EXPECT_EQ(two.cutter_id, "generic/face_mill_45/63");
  EXPECT_GT(cut_length(two), 2.0 * 120.0);
  EXPECT_LT(cut_length(two), 3.0 * 120.0 + 2.0 * 63.0);
  for (const model::Plan* plan : {&soft, &tough})
    for (const auto& s : plan->steps) EXPECT_NE(model::step_id(*plan, s), "TOP FACE plane_rough");
}

TEST(Bracket, IsSpottedByOneSmallPointAtTheSpeedOfTheCircleThatItCuts) {
  const model::Plan plan = bracket_of("304", false);  // carbide drills take no spot there
  std::string spot;
  for (const model::StepResult& s : plan.steps) {
    const auto* ws = plan.model.get<model::MachiningWorkingstep>(s.step);
    const auto* op = ws == nullptr ? nullptr : plan.model.get<model::CenterDrilling>(ws->its_operation);
    if (op == nullptr) continue;
    const model::Cutter* c = model::find_cutter(plan, s.cutter_id);
    ASSERT_NE(c, nullptr);
    if (spot.empty()) spot = s.cutter_id;
    EXPECT_EQ(s.cutter_id, spot) << "another tool for another hole";
    EXPECT_LE(c->cutting_diameter_mm, 6.0) << "the widest mark is below 5 mm";
    // A point of 90 degrees is twice as wide as it is deep. The speed is 0.8 of the card's, as of all drills.
    const double circle = 2.0 * op->cutting_depth.value();
    ASSERT_LT(circle, c->cutting_diameter_mm);
    const double vc = 3.14159265 * circle * s.spindle_rpm / 1000.0;
    EXPECT_NEAR(vc, 0.8 * plan.material.vc_carbide_m_min, 0.001 * vc) << s.cutter_id;
  }
  EXPECT_FALSE(spot.empty());
}

}  // namespace
}  // namespace capstan::pipeline
