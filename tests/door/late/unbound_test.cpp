#include "planner/door/late/unbound.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>
#include <string>

#include "planner/door/late/late.h"
#include "planner/door/late/next.h"
#include "planner/door/service/check.h"
#include "planner/making/given/listed_steps.h"
#include "planner/model/nouns/all.h"
#include "planner/model/plan/decision/fresh_edits.h"
#include "tests/door/late/brought.h"

// Plans of which some steps are bound: what a check says of them, and what is bound after an edit.

namespace capstan::late {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

const std::string kBracket = capstan::testing::source_dir() + "/examples/bracket.p21";

LatePolicy next(std::size_t count, std::optional<std::size_t> from = std::nullopt) {
  LatePolicy p;
  p.deadline.reset();
  p.budget = p.fallback_budget;  // no improvement
  p.next = Next{count, from};
  return p;
}

/// The bracket with one step bound, and with two more; what the machine got for these.
struct Bound {
  model::Plan one, three;
  std::string second_program, table;
};
const Bound& bound() {
  static const Bound kBound = [] {
    Bound out;
    out.table = brought(kBracket, pipeline::Format::kJson).table;
    Job job;
    auto read = pipeline::read_plan(testing::slurp(kBracket), kBracket, job);
    const auto open = pipeline::bind(*std::move(read), shop({}), {.bind = pipeline::Bind::kStrategy}, job);
    EXPECT_TRUE(open) << to_text(open.error());
    const auto first = bind(*open, shop_of(out.table), next(1), job);
    EXPECT_TRUE(first) << to_text(first.error());
    out.one = first->plan;
    const auto then = bind(out.one, shop_of(out.table), next(2), job);
    EXPECT_TRUE(then) << to_text(then.error());
    out.three = then->plan;
    out.second_program = then->program.text;
    return out;
  }();
  return kBound;
}

std::string json_of(const model::Plan& plan) {
  Job job;
  auto text = pipeline::write_plan(plan, pipeline::Format::kJson, job);
  EXPECT_TRUE(text);
  return text.value_or(std::string());
}

/// What `capstan check` says of these files.
struct Said {
  std::string errors, all;
  bool unproved = false;
};
Said checked(const std::string& json, const std::string& program) {
  std::vector<service::Source> sources;
  sources.push_back({"plan.json", json});
  if (!program.empty()) sources.push_back({"part.ngc", program});
  Job job;
  const service::Request request = pipeline::kAsksNothing;
  const auto result = service::check(request, std::move(sources), {}, job);
  Said out;
  EXPECT_TRUE(result);
  if (!result) return out;
  for (const auto& f : result->findings) {
    const std::string line = f.finding.code + ": " + f.finding.message + "\n";
    out.all += line;
    if (f.finding.severity == Severity::kError) out.errors += line;
    out.unproved = out.unproved || f.finding.unproved;
  }
  return out;
}

TEST(PartlyBound, TheCheckJudgesWhatIsBoundAndNamesWhatIsNot) {
  const std::size_t steps = given::steps_in_order(bound().three).size();
  ASSERT_GT(steps, 4U);
  EXPECT_EQ(unbound_steps(bound().three).size(), steps - 3);
  const Said plan = checked(json_of(bound().three), {});
  EXPECT_EQ(plan.errors, "");
  EXPECT_THAT(plan.all, HasSubstr("CHK-NOT-BOUND: workingsteps 4 to " + std::to_string(steps)));
  EXPECT_TRUE(plan.unproved);  // so that nobody reads "Safe" of the whole
}

TEST(PartlyBound, ItsProgramIsHeldAgainstTheStepsThatItHas) {
  const Said both = checked(json_of(bound().three), bound().second_program);
  EXPECT_EQ(both.errors, "");
  EXPECT_THAT(both.all,
              HasSubstr("the program has workingsteps 2 to 3 of the plan; workingstep 1 is taken as cut"));
}

TEST(PartlyBound, AFaultInWhatIsBoundIsFoundInPlanAndProgram) {
  model::Plan deeper = bound().three;
  auto path = std::make_shared<model::CutterPath>(*deeper.steps[1].path);
  for (double& z : path->z) z -= 3.0;
  deeper.steps[1].path = path;
  EXPECT_THAT(checked(json_of(deeper), {}).errors, HasSubstr("CHK-GOUGE"));
  std::string program = bound().second_program;
  const auto at = program.find("G1 Z");
  ASSERT_NE(at, std::string::npos);
  program.insert(at, "G1 X50 Y40 Z-29 F100\n");
  EXPECT_NE(checked(json_of(bound().three), program).errors, "");
}

TEST(PartlyBound, AStepThatIsMissingAmongTheBoundIsNotTakenForOneToCome) {
  model::Plan without = bound().three;
  without.steps.erase(without.steps.begin() + 1);
  EXPECT_TRUE(unbound_steps(without).empty());
  EXPECT_NE(checked(json_of(without), {}).errors, "");
  // Of a whole plan the last step's result is gone; nothing of the step is open.
  Job job;
  model::Plan whole = brought(kBracket, pipeline::Format::kJson).plan;
  EXPECT_TRUE(unbound_steps(whole).empty());
  whole.steps.pop_back();
  EXPECT_TRUE(unbound_steps(whole).empty());
}

/// The plan as it is read after its text was edited.
model::Plan edited(const model::Plan& plan, const std::string& attribute, std::size_t step) {
  model::Plan changed = plan;
  Job job;
  auto read = pipeline::read_plan(json_of(changed), "plan.json", job);
  EXPECT_TRUE(read);
  const auto* ws = read->model.get<model::MachiningWorkingstep>(read->steps[step].step);
  const auto* op = read->model.get<model::MachiningOperation>(ws->its_operation);
  // As a reader finds it that meets another value than its record's.
  model::Decision d;
  d.binder = model::Binder::kGiven;
  d.reason = read->ledger.reason({std::string(model::kEditedReason), "edited", "the file"});
  if (attribute == "feedrate") {
    read->model.at<model::MillingTechnology>(op->its_technology).feedrate = 123.0;
    read->ledger.set({op->its_technology, attribute}, d);
  } else {
    read->ledger.set({ws->its_operation, attribute}, d);
  }
  return *std::move(read);
}

TEST(PartlyBound, AnEditedStepThatWasBoundIsRefusedWithItsAttribute) {
  const pipeline::Inputs in = shop_of(bound().table);
  for (const auto from : {std::optional<std::size_t>(), std::optional<std::size_t>(4)}) {
    Job job;
    const auto refused = bind(edited(bound().three, "feedrate", 1), in, next(1, from), job);
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().code, "LATE-EDITED") << to_text(refused.error());
    EXPECT_THAT(refused.error().message, HasSubstr("workingstep 2 "));
    EXPECT_THAT(refused.error().message, HasSubstr("feedrate of MILLING_TECHNOLOGY"));
    EXPECT_THAT(refused.error().hint, HasSubstr("--from 2"));
  }
}

TEST(PartlyBound, TheEditedStepItselfMayBeBoundAgainAndThenNothingIsEdited) {
  Job job;
  const auto again = bind(edited(bound().three, "feedrate", 2), shop_of(bound().table), next(1, 3), job);
  ASSERT_TRUE(again) << to_text(again.error());
  EXPECT_EQ(again->first, 3U);
  EXPECT_TRUE(model::fresh_edits(again->plan.ledger).empty());
  const auto then = bind(again->plan, shop_of(bound().table), next(1, 4), job);
  ASSERT_TRUE(then) << to_text(then.error());
}

TEST(PartlyBound, AnEditOfAWrittenPlanIsFreshUntilThePlanIsBound) {
  std::string text = json_of(bound().three);
  const auto* ws = bound().three.model.get<model::MachiningWorkingstep>(bound().three.steps[1].step);
  const auto* op = bound().three.model.get<model::MachiningOperation>(ws->its_operation);
  const auto* tech = bound().three.model.get<model::MillingTechnology>(op->its_technology);
  ASSERT_TRUE(tech->feedrate);
  Job job;
  auto read = pipeline::read_plan(text, "plan.json", job);
  ASSERT_TRUE(read);
  EXPECT_TRUE(model::fresh_edits(read->ledger).empty());
  // The record of the feed speaks of another value than the file has now.
  const auto key = text.find("\"attribute\": \"feedrate\"") != std::string::npos
                       ? "\"attribute\": \"feedrate\""
                       : "\"attribute\":\"feedrate\"";
  const auto at = text.find(key);
  ASSERT_NE(at, std::string::npos);
  const auto hash = text.find("\"value_hash\"", at);
  const auto digit = text.find('"', text.find(':', hash)) + 1;
  text[digit] = text[digit] == '0' ? '1' : '0';
  auto edit = pipeline::read_plan(text, "plan.json", job);
  ASSERT_TRUE(edit);
  EXPECT_EQ(model::fresh_edits(edit->ledger).size(), 1U);
  // Whoever writes the plan anew, as JSON or as another form, has not bound it with the edit.
  for (const auto format : {pipeline::Format::kJson, pipeline::Format::kIso14649, pipeline::Format::kAp238}) {
    auto written = pipeline::write_plan(*edit, format, job);
    ASSERT_TRUE(written) << to_text(written.error());
    auto later = pipeline::read_plan(*std::move(written), "plan", job);
    ASSERT_TRUE(later) << to_text(later.error());
    EXPECT_EQ(model::fresh_edits(later->ledger).size(), 1U) << static_cast<int>(format);
    if (format == pipeline::Format::kJson) {
      const auto refused = bind(*later, shop_of(bound().table), next(1, 4), job);
      ASSERT_FALSE(refused);
      EXPECT_EQ(refused.error().code, "LATE-EDITED");
    }
    const auto planned = pipeline::bind(*later, shop_of(bound().table), {}, job);
    ASSERT_TRUE(planned) << to_text(planned.error());
    EXPECT_TRUE(model::fresh_edits(planned->ledger).empty());
  }
}

}  // namespace
}  // namespace capstan::late
