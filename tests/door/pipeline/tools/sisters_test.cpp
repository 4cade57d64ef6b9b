#include "planner/door/pipeline/tools/sisters.h"

#include <gtest/gtest.h>

#include <string>
#include <string_view>
#include <vector>

#include "planner/controls/controls.h"
#include "planner/proof/verify/plan/plan_checks.h"
#include "tests/support/empty_plan.h"
#include "tooling/library/nouns/nouns.h"

namespace capstan::pipeline {
namespace {

using model::Cutter;
using model::Plan;

/// The 18 mm mill of empty_plan, loaded as T1, its edges good for 30 min; and another one as T7, measured
/// 1.5 mm shorter.
std::vector<Cutter> two_mills(const Plan& plan) {
  Cutter first = plan.cutters[0];
  first.loaded = true;
  first.life_min = 30.0;
  first.stick_out_mm = 40.0;
  Cutter second = first;
  second.id = "em18 b";
  second.pocket = 7;
  second.functional_length_mm -= 1.5;
  return {first, second};
}

/// Steps that cut so many minutes with T1, which planning chose.
Plan milled(const std::vector<double>& minutes) {
  Plan plan = testing::empty_plan();
  plan.cutters[0] = two_mills(plan)[0];
  for (std::size_t i = 0; i < minutes.size(); ++i) {
    model::CutterPath p;
    p.start({10, 10, 20});
    p.line({90, 10, 20}, model::MoveRole::kCut);
    p.rapid({90, 10, 30}, model::MoveRole::kRetract);
    auto& step = testing::add_step(plan, "step " + std::to_string(i + 1), "em18", p);
    step.cutting_s = 60.0 * minutes[i];
    model::BottomAndSideRoughMilling op;
    op.its_tool = tooling::tool_noun(plan.model, plan.cutters[0]);
    const auto added = plan.model.add(op);
    plan.model.get<model::MachiningWorkingstep>(step.step)->its_operation = added;
    plan.ledger.bind(added, "its_tool", model::Binder::kToolSelection, {"test", "chosen", "test"});
  }
  return plan;
}

std::vector<std::string> tools(const Plan& plan) {
  std::vector<std::string> out;
  for (const auto& s : plan.steps) out.push_back(s.cutter_id);
  return out;
}
using Ids = std::vector<std::string>;

TEST(Sisters, TheStepInWhichTheLifeWouldEndAndThoseBehindItAreTheSisters) {
  Plan plan = milled({12, 12, 12, 12});
  Job job;
  share_among_sisters(plan, two_mills(plan), {}, job);
  EXPECT_EQ(tools(plan), (Ids{"em18", "em18", "em18 b", "em18 b"}));
  ASSERT_EQ(plan.cutters.size(), 3U);
  const Cutter& sister = plan.cutters.back();
  EXPECT_EQ(sister.pocket, 7);
  EXPECT_EQ(sister.functional_length_mm, 48.5);
  ASSERT_EQ(sister.sisters.size(), 1U);
  EXPECT_EQ(sister.sisters[0].id, "em18");
  ASSERT_EQ(job.diagnostics().size(), 1U);
  EXPECT_EQ(job.diagnostics()[0].code, "PIP-SISTER");
  EXPECT_NE(job.diagnostics()[0].message.find("step 'step 3' calls T7 'em18 b' in place of T1 'em18'"),
            std::string::npos)
      << job.diagnostics()[0].message;
  // 36 min by the end of the third.
  EXPECT_NE(job.diagnostics()[0].message.find("36 min"), std::string::npos);
  // The operation names the sister, and why.
  const auto op = plan.model.get<model::MachiningWorkingstep>(plan.steps[2].step)->its_operation;
  const auto* d = plan.ledger.find(op, "its_tool");
  ASSERT_NE(d, nullptr);
  Job silent;
  const auto read = tooling::cutter_from_nouns(
      plan.model, plan.model.get<model::MachiningOperation>(op)->its_tool, silent, plan.cutters);
  ASSERT_TRUE(read);
  EXPECT_EQ(read->id, "em18 b");
  EXPECT_EQ(read->pocket, 7);
}

TEST(Sisters, ALifeThatLastsChangesNothingAndNorDoesAToolThatAFileGave) {
  Plan lasts = milled({12, 12});
  Job job;
  share_among_sisters(lasts, two_mills(lasts), {}, job);
  EXPECT_EQ(tools(lasts), (Ids{"em18", "em18"}));
  EXPECT_EQ(lasts.cutters.size(), 2U);
  Plan given = milled({20, 20});
  given.ledger.bind(given.model.get<model::MachiningWorkingstep>(given.steps[1].step)->its_operation,
                    "its_tool", model::Binder::kGiven, {"given", "in the file", "file"});
  share_among_sisters(given, two_mills(given), {}, job);
  EXPECT_EQ(tools(given), (Ids{"em18", "em18"}));
}

TEST(Sisters, WhatTheStepsRecordOfTheirEdgesCountsWhereNoLifeIsStated) {
  Plan plan = milled({20, 20});
  for (auto& s : plan.steps) s.loads.tool_life_min = 25.0;
  std::vector<Cutter> library = two_mills(plan);
  for (Cutter& c : library) c.life_min = 0.0;
  plan.cutters[0].life_min = 0.0;
  Job job;
  share_among_sisters(plan, library, {}, job);
  EXPECT_EQ(tools(plan), (Ids{"em18", "em18 b"}));
}

TEST(Sisters, OneStepThatIsLongerThanALifeKeepsItsTool) {
  Plan plan = milled({40});
  Job job;
  share_among_sisters(plan, two_mills(plan), {}, job);
  EXPECT_EQ(tools(plan), (Ids{"em18"}));
}

// A step has no tool that an operator forbids there: its own stays, and the check says that its life is over.
TEST(Sisters, AreNotGivenToStepsThatAreKeptOffThem) {
  model::Edit off;
  off.kind = model::EditKind::kForbid;
  off.of = model::EditOf::kTool;
  off.value = "T7";
  const auto with = [&](const std::string& where, const std::vector<double>& minutes, bool third = false) {
    Plan plan = milled(minutes);
    auto library = two_mills(plan);
    if (third) {
      library.push_back(library[1]);
      library.back().id = "em18 c";
      library.back().pocket = 8;
    }
    off.where = where;
    Job job;
    share_among_sisters(plan, library, {off}, job);
    return tools(plan);
  };
  EXPECT_EQ(with("step 2", {20, 20}), (Ids{"em18", "em18"}));
  EXPECT_EQ(with("step 2", {20, 20}, true), (Ids{"em18", "em18 c"}));
  EXPECT_EQ(with("step 3", {20, 10.5, 10}), (Ids{"em18", "em18 b", "em18"}));
  EXPECT_EQ(with("step 9", {20, 20}), (Ids{"em18", "em18 b"}));
}

TEST(Sisters, WhoseOwnLifeLastsForTheStepComeFirst) {
  Plan plan = milled({20, 20});
  auto library = two_mills(plan);
  library.push_back(library[1]);
  library[1].life_used_min = 28.5;
  library[2].id = "em18 c";
  library[2].pocket = 8;
  Job job;
  share_among_sisters(plan, library, {}, job);
  EXPECT_EQ(tools(plan), (Ids{"em18", "em18 c"}));
}

TEST(Sisters, TakeTheFirstStepOfAToolThatIsWornAlready) {
  Plan plan = milled({12, 12});
  auto library = two_mills(plan);
  plan.cutters[0].life_used_min = library[0].life_used_min = 28.5;
  Job job;
  share_among_sisters(plan, library, {}, job);
  EXPECT_EQ(tools(plan), (Ids{"em18 b", "em18 b"}));
}

TEST(Sisters, AreOfTheSameSizesAndMayDifferInLength) {
  const Plan plan = milled({1});
  const auto mills = two_mills(plan);
  EXPECT_TRUE(is_sister(mills[1], mills[0]));
  const auto other = [&](auto change) {
    Cutter c = mills[1];
    change(c);
    return is_sister(c, mills[0]);
  };
  EXPECT_FALSE(other([](Cutter& c) { c.cutting_diameter_mm += 0.01; }));
  EXPECT_TRUE(other([](Cutter& c) { c.cutting_diameter_mm += 0.0005; }));
  EXPECT_FALSE(other([](Cutter& c) { c.corner_radius_mm = 1.0; }));
  EXPECT_FALSE(other([](Cutter& c) { c.stick_out_mm += 5.0; }));
  EXPECT_FALSE(other([](Cutter& c) { c.loaded = false; }));
  EXPECT_FALSE(other([](Cutter& c) { c.pocket = 1; }));
  EXPECT_FALSE(other([](Cutter& c) { c.life_used_min = 30.0; }));
  EXPECT_FALSE(other([](Cutter& c) { c.teeth = 9; }));
}

TEST(Sisters, AreCalledAndNamedInTheProgram) {
  for (const char* control : {"linuxcnc", "fanuc", "heidenhain"}) {
    Plan plan = milled({20, 20});
    Job job;
    share_among_sisters(plan, two_mills(plan), {}, job);
    plan.machine = controls::with_control(plan.machine, control);
    plan.setups[0].work_offset = controls::find_dialect(control)->work_offsets.front();
    const auto text = controls::write_program(plan, job);
    ASSERT_TRUE(text) << to_text(text.error());
    std::string lower = *text;
    for (char& c : lower) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    EXPECT_NE(lower.find("t7: a sister of t1"), std::string::npos) << control << "\n" << *text;
    EXPECT_NE(lower.find("n=2 tool=7 setup=1"), std::string::npos) << control;
    EXPECT_NE(text->find(std::string_view(control) == "heidenhain" ? "TOOL CALL 7 Z" : "T7 M6"),
              std::string::npos)
        << control;
  }
}

TEST(Sisters, ThatAreNotWhatTheyStandForAreFound) {
  const auto said = [](const Plan& plan) {
    verify::Findings found;
    verify::check_sisters(plan, found);
    std::string out;
    for (const auto& f : found.take()) out += f.code + " " + f.message + "\n";
    return out;
  };
  Plan plan = milled({20, 20});
  Job job;
  share_among_sisters(plan, two_mills(plan), {}, job);
  EXPECT_EQ(said(plan), "");
  Plan thin = plan;
  thin.cutters.back().cutting_diameter_mm = 17.9;
  EXPECT_NE(said(thin).find("its diameter, 17.9 mm in place of 18 mm"), std::string::npos) << said(thin);
  Plan away = plan;
  away.cutters.back().pocket = 1;
  EXPECT_NE(said(away).find("not loaded under a number of its own"), std::string::npos);
}

}  // namespace
}  // namespace capstan::pipeline
