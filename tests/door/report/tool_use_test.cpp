#include "planner/door/report/tool_use.h"

#include <gtest/gtest.h>

#include <memory>

namespace capstan::report {
namespace {

model::StepResult step_to(double z_mm, double cutting_s, double life_min) {
  model::CutterPath path;
  path.start({0.0, 0.0, 10.0});
  path.line({0.0, 0.0, z_mm}, model::MoveRole::kPlunge);
  model::StepResult out;
  out.cutter_id = "em10";
  out.path = std::make_shared<model::CutterPath>(path);
  out.cutting_s = cutting_s;
  out.loads.tool_life_min = life_min;
  return out;
}

model::Cutter em10() {
  model::Cutter c;
  c.id = "em10";
  return c;
}

TEST(ToolUse, IsTheDeepestOfItsStepsAndTheSumOfTheirCutting) {
  model::Plan plan;
  plan.steps = {step_to(-5.0, 30.0, 0.0), step_to(-8.0, 60.0, 0.0), step_to(-50.0, 600.0, 0.0)};
  plan.steps[2].cutter_id = "another";
  const ToolUse use = use_of(plan, em10());
  EXPECT_EQ(use.least_z_mm, -8.0);
  EXPECT_DOUBLE_EQ(use.used_min, 1.5);
  EXPECT_EQ(use.life_min, 0.0);
}

TEST(ToolUse, CountsAgainstTheShortestLifeThatIsKnown) {
  model::Plan plan;
  model::Cutter c = em10();
  c.life_used_min = 2.0;
  plan.steps = {step_to(-5.0, 30.0, 20.0), step_to(-5.0, 30.0, 12.0)};
  EXPECT_EQ(use_of(plan, c).life_min, 12.0);
  c.life_min = 10.0;
  EXPECT_EQ(use_of(plan, c).life_min, 10.0);
  EXPECT_EQ(use_of(plan, c).used_before_min, 2.0);
}

TEST(ToolUse, OfAToolWithoutAPathHasNoLeastZ) {
  EXPECT_FALSE(use_of(model::Plan(), em10()).least_z_mm.has_value());
}

TEST(Coolant, IsNamedByItsStrongestWay) {
  model::StepResult s;
  EXPECT_EQ(coolant_text(s), "dry");
  s.mist = true;
  EXPECT_EQ(coolant_text(s), "mist");
  s.flood = true;
  EXPECT_EQ(coolant_text(s), "flood");
  s.through = true;
  EXPECT_EQ(coolant_text(s), "through");
}

}  // namespace
}  // namespace capstan::report
