#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "planner/door/late/late.h"
#include "planner/model/nouns/all.h"
#include "tests/door/late/brought.h"

// The bracket's dowel holes are drilled to 7.8 mm and reamed. Without the reamer no loaded tool does that
// step; another chain of the rules drills them to 7.5 mm and bores them, with a drill and a boring tool that
// are loaded and that the plan does not use.

namespace capstan::late {
namespace {

using ::testing::HasSubstr;

const Brought& bracket() {
  static const Brought kBrought =
      brought(capstan::testing::source_dir() + "/examples/bracket.p21", pipeline::Format::kJson);
  return kBrought;
}

/// What bores the dowel holes, as the tool table of a plan without reamers has it.
const char* const kBoring =
    "T21 P21 Z+125.0 D+7.5 ;generic 7.5 mm coated carbide twist drill, 140 deg, long\n"
    "T22 P22 Z+106.0 D+8.0075 ;generic 8 mm carbide boring tool, set to size to 10 mm\n";

int reamer(const model::Plan& plan) { return tool_number(plan, model::CutterClass::kReamer, 8.0); }

Result<LateOutcome> without_reamer(const model::Plan& plan, LatePolicy policy = {}) {
  policy.deadline.reset();
  policy.budget = policy.fallback_budget;  // no improvement
  EXPECT_NE(reamer(bracket().plan), 0);
  Job job;
  return bind(plan, shop_of(without(bracket().table, reamer(bracket().plan)) + kBoring), policy, job);
}

bool has_step(const model::Plan& plan, const std::string& id) {
  return std::any_of(plan.steps.begin(), plan.steps.end(),
                     [&](const model::StepResult& s) { return model::step_id(plan, s) == id; });
}

TEST(LateAnew, WhereNoLoadedToolFitsAnOperationAllOperationsAreChosenOnceMore) {
  ASSERT_TRUE(has_step(bracket().plan, "DOWEL HOLE 1 ream"));
  const auto bound = without_reamer(bracket().plan);
  ASSERT_TRUE(bound) << to_text(bound.error());
  EXPECT_FALSE(bound->kept);
  EXPECT_FALSE(has_step(bound->plan, "DOWEL HOLE 1 ream"));
  EXPECT_TRUE(has_step(bound->plan, "DOWEL HOLE 1 bore"));
  EXPECT_TRUE(bound->plan.unplanned.empty());
  EXPECT_TRUE(bound->condemned.empty());
  EXPECT_EQ(reamer(bound->plan), 0);
  // Which tool is missing, and that therefore everything was chosen once more, stands in the answer.
  ASSERT_EQ(bound->reopened.size(), 3U);  // of each hole, and of the part
  EXPECT_THAT(bound->reopened.front(), HasSubstr("is not in the magazine"));
  EXPECT_THAT(bound->reopened.back(), HasSubstr("DOWEL HOLE 1 ream"));
  EXPECT_THAT(bound->reopened.back(), HasSubstr("all of them were chosen anew"));
  EXPECT_THAT(bound->words, HasSubstr("chosen anew"));
}

TEST(LateAnew, OfWorkingstepsTheWholePartIsChosenOnceMoreBeforeTheFirstIsCut) {
  LatePolicy policy;
  policy.next = Next{bracket().plan.steps.size(), 1};
  // The reaming steps are among these.
  const auto bound = without_reamer(bracket().plan, policy);
  ASSERT_TRUE(bound) << to_text(bound.error());
  ASSERT_TRUE(bound->part);
  EXPECT_FALSE(has_step(*bound->part, "DOWEL HOLE 1 ream"));
  EXPECT_EQ(reamer(*bound->part), 0);
  ASSERT_FALSE(bound->reopened.empty());
  EXPECT_THAT(bound->reopened.back(), HasSubstr("all of them were chosen anew"));
}

TEST(LateAnew, WhatIsCutIsNotChosenOnceMore) {
  LatePolicy policy;
  policy.next = Next{bracket().plan.steps.size() - 1, 2};
  const auto bound = without_reamer(bracket().plan, policy);
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
    const auto bound = without_reamer(plan);
    ASSERT_FALSE(bound) << pins;
    EXPECT_EQ(bound.error().code, "LATE-OPEN") << to_text(bound.error());
  }
}

TEST(LateAnew, AControlThatMayNotChooseOperationsIsToldSo) {
  for (const bool part : {false, true}) {
    LatePolicy policy;
    policy.may = *Decisions::parse("tools,feeds,depths,strategy");
    if (part) policy.next = Next{bracket().plan.steps.size(), 1};
    const auto bound = without_reamer(bracket().plan, policy);
    ASSERT_FALSE(bound) << part;
    EXPECT_EQ(bound.error().code, "LATE-POLICY") << to_text(bound.error());
  }
}

}  // namespace
}  // namespace capstan::late
