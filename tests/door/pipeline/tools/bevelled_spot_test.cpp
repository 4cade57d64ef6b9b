#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "planner/model/nouns/all.h"
#include "planner/proof/verify/verify.h"
#include "tests/door/pipeline/block.h"

// Edges of holes that the spot breaks as well, where drills are of HSS.

namespace capstan::pipeline {
namespace {

constexpr double kBevelMm = 0.3;

/// H1, 20 mm deep, of this diameter; without carbide drills.
model::Plan hole_plan(double diameter_mm, std::string& said) {
  Inputs in = block::shop();
  in.edge_break_mm = kBevelMm;
  std::erase_if(in.library, [](const model::Cutter& c) {
    return c.cutter_class == model::CutterClass::kTwistDrill && c.substrate == model::Substrate::kCarbide;
  });
  const auto p = block::bound(
      block::read("#61=TOLERANCED_LENGTH_MEASURE(" + std::to_string(diameter_mm) +
                  ",$);\n#62=CARTESIAN_POINT('',(0.,0.,-20.));\n#63=AXIS2_PLACEMENT_3D('',#62,#21,#22);\n"
                  "#64=PLANE('',#63);\n#65=ROUND_HOLE('H1',#4,(),#50,#64,#61,$,#58);\n"),
      in);
  said = p.said;
  return p.plan;
}

std::vector<std::string> names(const model::Plan& plan) {
  std::vector<std::string> out;
  for (const auto& s : plan.steps) out.push_back(model::step_id(plan, s));
  return out;
}

void expect_clean(const model::Plan& plan) {
  Job job;
  for (const auto& f : verify::check_plan(plan, job)) EXPECT_NE(f.severity, Severity::kError) << f.message;
}

TEST(BevelledSpot, BreaksTheEdgeWithoutAStepOfItsOwn) {
  std::string said;
  const model::Plan plan = hole_plan(8.0, said);
  ASSERT_EQ(names(plan), (std::vector<std::string>{"H1 centre", "H1 drill"})) << said;
  expect_clean(plan);
  const auto& spot = plan.steps.front();
  const model::Cutter* c = model::find_cutter(plan, spot.cutter_id);
  ASSERT_NE(c, nullptr);
  EXPECT_EQ(c->cutter_class, model::CutterClass::kSpotDrill);
  EXPECT_GE(c->cutting_diameter_mm, 8.0 + 2.0 * kBevelMm);
  // A cone of 90 degrees is as wide as it is deep: 8.6 mm wide at the top.
  EXPECT_NEAR(*std::min_element(spot.path->z.begin(), spot.path->z.end()), -(4.0 + kBevelMm), 1e-6);
}

TEST(BevelledSpot, IsFoundByTheCheckWhereItIsDeeperThanTheOperationSays) {
  std::string said;
  model::Plan plan = hole_plan(8.0, said);
  ASSERT_FALSE(plan.steps.empty()) << said;
  auto path = std::make_shared<model::CutterPath>(*plan.steps.front().path);
  for (double& z : path->z) {
    if (z < 0.0) z -= 0.4;
  }
  plan.steps.front().path = path;
  Job job;
  const auto findings = verify::check_plan(plan, job);
  std::string errors;
  for (const auto& f : findings) errors += f.severity == Severity::kError ? f.code + " " : "";
  EXPECT_NE(errors.find("CHK-GOUGE"), std::string::npos) << errors;
}

TEST(BevelledSpot, LeavesTheEdgeToItsOwnStepWhereNoSpotDrillIsAsWide) {
  std::string said;
  const model::Plan plan = hole_plan(20.0, said);  // the widest spot drill of the library is of 20 mm
  const auto all = names(plan);
  EXPECT_TRUE(std::any_of(all.begin(), all.end(), [](const std::string& n) {
    return n.find("break_edge") != std::string::npos;
  })) << said;
  expect_clean(plan);
}

}  // namespace
}  // namespace capstan::pipeline
