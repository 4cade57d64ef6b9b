#include "planner/model/plan/decision/condemned.h"

#include <gtest/gtest.h>

#include "planner/model/nouns/all.h"

namespace capstan::model {
namespace {

/// Steps SLOT and HOLE, each on a feature of that name.
Plan two_steps() {
  Plan plan;
  for (const char* id : {"SLOT", "HOLE"}) {
    RoundHole feature;
    feature.its_id = std::string(id);
    MachiningWorkingstep ws;
    ws.its_id = std::string(id);
    ws.its_feature = plan.model.add(feature);
    StepResult step;
    step.step = plan.model.add(ws);
    plan.steps.push_back(step);
  }
  return plan;
}

Finding finding(Severity severity, const std::string& step) {
  Finding f;
  f.code = "CHK-GOUGE";
  f.severity = severity;
  f.step = step;
  f.message = "gouges by 2 mm";
  return f;
}

TEST(Condemned, APlanWithoutErrorsIsNot) {
  EXPECT_TRUE(condemned(two_steps(), {}).empty());
  EXPECT_TRUE(
      condemned(two_steps(), {finding(Severity::kWarning, "SLOT"), finding(Severity::kNote, "")}).empty());
}

TEST(Condemned, AnErrorCondemnsItsStepOrTheWholePlan) {
  const auto of_step = condemned(two_steps(), {finding(Severity::kError, "HOLE")});
  ASSERT_EQ(of_step.size(), 1u);
  EXPECT_EQ(of_step[0], (Condemnation{"HOLE", "CHK-GOUGE", "gouges by 2 mm"}));
  EXPECT_EQ(text_of(two_steps(), of_step[0]), "step 2 HOLE: gouges by 2 mm");
  const auto whole = condemned(two_steps(), {finding(Severity::kError, "")});
  ASSERT_EQ(whole.size(), 1u);
  EXPECT_EQ(whole[0].step, "");
  // The same said of plan and program is one reason.
  EXPECT_EQ(
      condemned(two_steps(), {finding(Severity::kError, "HOLE"), finding(Severity::kError, "HOLE")}).size(),
      1u);
}

TEST(Condemned, AnExceededLimitIsSaidWithNumbersPlaceAndWhatToDo) {
  Plan plan = two_steps();
  plan.steps[0].exceeded.push_back({"spindle_torque", 1.112, 0.477, "Nm", geometry::Vec3{12.42, 30.1, -3.0}});
  const auto reasons = condemned(plan, {});
  ASSERT_EQ(reasons.size(), 1u);
  EXPECT_EQ(text_of(plan, reasons[0]),
            "step 1 SLOT: spindle torque 1.11 of 0.48 Nm at X12.4 Y30.1; use a smaller tool or depth");
  plan.steps[0].exceeded[0] = {"load", 0.0, 0.0, "", std::nullopt};
  EXPECT_EQ(condemned(plan, {})[0].text,
            "load outside the range of every formula; use a smaller tool or depth");
}

TEST(Condemned, AnUnplannedFeatureCondemnsWhatRestsOnIt) {
  Plan plan = two_steps();
  RoundHole core;
  core.its_id = std::string("CORE");
  plan.unplanned.push_back({AnyRef(plan.model.add(core)), "no drill is as long"});
  EXPECT_TRUE(condemned(plan, {}).empty());  // nothing needs it
  plan.unplanned[0].needed_by = {"HOLE"};
  const auto reasons = condemned(plan, {});
  ASSERT_EQ(reasons.size(), 1u);
  EXPECT_EQ(reasons[0].step, "HOLE");
  EXPECT_EQ(reasons[0].text, "feature 'CORE' is not planned, and this rests on it: no drill is as long");
  plan.unplanned[0].needed_by = {"TAP"};
  ASSERT_EQ(condemned(plan, {}).size(), 1u);
  EXPECT_EQ(condemned(plan, {})[0].step, "");
}

TEST(Condemned, FeaturesThatAreLeftOutTogetherCondemnNothing) {
  Plan plan = two_steps();
  RoundHole core, thread;
  core.its_id = std::string("CORE");
  thread.its_id = std::string("TAP");
  plan.unplanned.push_back({AnyRef(plan.model.add(core)), "no drill is as long", {"TAP"}});
  ASSERT_EQ(condemned(plan, {}).size(), 1u);
  plan.unplanned.push_back({AnyRef(plan.model.add(thread)), "it rests on 'CORE'"});
  EXPECT_TRUE(condemned(plan, {}).empty());
}

}  // namespace
}  // namespace capstan::model
