#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "planner/door/late/late.h"
#include "planner/model/nouns/all.h"
#include "tests/door/late/brought.h"

// The bracket's counterbores are roughed by a 6 mm end mill and finished by an 8 mm one. Without the 6 mm
// mill no loaded tool roughs them, for the rules ask for one of at most 6 mm there; another chain of the
// rules does without that step.

namespace capstan::late {
namespace {

using ::testing::HasSubstr;

const Brought& bracket() {
  static const Brought kBrought =
      brought(capstan::testing::source_dir() + "/examples/bracket.p21", pipeline::Format::kJson);
  return kBrought;
}

/// Number of the end mill of so many mm in the plan; 0: it has none.
int end_mill(const model::Plan& plan, double diameter_mm) {
  for (const model::Cutter& c : plan.cutters)
    if (c.cutter_class == model::CutterClass::kEndmill && c.cutting_diameter_mm == diameter_mm)
      return c.pocket;
  return 0;
}

Result<LateOutcome> without_six(const model::Plan& plan, LatePolicy policy = {}) {
  policy.deadline.reset();
  policy.budget = policy.fallback_budget;  // no improvement
  const int six = end_mill(bracket().plan, 6.0);
  EXPECT_NE(six, 0);
  Job job;
  return bind(plan, shop_of(without(bracket().table, six)), policy, job);
}

bool roughs_a_counterbore(const model::Plan& plan) {
  return std::any_of(plan.steps.begin(), plan.steps.end(), [&](const model::StepResult& s) {
    return model::step_id(plan, s).find("CAP SCREW HOLE[1] mill_rough") != std::string::npos;
  });
}

TEST(LateAnew, WhereNoLoadedToolFitsAnOperationAllOperationsAreChosenOnceMore) {
  ASSERT_TRUE(roughs_a_counterbore(bracket().plan));
  const auto bound = without_six(bracket().plan);
  ASSERT_TRUE(bound) << to_text(bound.error());
  EXPECT_FALSE(bound->kept);
  EXPECT_FALSE(roughs_a_counterbore(bound->plan));
  EXPECT_TRUE(bound->plan.unplanned.empty());
  EXPECT_TRUE(bound->condemned.empty());
  EXPECT_EQ(end_mill(bound->plan, 6.0), 0);
  // Which tool is missing, and that therefore everything was chosen once more, stands in the answer.
  ASSERT_EQ(bound->reopened.size(), 2U);
  EXPECT_THAT(bound->reopened.front(), HasSubstr("is not in the magazine"));
  EXPECT_THAT(bound->reopened.back(), HasSubstr("CAP SCREW HOLE[1] mill_rough"));
  EXPECT_THAT(bound->reopened.back(), HasSubstr("all of them were chosen anew"));
  EXPECT_THAT(bound->words, HasSubstr("chosen anew"));
}

TEST(LateAnew, OfWorkingstepsTheWholePartIsChosenOnceMoreBeforeTheFirstIsCut) {
  LatePolicy policy;
  policy.next = Next{bracket().plan.steps.size(), 1};
  // The counterbore's rough step is among these.
  const auto bound = without_six(bracket().plan, policy);
  ASSERT_TRUE(bound) << to_text(bound.error());
  ASSERT_TRUE(bound->part);
  EXPECT_FALSE(roughs_a_counterbore(*bound->part));
  EXPECT_EQ(end_mill(*bound->part, 6.0), 0);
  EXPECT_THAT(bound->reopened.back(), HasSubstr("all of them were chosen anew"));
}

TEST(LateAnew, WhatIsCutIsNotChosenOnceMore) {
  LatePolicy policy;
  policy.next = Next{bracket().plan.steps.size() - 1, 2};
  const auto bound = without_six(bracket().plan, policy);
  ASSERT_FALSE(bound);
  EXPECT_EQ(bound.error().code, "LATE-OPEN") << to_text(bound.error());
}

TEST(LateAnew, AnOperationOfTheFileOrAPinnedValueIsNotChosenOnceMore) {
  for (const bool pins : {false, true}) {
    model::Plan plan = bracket().plan;
    const auto entries = plan.ledger.entries();
    const auto one = std::find_if(entries.begin(), entries.end(), [&](const auto& e) {
      return e.first.attribute == "its_operation" &&
             plan.model.get<model::MachiningWorkingstep>(e.first.object) != nullptr;
    });
    ASSERT_NE(one, entries.end());
    model::Decision decision = one->second;
    if (pins)
      decision.pinned = true;
    else
      decision.binder = model::Binder::kGiven;
    plan.ledger.set(one->first, decision);
    const auto bound = without_six(plan);
    ASSERT_FALSE(bound) << pins;
    EXPECT_EQ(bound.error().code, "LATE-OPEN") << to_text(bound.error());
  }
}

TEST(LateAnew, AControlThatMayNotChooseOperationsIsToldSo) {
  for (const bool part : {false, true}) {
    LatePolicy policy;
    policy.may = *Decisions::parse("tools,feeds,depths,strategy");
    if (part) policy.next = Next{bracket().plan.steps.size(), 1};
    const auto bound = without_six(bracket().plan, policy);
    ASSERT_FALSE(bound) << part;
    EXPECT_EQ(bound.error().code, "LATE-POLICY") << to_text(bound.error());
  }
}

}  // namespace
}  // namespace capstan::late
