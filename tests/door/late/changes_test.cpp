#include "planner/door/late/changes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "planner/door/late/late.h"
#include "planner/model/nouns/all.h"
#include "tests/door/late/brought.h"

namespace capstan::late {
namespace {

const std::string kBracket = capstan::testing::source_dir() + "/examples/bracket.p21";

const Brought& bracket() {
  static const Brought kBrought = brought(kBracket, pipeline::Format::kJson);
  return kBrought;
}

Decisions may(const std::string& text) {
  const auto out = Decisions::parse(text);
  EXPECT_TRUE(out) << text;
  return out.value_or(Decisions{});
}

Result<LateOutcome> bound(const model::Plan& plan, pipeline::Inputs in,
                          const std::string& decisions = "all") {
  LatePolicy policy = {.deadline = std::nullopt};
  policy.may = may(decisions);
  Job job;
  return bind(plan, std::move(in), policy, job);
}

/// A tool without which the bracket is made with others.
int replaceable() {
  static const int kTool = [] {
    for (int tool = 1; tool <= tools(bracket()); ++tool)
      if (bound(bracket().plan, shop_of(without(bracket().table, tool)))) return tool;
    return 0;
  }();
  EXPECT_GT(kTool, 0);
  return kTool;
}

TEST(LateDecisions, AreReadAndWrittenByTheirNames) {
  EXPECT_EQ(may("all"), Decisions::all());
  EXPECT_EQ(may("none").text(), "none");
  EXPECT_EQ(may("order,tools").text(), "tools,order");
  EXPECT_EQ(may("feeds,tools").within(may("feeds,depths")), may("feeds"));
  const auto wrong = Decisions::parse("tools,speeds");
  ASSERT_FALSE(wrong);
  EXPECT_NE(wrong.error().message.find("speeds"), std::string::npos);
}

TEST(LateChanges, OfAPlanThatStandsThereAreNone) {
  const auto as_it_is = bound(bracket().plan, shop_of(bracket().table), "none");
  ASSERT_TRUE(as_it_is) << to_text(as_it_is.error());
  EXPECT_TRUE(as_it_is->changes.empty()) << as_it_is->words;
  EXPECT_EQ(as_it_is->words, "");
}

// Once a bind for which feeds alone may be decided was refused for a nanometre of width.
TEST(LateChanges, LessThanAControlsIncrementIsNoDecisionAndNoExcuseForAnotherPath) {
  const model::Plan& then = bracket().plan;
  const std::size_t step = 3;
  model::Plan now = then;
  now.steps[step].radial_depth_mm += 5e-4;
  auto path = std::make_shared<model::CutterPath>(*now.steps[step].path);
  ASSERT_GT(path->size(), 4U);
  path->x[2] += 5e-4;
  now.steps[step].path = path;
  const auto less = changes(then, now, false);
  ASSERT_EQ(less.size(), 1U);
  EXPECT_TRUE(less.front().decided.empty()) << less.front().text;
  EXPECT_TRUE(within_policy(then, now, may("feeds"), false));
  // A line that is split where another feed begins is the same way.
  std::size_t line = 1;
  while (path->kind[line] != model::MoveKind::kLine) ++line;
  auto split = std::make_shared<model::CutterPath>(*path);
  const geometry::Vec3 half = model::point_on_move(*path, line, 0.5);
  const auto at = static_cast<std::ptrdiff_t>(line);
  split->x.insert(split->x.begin() + at, half.x);
  split->y.insert(split->y.begin() + at, half.y);
  split->z.insert(split->z.begin() + at, half.z);
  split->cx.insert(split->cx.begin() + at, 0.0);
  split->cy.insert(split->cy.begin() + at, 0.0);
  split->kind.insert(split->kind.begin() + at, path->kind[line]);
  split->role.insert(split->role.begin() + at, path->role[line]);
  now.steps[step].path = split;
  EXPECT_TRUE(changes(then, now, false).front().decided.empty());
  path = std::make_shared<model::CutterPath>(*path);
  path->x[2] += 0.5;
  now.steps[step].path = path;
  EXPECT_EQ(changes(then, now, false).front().decided, std::vector{Choice::kStrategy});
  EXPECT_FALSE(within_policy(then, now, may("feeds"), false));
  now.steps[step].radial_depth_mm += 0.01;
  EXPECT_EQ(changes(then, now, false).front().decided, std::vector{Choice::kDepths});
}

TEST(LateChanges, AWornToolIsToldWithItsSizeAndItsPathIsNoDecision) {
  const int mill = eight_mill(bracket().plan);
  const std::string t = "T" + std::to_string(mill);
  const auto worn = bound(bracket().plan, shop_of(with(bracket().table, mill, "D", -0.05)));
  ASSERT_TRUE(worn) << to_text(worn.error());
  EXPECT_NE(worn->words.find(t + " endmill 7.95 mm as measured, instead of " + t + " endmill 8 mm"),
            std::string::npos)
      << worn->words;
  EXPECT_NE(worn->words.find("Time of the steps"), std::string::npos) << worn->words;
  const auto alone = bound(bracket().plan, shop_of(with(bracket().table, mill, "D", -0.05)), "none");
  EXPECT_TRUE(alone) << to_text(alone.error());
  for (const Change& c : worn->changes) {
    EXPECT_EQ(std::count(c.decided.begin(), c.decided.end(), Choice::kTools), 0) << c.text;
    EXPECT_EQ(std::count(c.decided.begin(), c.decided.end(), Choice::kStrategy), 0) << c.text;
  }
}

TEST(LateChanges, WhatIsToldOfTheTimeIsTheDifferenceOfThePlans) {
  const auto other = bound(bracket().plan, shop_of(without(bracket().table, replaceable())));
  ASSERT_TRUE(other) << to_text(other.error());
  ASSERT_FALSE(other->changes.empty());
  double told = 0.0;
  for (const Change& c : other->changes) told += c.seconds;
  EXPECT_NEAR(told, other->machining_s - machining_s(bracket().plan),
              0.05 * static_cast<double>(1 + other->plan.steps.size()));
  EXPECT_NE(other->words.find("Why: "), std::string::npos) << other->words;
  EXPECT_NE(other->words.find(" is not in the magazine"), std::string::npos) << other->words;
}

TEST(LatePolicy, AToolThatMayNotBeChosenIsRefusedWithItsStep) {
  const pipeline::Inputs in = shop_of(without(bracket().table, replaceable()));
  ASSERT_TRUE(bound(bracket().plan, in));
  for (const std::string decisions : {"none", "feeds,depths,strategy"}) {
    const auto refused = bound(bracket().plan, in, decisions);
    ASSERT_FALSE(refused) << decisions;
    EXPECT_EQ(refused.error().code, "LATE-POLICY") << to_text(refused.error());
    EXPECT_FALSE(refused.error().path.empty());
    EXPECT_NE(refused.error().message.find("(it may: " + decisions + ")"), std::string::npos)
        << refused.error().message;
  }
}

TEST(LatePolicy, WhatAPlanLeavesOpenIsDecidedOnlyWhereItMayBe) {
  Job job;
  const auto plate = pipeline::read_plan(testing::slurp(kPlate), kPlate, job);
  ASSERT_TRUE(plate);
  EXPECT_TRUE(bound(*plate, shop(kMagazine)));
  const auto refused = bound(*plate, shop(kMagazine), "tools,depths,order");
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, "LATE-POLICY") << to_text(refused.error());
}

TEST(LatePolicy, WhatTheOperatorPinnedStays) {
  model::Plan plan = bracket().plan;
  std::size_t pinned = 0;
  const auto entries = plan.ledger.entries();
  for (const auto& [key, decision] : entries) {
    if (key.attribute != "its_tool") continue;
    model::Decision d = decision;
    d.pinned = true;
    plan.ledger.set(key, d);
    ++pinned;
  }
  ASSERT_GT(pinned, 5U);
  EXPECT_TRUE(bound(plan, shop_of(bracket().table)));
  EXPECT_FALSE(bound(plan, shop_of(without(bracket().table, replaceable()))));
  // The tool that it is may be worn.
  const auto worn = bound(plan, shop_of(with(bracket().table, eight_mill(plan), "D", -0.05)));
  EXPECT_TRUE(worn) << to_text(worn.error());
  // A plan that says another value than the pinned one is refused, whoever made it.
  model::Plan other = plan;
  for (const auto& [key, decision] : plan.ledger.entries()) {
    if (!decision.pinned) continue;
    other.model.get<model::MachiningOperation>(key.object)->its_tool = {};
    break;
  }
  const auto refused = within_policy(plan, other, Decisions::all());
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, "LATE-PINNED");
}

}  // namespace
}  // namespace capstan::late
