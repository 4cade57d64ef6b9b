#include "planner/door/late/next.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <string>

#include "capstan/capstan_late.h"
#include "planner/door/late/late.h"
#include "planner/door/service/session.h"
#include "planner/files/json/json.h"
#include "planner/making/given/listed_steps.h"
#include "planner/model/nouns/all.h"
#include "planner/proof/verify/verify.h"
#include "tests/door/late/brought.h"
#include "tests/support/corpus.h"
#include "tests/support/scratch.h"

// Workingsteps are bound one by one, as a control asks for them.

namespace capstan::late {
namespace {

const std::string kPocket = capstan::testing::source_dir() + "/examples/reference_pocket.p21";
const std::string kBracket = capstan::testing::source_dir() + "/examples/bracket.p21";

/// A part whose operations are chosen, and nothing else; and the table of the tools that planning all of it
/// takes.
struct Open {
  model::Plan plan;
  std::string table;
};
Open open(const std::string& part) {
  const Brought whole = brought(part, pipeline::Format::kJson);
  Job job;
  auto read = pipeline::read_plan(testing::slurp(part), part, job);
  auto planned = pipeline::bind(*std::move(read), shop({}), {.bind = pipeline::Bind::kStrategy}, job);
  EXPECT_TRUE(planned) << to_text(planned.error());
  return {*std::move(planned), whole.table};
}

LatePolicy next(std::size_t count = 1, std::optional<std::size_t> from = std::nullopt) {
  LatePolicy p;
  p.deadline.reset();
  p.budget = p.fallback_budget;  // no improvement
  p.next = Next{count, from};
  return p;
}

/// A shop that remembers.
pipeline::Inputs remembering(pipeline::Inputs in) {
  in.memo = std::make_shared<memo::Memo>();
  in.proofs = std::make_shared<memo::Memo>();
  return in;
}

std::size_t count(const std::string& text, const std::string& what) {
  std::size_t n = 0;
  for (auto at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) ++n;
  return n;
}

std::vector<std::string> errors_of(const model::Plan& plan, const model::CutBefore* before = nullptr) {
  Job job;
  std::vector<std::string> out;
  for (const auto& f : verify::check_plan(plan, job, nullptr, before))
    if (f.severity == Severity::kError) out.push_back(f.step + " " + f.code + ": " + f.message);
  return out;
}

TEST(LateNext, StepByStepComesAWholePlanThatTheCheckPasses) {
  Open part = open(kBracket);
  const pipeline::Inputs in = remembering(shop_of(part.table));
  const std::size_t steps = given::steps_in_order(part.plan).size();
  ASSERT_GT(steps, 10U);
  model::Plan so_far = std::move(part.plan);
  for (std::size_t k = 1; k <= steps; ++k) {
    Job job;
    auto bound = bind(so_far, in, next(), job);
    ASSERT_TRUE(bound) << k << ": " << to_text(bound.error());
    EXPECT_EQ(bound->first, k);
    ASSERT_TRUE(bound->part);
    EXPECT_EQ(bound->part->steps.size(), 1U);
    EXPECT_EQ(count(bound->program.text, "(CAPSTAN STEP "), 1U);
    EXPECT_EQ(count(bound->program.text, "\nM2\n"), 1U);
    EXPECT_EQ(bound->plan.steps.size(), k);
    so_far = std::move(bound->plan);
  }
  EXPECT_THAT(errors_of(so_far), ::testing::IsEmpty());
  Job job;
  const auto again = bind(so_far, in, next(), job);
  ASSERT_TRUE(again) << to_text(again.error());
  EXPECT_EQ(again->first, 1U);  // nothing is open: from the beginning
  EXPECT_TRUE(again->kept);
}

// What roughing leaves by bending is wider for a finish, also where roughing is cut and not planned any more:
// once a finish in hardened steel was fed two thirds faster when it was bound alone.
TEST(LateNext, AFinishIsAsWideStepByStepAsInTheWhole) {
  for (const char* material : {"", "42CrMo4+QT"}) {
    const Open part = open(kBracket);
    pipeline::Inputs in = remembering(shop_of(part.table));
    if (*material != '\0') in.material_name = material;
    LatePolicy all = next();
    all.next.reset();
    Job job;
    const auto whole = bind(part.plan, in, all, job);
    ASSERT_TRUE(whole) << to_text(whole.error());
    model::Plan so_far = part.plan;
    double wider = 0.0;
    for (std::size_t k = 0; k < whole->plan.steps.size(); ++k) {
      auto bound = bind(so_far, in, next(), job);
      ASSERT_TRUE(bound) << k << ": " << to_text(bound.error());
      const model::StepResult &one = bound->part->steps.front(), &of_whole = whole->plan.steps[k];
      EXPECT_NEAR(one.radial_depth_mm, of_whole.radial_depth_mm, 1e-3) << material << k << one.cutter_id;
      EXPECT_NEAR(one.feed_mm_min, of_whole.feed_mm_min, 0.01 * of_whole.feed_mm_min) << material << k;
      const auto* finish = bound->plan.model.get<model::MachiningWorkingstep>(one.step);
      if (finish != nullptr &&
          bound->plan.model.holds<model::BottomAndSideFinishMilling>(finish->its_operation))
        wider = std::max(wider, one.radial_depth_mm);
      so_far = std::move(bound->plan);
    }
    EXPECT_GT(wider, 0.0) << "the part has no finish of walls";
  }
}

// The plate's file gives the speeds of a finish, so that none is chosen anew; its forces are those of the
// other material all the same. Once step by step they were those of the one that the plan was made for.
TEST(LateNext, WhatIsKnownOfLaterStepsIsOfTheMaterialThatIsThere) {
  const Brought early = brought(kPlate, pipeline::Format::kJson);
  pipeline::Inputs in = remembering(shop_of(early.table));
  in.material_name = "42CrMo4+QT";
  LatePolicy all = next();
  all.next.reset();
  Job job;
  const auto whole = bind(early.plan, in, all, job);
  ASSERT_TRUE(whole) << to_text(whole.error());
  model::Plan so_far = early.plan;
  for (std::size_t k = 0; k < whole->plan.steps.size(); ++k) {
    auto bound = bind(so_far, in, next(1, k + 1), job);
    ASSERT_TRUE(bound) << k << ": " << to_text(bound.error());
    const double one = bound->part->steps.front().loads.peak_force_n,
                 of_whole = whole->plan.steps[k].loads.peak_force_n;
    EXPECT_NEAR(one, of_whole, 0.03 * of_whole) << k;
    so_far = std::move(bound->plan);
  }
}

TEST(LateNext, AWorkingstepIsCheckedAgainstWhatIsCutAndItsFaultsAreFound) {
  const Open part = open(kPocket);
  const pipeline::Inputs in = shop_of(part.table);
  Job job;
  const auto rough = bind(part.plan, in, next(), job);
  ASSERT_TRUE(rough) << to_text(rough.error());
  const auto finish = bind(rough->plan, in, next(), job);
  ASSERT_TRUE(finish) << to_text(finish.error());
  model::Plan last = *finish->part;
  const model::CutBefore before{finish->plan, 1};
  EXPECT_THAT(errors_of(last, &before), ::testing::IsEmpty());
  EXPECT_THAT(errors_of(last), ::testing::Not(::testing::IsEmpty()));  // in the whole piece
  auto deeper = std::make_shared<model::CutterPath>(*last.steps[0].path);
  for (double& z : deeper->z) z -= 0.5;
  last.steps[0].path = deeper;
  EXPECT_THAT(errors_of(last, &before), ::testing::Contains(::testing::HasSubstr("CHK-GOUGE")));
}

TEST(LateNext, OfAWorkingstepNoOthersPathIsMade) {
  const Open part = open(kBracket);
  const auto made = [&](const LatePolicy& policy) {
    const pipeline::Inputs in = remembering(shop_of(part.table));
    Job job;
    const auto bound = bind(part.plan, in, policy, job);
    EXPECT_TRUE(bound) << to_text(bound.error());
    return in.memo->counts(memo::Stage::kPath).made;
  };
  const std::size_t one = made(next());
  LatePolicy all = next();
  all.next.reset();
  EXPECT_GE(one, 1U);
  EXPECT_LT(4 * one, made(all));
}

TEST(LateNext, SeveralAreBoundAtOnceAndNoMoreThanThereAre) {
  const Open part = open(kPocket);
  const pipeline::Inputs in = shop_of(part.table);
  Job job;
  const auto both = bind(part.plan, in, next(5), job);
  ASSERT_TRUE(both) << to_text(both.error());
  EXPECT_EQ(both->part->steps.size(), 2U);
  EXPECT_EQ(count(both->program.text, "(CAPSTAN STEP "), 2U);
}

TEST(LateNext, OfABoundPlanOneStepIsCheckedAndGivenAsItIs) {
  const Brought early = brought(kBracket, pipeline::Format::kJson);
  Job job;
  const auto bound = bind(early.plan, shop_of(early.table), next(1, 4), job);
  ASSERT_TRUE(bound) << to_text(bound.error());
  EXPECT_TRUE(bound->kept);
  EXPECT_EQ(bound->first, 4U);
  ASSERT_EQ(bound->part->steps.size(), 1U);
  EXPECT_EQ(*bound->part->steps[0].path, *early.plan.steps[3].path);
  EXPECT_EQ(bound->plan.steps.size(), early.plan.steps.size());
  EXPECT_TRUE(bound->changes.empty()) << bound->words;
}

TEST(LateNext, WhatIsCutStaysAsItWasCutWhateverToolComesAfter) {
  const Open part = open(kBracket);
  Job job;
  const auto first = bind(part.plan, shop_of(part.table), next(3), job);
  ASSERT_TRUE(first) << to_text(first.error());
  const std::string id = first->part->steps[0].cutter_id;
  const model::Cutter* was = model::find_cutter(first->plan, id);
  ASSERT_NE(was, nullptr);
  const std::string other = with(part.table, was->pocket, "D", -0.5);
  const auto then = bind(first->plan, shop_of(other), next(1), job);
  ASSERT_TRUE(then) << to_text(then.error());
  for (std::size_t k = 0; k < 3; ++k) {
    const model::StepResult& a = first->plan.steps[k];
    const model::StepResult& b = then->plan.steps[k];
    EXPECT_EQ(*a.path, *b.path);
    EXPECT_EQ(model::find_cutter(first->plan, a.cutter_id)->cutting_diameter_mm,
              model::find_cutter(then->plan, b.cutter_id)->cutting_diameter_mm);
  }
}

TEST(LateNext, AToolThatIsNotLoadedIsNotCalled) {
  const Brought early = brought(kBracket, pipeline::Format::kJson);
  const model::Cutter* tool = model::find_cutter(early.plan, early.plan.steps[3].cutter_id);
  Job job;
  const auto bound = bind(early.plan, shop_of(without(early.table, tool->pocket)), next(1, 4), job);
  if (bound) {
    EXPECT_EQ(bound->program.text.find("T" + std::to_string(tool->pocket) + " M6"), std::string::npos);
    EXPECT_FALSE(bound->reopened.empty());
  } else {
    EXPECT_EQ(bound.error().code, "LATE-OPEN") << to_text(bound.error());
  }
}

TEST(LateNext, WhereALoadedToolFitsByTheRulesTheOperationStays) {
  const std::string narrower = "T1 P1 Z+110 D+8 ;8 mm carbide end mill, 3 flutes\n",
                    wider = "T3 P3 Z+110 D+10 ;10 mm carbide end mill, 3 flutes\n";
  Job job;
  auto read = pipeline::read_plan(testing::slurp(kPocket), kPocket, job);
  const auto early = pipeline::bind(*std::move(read), shop_of(narrower), {}, job);
  ASSERT_TRUE(early) << to_text(early.error());
  ASSERT_TRUE(early->unplanned.empty());
  // The nouns state the narrower mill's size; the rules that it was chosen by take the wider one as well.
  LatePolicy policy = next();
  policy.may = *Decisions::parse("tools,feeds,depths,strategy");
  const auto bound = bind(*early, shop_of(wider), policy, job);
  ASSERT_TRUE(bound) << to_text(bound.error());
  EXPECT_EQ(bound->part->cutters.front().pocket, 3);
  ASSERT_EQ(bound->reopened.size(), 1U);
  EXPECT_THAT(bound->reopened.front(), ::testing::HasSubstr("'T1' (endmill 8 mm) is not in the magazine"));
  Job second;
  const auto then = bind(bound->plan, shop_of(wider), next(1, 2), second);
  ASSERT_TRUE(then) << to_text(then.error());
  EXPECT_EQ(then->first, 2U);
}

TEST(LateNext, AStepThatIsNotThereOrFollowsOneWithoutAPathIsRefused) {
  const Open part = open(kPocket);
  const pipeline::Inputs in = shop_of(part.table);
  for (const std::size_t from : {std::size_t{0}, std::size_t{2}, std::size_t{99}}) {
    Job job;
    const auto bound = bind(part.plan, in, next(1, from), job);
    ASSERT_FALSE(bound) << from;
    EXPECT_EQ(bound.error().code, "LATE-NEXT");
    EXPECT_FALSE(bound.error().expected.empty());
  }
}

TEST(LateNext, OpenOperationsAreChosenFirstWhereTheyMayBe) {
  Job job;
  const auto read = pipeline::read_plan(testing::slurp(kPocket), kPocket, job);
  ASSERT_TRUE(read) << to_text(read.error());
  const pipeline::Inputs in = shop_of(brought(kPocket, pipeline::Format::kJson).table);
  const auto bound = bind(*read, in, next(), job);
  ASSERT_TRUE(bound) << to_text(bound.error());
  EXPECT_EQ(bound->part->steps.size(), 1U);
  LatePolicy policy = next();
  policy.may = *Decisions::parse("tools,feeds,depths,strategy");
  const auto refused = bind(*read, in, policy, job);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, "LATE-POLICY");
}

TEST(LateNext, WhatIsNotCheckedByTheDeadlineIsGivenUpInTimeWhereThatIsWanted) {
  const Open part = open(kBracket);
  Job job;
  LatePolicy policy = next();
  policy.deadline = std::chrono::milliseconds(0);
  policy.stop_at_deadline = true;
  const auto bound = bind(part.plan, shop_of(part.table), policy, job);
  ASSERT_FALSE(bound);
  EXPECT_EQ(bound.error().code, "LATE-NONE");
}

TEST(LateNext, AfterALateAnswerTheSameStepIsBoundAgain) {
  const Open part = open(kBracket);
  const std::string table = capstan::testing::scratch_file("late_again.tbl");
  std::ofstream(table) << part.table;
  const std::string json = json::write_json(part.plan);
  service::Session session, fresh;
  for (service::Session* s : {&session, &fresh}) ASSERT_EQ(s->set("tools", table), service::Code::kDone);
  ASSERT_EQ(session.take(json), service::Code::kDone);
  ASSERT_EQ(session.bind_next({}, 0, 1, std::chrono::milliseconds(0)), service::Code::kLate)
      << session.message();
  ASSERT_EQ(session.bind_next({}, 0, 1, std::nullopt), service::Code::kDone) << session.message();
  ASSERT_EQ(fresh.bind_next(json, 1, 1, std::nullopt), service::Code::kDone) << fresh.message();
  EXPECT_EQ(*session.output("linuxcnc"), *fresh.output("linuxcnc"));
}

TEST(LateInterface, BindsTheNextWorkingstepsOfThePlanThatItHas) {
  const Open part = open(kPocket);
  const std::string path = capstan::testing::scratch_file("late_next.tbl");
  std::ofstream(path) << part.table;
  const std::string json = json::write_json(part.plan);
  capstan_late* s = capstan_late_open("generic_vmc", path.c_str());
  ASSERT_EQ(capstan_late_take(s, json.data(), json.size()), CAPSTAN_LATE_OK) << capstan_late_message(s);
  ASSERT_EQ(capstan_late_bind_next(s, nullptr, 0, 0, 1, 600'000), CAPSTAN_LATE_OK) << capstan_late_message(s);
  const std::string first = capstan_late_output(s, CAPSTAN_LATE_LINUXCNC, nullptr);
  EXPECT_EQ(capstan_late_steps(s), 2U);
  ASSERT_EQ(capstan_late_bind_next(s, nullptr, 0, 0, 1, 600'000), CAPSTAN_LATE_OK) << capstan_late_message(s);
  const std::string second = capstan_late_output(s, CAPSTAN_LATE_LINUXCNC, nullptr);
  EXPECT_NE(first, second);
  // The plan as far as it is bound, for another session: it knows what was cut.
  std::size_t size = 0;
  const char* plan = capstan_late_output(s, CAPSTAN_LATE_JSON, &size);
  const std::string so_far(plan, size);
  capstan_late* other = capstan_late_open("generic_vmc", path.c_str());
  ASSERT_EQ(capstan_late_bind_next(other, so_far.data(), so_far.size(), 2, 1, 600'000), CAPSTAN_LATE_OK)
      << capstan_late_message(other);
  EXPECT_EQ(capstan_late_output(other, CAPSTAN_LATE_LINUXCNC, nullptr), second);
  EXPECT_EQ(capstan_late_bind_next(s, nullptr, 0, 3, 1, 600'000), CAPSTAN_LATE_IMPOSSIBLE);
  capstan_late_close(other);
  capstan_late_close(s);
  capstan_late* none = capstan_late_create();
  EXPECT_EQ(capstan_late_bind_next(none, nullptr, 0, 0, 1, 1000), CAPSTAN_LATE_USAGE);
  capstan_late_close(none);
}

}  // namespace
}  // namespace capstan::late
