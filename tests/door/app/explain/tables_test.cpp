#include "planner/door/service/explain/tables.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>

#include "planner/door/service/explain/explain.h"
#include "tests/door/app/plans.h"

namespace capstan::app {
namespace {

using service::explain;
using service::setups_text;
using service::tools_text;

using ::testing::ContainsRegex;
using ::testing::HasSubstr;

/// The drilled plate, with a path to 31 mm below zero, coolant, a life of the edge, and what holds it.
model::Plan held_plate() {
  model::Plan plan = testing::planned_plate();
  model::CutterPath path;
  path.start({0.0, 0.0, 5.0});
  path.line({0.0, 0.0, -31.0}, model::MoveRole::kDrill);
  model::StepResult& s = plan.steps.front();
  s.path = std::make_shared<model::CutterPath>(path);
  s.flood = true;
  s.vc_m_min = 30.16;
  s.loads.tool_life_min = 12.5;
  model::Cutter& c = plan.cutters.front();
  c.stick_out_mm = 45.0;
  c.life_used_min = 2.0;
  plan.setups.front().holding = {.id = "vise_125",
                                 .description = "machine vise",
                                 .source = {},
                                 .solids = {},
                                 .pickup = {},
                                 .pickup_text = "corner of the piece against the fixed jaw"};
  return plan;
}

TEST(ExplainTables, StepsHaveSpeedFeedPerToothAndCoolant) {
  const std::string text = explain(held_plate());
  EXPECT_THAT(text, ContainsRegex("ap mm +ae mm +vc m/min +1/min +fz mm +mm/min +coolant +time\n"));
  // 300 mm/min over 960 1/min and two teeth: 0.15625 mm, to four decimals.
  EXPECT_THAT(text, ContainsRegex("30 +- +30 +960 +0.1562 +300 +flood +6 s\n"));
}

TEST(ExplainTables, ToolsHaveNumberSizesLeastZAndTheLifeOfTheirEdge) {
  const std::string text = tools_text(held_plate());
  EXPECT_THAT(text, HasSubstr("Tools; a length offset H has the number of its tool\n  T  tool "));
  // Six seconds are 0.1 min, beside the 2 min before.
  EXPECT_THAT(text,
              ContainsRegex(
                  "\n  3  generic/drill/10 +twist drill +[a-z]+ +10 +- +2 .* 45 .* -31 +2.1 of 12.5 min\n"));
  EXPECT_THAT(explain(held_plate()), HasSubstr(text));
}

TEST(ExplainTables, SetupsSayHowThePieceLiesAndWhatHoldsIt) {
  const std::string text = setups_text(held_plate());
  EXPECT_THAT(text, ContainsRegex("\nSet-ups, in order\n  1  zero +G54"));
  EXPECT_THAT(text, ContainsRegex("lies +\\+Z up, \\+X to the right\n"));
  EXPECT_THAT(text, ContainsRegex("pick-up +corner of the piece against the fixed jaw\n"));
  EXPECT_THAT(text, ContainsRegex("held by +vise_125, machine vise\n"));
  EXPECT_THAT(text, ContainsRegex("security plane +Z 30\n"));
  EXPECT_THAT(text, ContainsRegex("steps +1, least Z -31\n"));
  EXPECT_THAT(explain(held_plate()), HasSubstr(text));
}

TEST(ExplainTables, SetupsNumberTheStepsThatTheyHave) {
  model::Plan plan = held_plate();
  plan.setups.push_back(plan.setups.front());
  plan.steps.resize(5, plan.steps.front());
  plan.steps[2].setup = 1;
  const std::string text = setups_text(plan);
  EXPECT_THAT(text, ContainsRegex("steps +1 to 2, 4 to 5, least Z -31\n"));
  EXPECT_THAT(text, ContainsRegex("steps +3, least Z -31\n"));
  EXPECT_THAT(text, ContainsRegex("  2  zero +G54.*\n +lies +\\+Z up, \\+X to the right; not turned\n"));
}

TEST(ExplainTables, SayThatNobodyStatesWhatHoldsThePiece) {
  EXPECT_THAT(setups_text(testing::planned_plate()),
              HasSubstr("not stated: fixtures and clamps are not checked"));
}

TEST(ExplainTables, AreLeftOutOfAPlanWithoutToolsOrSetups) {
  EXPECT_EQ(tools_text(model::Plan()), "");
  EXPECT_EQ(setups_text(model::Plan()), "");
}

}  // namespace
}  // namespace capstan::app
