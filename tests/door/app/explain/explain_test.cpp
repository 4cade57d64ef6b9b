#include "planner/door/service/explain/explain.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "planner/files/exchange/exchange.h"
#include "planner/ground/base/number.h"
#include "planner/model/plan/corner_rest.h"
#include "planner/physics/mechanics/force/force_law.h"
#include "tests/door/app/plans.h"

namespace capstan::app {
namespace {

using service::explain;

using ::testing::ContainsRegex;
using ::testing::HasSubstr;
using ::testing::Not;

TEST(Explain, OverviewNamesInputsDefaultsAndEachStep) {
  const std::string text = explain(testing::planned_plate());
  EXPECT_THAT(text, HasSubstr("generic_vmc  built-in default"));
  EXPECT_THAT(text, HasSubstr("wrought_aluminium"));
  EXPECT_THAT(text, HasSubstr("DRILL IT"));
  EXPECT_THAT(text, HasSubstr("10 mm twist drill"));
  EXPECT_THAT(text, HasSubstr("960"));
}

TEST(Explain, OverviewSaysWhatIsNotPlannedAndWhy) {
  auto plan = testing::planned_plate();
  plan.unplanned.push_back({plan.model.all(model::TypeId::kRoundHole).front(), "no drill reaches 300 mm"});
  EXPECT_THAT(explain(plan), HasSubstr("#17 ROUND_HOLE 'HOLE': no drill reaches 300 mm"));
}

// A proposed step with nothing to cut is taken out of the workplan; its nouns stay in the model.
TEST(Explain, AStepThatPlanningTookOutIsNotListedAsNotPlanned) {
  auto plan = testing::planned_plate();
  const auto added = plan.model.add(plan.model.at<model::MachiningWorkingstep>(plan.steps.front().step));
  const model::AnyRef step(added);
  plan.model.at<model::MachiningWorkingstep>(step).its_id = "REST";
  EXPECT_THAT(explain(plan), HasSubstr("Workingsteps not planned\n  'REST'"));  // the file's own: told
  plan.ledger.bind(step, "its_operation", model::Binder::kRule, {"freeform.rest", "a rest is roughed", "own"},
                   {}, {});
  EXPECT_THAT(explain(plan), Not(HasSubstr("REST")));
}

TEST(Explain, OverviewSaysWhichCornersKeepRestMaterial) {
  auto plan = testing::planned_plate();
  plan.provenance.push_back(model::provenance_of(model::CornerRest{"POCKET", 0.2, 1.5, "no mill enters"}));
  EXPECT_THAT(explain(plan),
              HasSubstr("rest      a radius of 1.5 mm stays in the corners of 'POCKET' in place "
                        "of 0.2 mm: no mill enters"));
}

TEST(Explain, AStepNamesRuleSourceAndActiveConstraint) {
  const auto text = explain(testing::planned_plate(), "DRILL IT");
  ASSERT_TRUE(text) << to_text(text.error());
  EXPECT_THAT(*text, HasSubstr("bound by rule"));
  EXPECT_THAT(*text,
              HasSubstr("a hole of IT11 or coarser is drilled [hole.drill.it11; Kalpakjian, table 16.4]"));
  EXPECT_THAT(*text, HasSubstr("not ream: IT11 does not ask for it"));
  EXPECT_THAT(*text, HasSubstr("not generic/drill/9.8: 0.2 mm too small"));
  EXPECT_THAT(*text, HasSubstr("feedrate = 300 mm/min"));
  EXPECT_THAT(
      *text,
      HasSubstr(
          "limited by spindle torque: 11.9 of 12 Nm; 1 % more of it would save 0.5 % of the cutting time"));
  EXPECT_THAT(*text, HasSubstr("diameter = 10 mm  (in the file)"));
}

TEST(Explain, LimitsAreToldWithTheirSpeedAndTheSecondsTheyCost) {
  auto plan = testing::planned_plate();
  auto& step = plan.steps.front();
  ASSERT_FALSE(step.active.empty());
  step.active.front().at_rpm = 2000.0;
  step.active.front().saves_s = 4.0;
  step.held_by = {{"peak_force", 500.0, "N", 0.62, 2.5}, {"axis_acceleration", 0.0, "", 0.38, 0.0}};
  step.loads.mean_force = {100.0, -40.0, 12.0};
  const auto text = explain(plan, "DRILL IT");
  ASSERT_TRUE(text);
  EXPECT_THAT(*text,
              HasSubstr("limited by spindle torque at 2,000 rpm: 11.9 of 12 Nm; 10 % more would save 4 s"));
  EXPECT_THAT(*text,
              HasSubstr("62 % of the time  held by peak force         500 N  10 % more would save 2.5 s"));
  EXPECT_THAT(*text, HasSubstr("38 % of the time  held by axis acceleration"));
  EXPECT_THAT(*text, HasSubstr("100, -40, 12 N"));
}

// A load meter shows the expected load; limits are held against that times the margin, whose factors stand
// there.
TEST(Explain, LoadsAreToldAsExpectedAndWithTheChainOfFactorsUpToTheLimit) {
  auto plan = testing::planned_plate();
  auto& step = plan.steps.front();
  plan.provenance.push_back({"margin", "careful", "--margin"});
  plan.machine.abilities.feed_override_max = 1.2;
  // Kienzle: forces go with the feed's power of 1 - mc.
  const mechanics::ForceMargin margin{.spread = mechanics::kienzle_margin(plan.material).spread,
                                      .override_up = std::pow(1.2, 1.0 - plan.material.mc),
                                      .deviations = mechanics::margin_policy("careful")->deviations};
  step.loads.force_margin = margin.factor();
  step.loads.peak_force_n = 1000.0 * margin.factor();
  step.loads.power_w = 500.0 * margin.factor();
  const auto text = explain(plan, "DRILL IT");
  ASSERT_TRUE(text) << to_text(text.error());
  EXPECT_THAT(*text, ContainsRegex("expected_force +1000 N"));
  EXPECT_THAT(*text, ContainsRegex("expected_power +500 W"));
  EXPECT_THAT(*text, HasSubstr("margin careful, exp(1.64 sqrt(ln^2 " + trimmed(margin.spread, 3) +
                               " + ln^2 1.3 + ln^2 " + trimmed(margin.override_up, 3) +
                               ")) of the spread of the coefficients"));
}

// Where cases gave another spread than the card's its factors are not told: they would be false.
TEST(Explain, FactorsOfAMarginThatAnotherCardGaveAreNotTold) {
  for (const double of_spread : {0.9, 1.1}) {
    auto plan = testing::planned_plate();
    plan.machine.abilities.feed_override_max = 1.2;
    const mechanics::ForceMargin margin{.spread = of_spread * mechanics::kienzle_margin(plan.material).spread,
                                        .override_up = std::pow(1.2, 1.0 - plan.material.mc)};
    plan.steps.front().loads.force_margin = margin.factor();
    const auto text = explain(plan, "DRILL IT");
    ASSERT_TRUE(text) << to_text(text.error());
    EXPECT_THAT(*text, HasSubstr("spread, wear and override together, of another card than the plan's"));
    EXPECT_THAT(*text, Not(HasSubstr("ln^2")));
  }
}

TEST(Explain, ALimitThatNobodyStatesIsNotTold) {
  auto plan = testing::planned_plate();
  auto& step = plan.steps.front();
  step.active.push_back({"peak_force", 100.0, std::numeric_limits<double>::infinity(), "N", 0.0});
  step.active.push_back({"wall_error", 0.01, 1e12, "mm", 0.0});
  step.held_by = {{"least_feed", 1e12, "mm/min", 1.0, 0.0}};
  const auto text = explain(plan, "DRILL IT");
  ASSERT_TRUE(text);
  EXPECT_THAT(*text, HasSubstr("limited by spindle torque"));
  EXPECT_THAT(*text, Not(HasSubstr("limited by peak force")));
  EXPECT_THAT(*text, Not(HasSubstr("limited by wall error")));
  EXPECT_THAT(*text, HasSubstr("held by least feed"));
  EXPECT_THAT(*text, Not(HasSubstr("1000000000000")));
}

TEST(Explain, AStepIsFoundByItsNumberToo) {
  EXPECT_EQ(*explain(testing::planned_plate(), "1"), *explain(testing::planned_plate(), "DRILL IT"));
}

TEST(Explain, AnAttributeTellsTheWholeChain) {
  const auto text = explain(testing::planned_plate(), "DRILL IT", "feedrate");
  ASSERT_TRUE(text) << to_text(text.error());
  const auto feed = text->find("feedrate of #45 MILLING_TECHNOLOGY = 300 mm/min");
  const auto tool = text->find("depends on its_tool of #20 DRILLING 'DRILL'");
  const auto chain = text->find("depends on its_operation of #10");
  ASSERT_NE(feed, std::string::npos) << *text;
  ASSERT_NE(tool, std::string::npos) << *text;
  ASSERT_NE(chain, std::string::npos) << *text;
  EXPECT_LT(feed, tool);
  EXPECT_LT(tool, chain);
}

TEST(Explain, ACircleOfDependenciesEnds) {
  auto plan = testing::planned_plate();
  const auto op = plan.model.all(model::TypeId::kDrilling).front();
  const auto technology = plan.model.all(model::TypeId::kMillingTechnology).front();
  plan.ledger.find(op, "its_tool")->depends_on = {{technology, "feedrate"}};
  const auto text = explain(plan, "1", "feedrate");
  ASSERT_TRUE(text);
  EXPECT_THAT(*text, HasSubstr("see above"));
}

TEST(Explain, NamesWhatThereIsWhenAskedForSomethingElse) {
  const auto step = explain(testing::planned_plate(), "POLISH");
  ASSERT_FALSE(step);
  EXPECT_EQ(step.error().code, "EXP-STEP");
  EXPECT_EQ(step.error().expected, "'DRILL IT'");
  const auto attribute = explain(testing::planned_plate(), "1", "colour");
  ASSERT_FALSE(attribute);
  EXPECT_EQ(attribute.error().code, "EXP-ATTRIBUTE");
  EXPECT_THAT(attribute.error().expected, HasSubstr("feedrate"));
}

TEST(Explain, OpenDecisionsAreSaidToBeOpen) {
  auto plan = testing::planned_plate();
  const auto op = plan.model.all(model::TypeId::kDrilling).front();
  (void)plan.ledger.reopen({op, "its_tool"});
  const auto text = explain(plan, "1");
  ASSERT_TRUE(text);
  EXPECT_THAT(*text, HasSubstr("open"));
  EXPECT_THAT(explain(plan), HasSubstr("Still open\n  its_tool of #20 DRILLING 'DRILL'\n  feedrate of #45"));
}

TEST(Explain, ReasonsSurviveTheFile) {
  Job job;
  const auto written = exchange::write_iso14649(testing::planned_plate(), job);
  ASSERT_TRUE(written) << to_text(written.error());
  const auto plan = testing::read_text(written->bytes);
  const auto text = explain(plan, "DRILL IT");
  ASSERT_TRUE(text) << to_text(text.error());
  EXPECT_THAT(*text,
              HasSubstr("a hole of IT11 or coarser is drilled [hole.drill.it11; Kalpakjian, table 16.4]"));
  EXPECT_THAT(*text, HasSubstr("bound by optimiser"));
  EXPECT_THAT(*text, HasSubstr("not generic/drill/9.8: 0.2 mm too small"));
}

TEST(Explain, AnEditedValueIsGiven) {
  Job job;
  auto written = exchange::write_iso14649(testing::planned_plate(), job);
  ASSERT_TRUE(written);
  const std::string feed = "MILLING_TECHNOLOGY(0.005,";
  const auto at = written->bytes.find(feed);
  ASSERT_NE(at, std::string::npos);
  written->bytes.replace(at, feed.size(), "MILLING_TECHNOLOGY(0.004,");
  const auto text = explain(testing::read_text(written->bytes), "DRILL IT");
  ASSERT_TRUE(text);
  EXPECT_THAT(*text,
              HasSubstr("feedrate = 240 mm/min\n      given in the file\n      because edited in the file"));
  EXPECT_THAT(*text, Not(HasSubstr("bound by optimiser")));
}

}  // namespace
}  // namespace capstan::app
