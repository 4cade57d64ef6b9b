#include "planner/door/late/branches.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "planner/door/late/late.h"
#include "planner/door/late/measured_names.h"
#include "planner/ground/base/nearest_names.h"
#include "planner/making/given/listed_steps.h"
#include "planner/model/nouns/all.h"
#include "tests/door/late/brought.h"

// A pocket that is roughed and finished: its finish lies in a condition, or in an alternative.

namespace capstan::late {
namespace {

using model::AnyRef;
using model::Ref;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

const std::string kPocket = capstan::testing::source_dir() + "/examples/reference_pocket.p21";

struct Pocket {
  model::Plan plan;
  std::string table;
  Ref<model::Workplan> main;
  Ref<model::Executable> rough, finish;
};

/// Its workplan is the first step, and `last` in place of the second.
Pocket pocket() {
  Brought early = brought(kPocket, pipeline::Format::kJson);
  Pocket out{std::move(early.plan), std::move(early.table), {}, {}, {}};
  out.main = out.plan.model.at<model::Project>(out.plan.project).main_workplan;
  const auto steps = given::steps_in_order(out.plan);
  EXPECT_EQ(steps.size(), 2U);
  out.rough = Ref<model::Executable>(steps.at(0));
  out.finish = Ref<model::Executable>(steps.at(1));
  return out;
}
void put_last(Pocket& p, AnyRef last) {
  auto& elements = p.plan.model.at<model::Workplan>(p.main).its_elements;
  elements.items = {p.rough, last};
  p.plan.steps.resize(1);
}

/// wall > 0.02
Ref<model::BooleanExpression> wall_stands(model::Model& m) {
  model::NcVariable wall;
  wall.its_name = "wall";
  model::NcConstant limit;
  limit.its_name = "limit";
  limit.its_value = 0.02;
  model::ComparisonGreater c;
  c.operand1 = m.add(wall);
  c.operand2 = m.add(limit);
  return m.add(c);
}
AnyRef if_it_stands(Pocket& p) {
  model::IfStatement s;
  s.its_id = "material stands";
  s.condition = wall_stands(p.plan.model);
  s.true_branch = p.finish;
  return p.plan.model.add(s);
}
AnyRef while_it_stands(Pocket& p) {
  model::Workplan body;
  body.its_id = "spring pass";
  body.its_elements.push_back(p.finish);
  model::WhileStatement s;
  s.its_id = "material stands";
  s.condition = wall_stands(p.plan.model);
  s.body = p.plan.model.add(body);
  return p.plan.model.add(s);
}

std::vector<std::string> taken(Pocket& p, const Measured& measured, const Decisions may = Decisions::all()) {
  const auto out = take_branches(p.plan, measured, shop_of(p.table).library, may, p.plan.steps.size());
  EXPECT_TRUE(out) << (out ? "" : to_text(out.error()));
  return out.value_or(std::vector<std::string>{});
}
std::vector<AnyRef> steps(const Pocket& p) { return given::steps_in_order(p.plan); }

TEST(LateBranches, OfAnIfTheBranchIsTakenThatTheMeasuredValueSays) {
  Pocket stands = pocket(), clean = pocket();
  put_last(stands, if_it_stands(stands));
  put_last(clean, if_it_stands(clean));
  EXPECT_THAT(taken(stands, {{"wall", 0.05}}), ElementsAre(HasSubstr("wall (0.05) > 0.02 holds")));
  EXPECT_THAT(steps(stands), ElementsAre(AnyRef(stands.rough), AnyRef(stands.finish)));
  EXPECT_THAT(taken(clean, {{"wall", 0.02}}), ElementsAre(HasSubstr("nothing is done")));
  EXPECT_THAT(steps(clean), ElementsAre(AnyRef(clean.rough)));
}

TEST(LateBranches, TheBranchIsInTheLedgerWithTheElementThatIsTaken) {
  Pocket p = pocket();
  put_last(p, if_it_stands(p));
  (void)taken(p, {{"wall", 0.05}});
  const auto* decision = p.plan.ledger.find(p.finish, "enabled");
  ASSERT_NE(decision, nullptr);
  EXPECT_EQ(p.plan.ledger.reason(decision->reason).id, "late.condition");
  EXPECT_THAT(p.plan.ledger.reason(decision->reason).text, HasSubstr("0.05"));
}

TEST(LateBranches, WhatWasNotMeasuredIsNotDecided) {
  Pocket p = pocket();
  put_last(p, if_it_stands(p));
  EXPECT_THAT(taken(p, {{"floor", 1.0}}), IsEmpty());
  EXPECT_THAT(steps(p), ElementsAre(AnyRef(p.rough)));
}

TEST(LateBranches, AMeasuredNameThatNoStatementReadsIsRefusedWithTheNearestOnes) {
  Pocket p = pocket();
  EXPECT_TRUE(only_read(p.plan, {}));
  const auto nothing = only_read(p.plan, {{"wall", 0.05}});
  ASSERT_FALSE(nothing);
  EXPECT_THAT(nothing.error().hint, HasSubstr("no if or while statement"));
  put_last(p, if_it_stands(p));
  EXPECT_TRUE(only_read(p.plan, {{"wall", 0.05}}));
  const auto wrong = only_read(p.plan, {{"wall", 0.05}, {"wal", 0.05}});
  ASSERT_FALSE(wrong);
  EXPECT_EQ(wrong.error().code, kUnknownName);
  EXPECT_THAT(wrong.error().message, HasSubstr("'wal'. Did you mean 'wall'?"));
  EXPECT_THAT(wrong.error().hint, HasSubstr("read wall"));
}

TEST(LateBranches, AWhileIsDoneOnceMoreEachTimeThatItsConditionHoldsWhenItIsReached) {
  Pocket p = pocket();
  put_last(p, while_it_stands(p));
  EXPECT_THAT(taken(p, {{"wall", 0.05}}), ElementsAre(HasSubstr("holds, once more")));
  EXPECT_THAT(steps(p), ElementsAre(AnyRef(p.rough), AnyRef(p.finish)));
  EXPECT_THAT(taken(p, {{"wall", 0.05}}), IsEmpty());  // the pass before it is not bound
  p.plan.steps.push_back(p.plan.steps.back());
  p.plan.steps.back().step = p.finish;
  EXPECT_EQ(taken(p, {{"wall", 0.03}}).size(), 1U);
  EXPECT_THAT(steps(p), ElementsAre(AnyRef(p.rough), AnyRef(p.finish), AnyRef(p.finish)));
  p.plan.steps.push_back(p.plan.steps.back());
  EXPECT_THAT(taken(p, {{"wall", 0.01}}), ElementsAre(HasSubstr("does not hold any more")));
  EXPECT_EQ(steps(p).size(), 3U);
  EXPECT_THAT(taken(p, {{"wall", 0.05}}), IsEmpty());  // it is over
}

/// A selective of two ways to finish: with the plan's tool, and with one of 3 mm.
AnyRef two_ways(Pocket& p) {
  model::Model& m = p.plan.model;
  const auto* ws = m.get<model::MachiningWorkingstep>(p.finish);
  const AnyRef operation = m.add_object(AnyRef(ws->its_operation).type);
  *m.get<model::BottomAndSideFinishMilling>(operation) =
      m.at<model::BottomAndSideFinishMilling>(ws->its_operation);
  model::MachiningWorkingstep other = *ws;
  other.its_id = "finish otherwise";
  other.persistent_id.reset();
  other.its_operation = Ref<model::MachiningOperation>(operation);
  model::Selective s;
  s.its_id = "finish";
  s.its_elements.push_back(p.finish);
  s.its_elements.push_back(Ref<model::Executable>(m.add(other)));
  // What the second is made with is open: any tool that fits does.
  m.get<model::BottomAndSideFinishMilling>(operation)->its_tool = {};
  m.get<model::BottomAndSideFinishMilling>(operation)->its_toolpath = {};
  return m.add(s);
}

TEST(LateBranches, OfASelectiveTheFirstWayIsTakenForWhichAllToolsAreLoaded) {
  Pocket p = pocket();
  const AnyRef ways = two_ways(p);
  put_last(p, ways);
  EXPECT_THAT(taken(p, {}), IsEmpty());
  EXPECT_THAT(steps(p), ElementsAre(AnyRef(p.rough), AnyRef(p.finish)));
  const auto* op = p.plan.model.get<model::MachiningWorkingstep>(p.finish);
  ASSERT_NE(op, nullptr);
  p.table = "T40 P40 Z+80 D+3 ;3 mm carbide end mill, 3 flutes\n";
  EXPECT_THAT(taken(p, {}), ElementsAre(HasSubstr("'finish otherwise' is taken")));
  EXPECT_EQ(steps(p).size(), 2U);
  EXPECT_NE(steps(p).back(), AnyRef(p.finish));
}

TEST(LateBranches, WhatMayNotBeDecidedHereIsRefusedWithItsStatement) {
  Pocket p = pocket();
  put_last(p, if_it_stands(p));
  const auto out = take_branches(p.plan, {{"wall", 0.05}}, {}, *Decisions::parse("tools,alternatives"),
                                 p.plan.steps.size());
  ASSERT_FALSE(out);
  EXPECT_EQ(out.error().code, "LATE-POLICY");
  EXPECT_THAT(out.error().message, HasSubstr("conditions"));
}

TEST(LateBranches, ASpringPassIsBoundWhenTheProbeSaysSoAndIsInTheRecord) {
  Pocket p = pocket();
  put_last(p, while_it_stands(p));
  LatePolicy policy{.deadline = std::nullopt};
  policy.next = Next{};
  policy.measured = {{"wall", 0.05}};
  Job job;
  const auto bound = bind(p.plan, shop_of(p.table), policy, job);
  ASSERT_TRUE(bound) << to_text(bound.error());
  EXPECT_EQ(bound->first, 2U);
  ASSERT_EQ(bound->part->steps.size(), 1U);
  EXPECT_EQ(AnyRef(bound->part->steps[0].step), AnyRef(p.finish));
  EXPECT_THAT(bound->words, HasSubstr("wall (0.05) > 0.02 holds"));
  EXPECT_THAT(bound->plan.provenance.back().source, HasSubstr("wall (0.05) > 0.02 holds"));
  policy.measured = {{"wall", 0.0}};
  Job second;
  const auto again = bind(bound->plan, shop_of(p.table), policy, second);
  ASSERT_TRUE(again) << to_text(again.error());
  EXPECT_EQ(given::steps_in_order(again->plan).size(), 2U);  // it is over: nothing is open
}

TEST(LateMeasured, IsReadByNamesAndNumbers) {
  EXPECT_EQ(*parse_measured("wall=0.04,floor=-0.01"), (Measured{{"wall", 0.04}, {"floor", -0.01}}));
  for (const char* wrong : {"wall", "=1", "wall=high", "wall=1,,floor=2"})
    EXPECT_FALSE(parse_measured(wrong)) << wrong;
}

}  // namespace
}  // namespace capstan::late
