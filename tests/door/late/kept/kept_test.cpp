#include "planner/door/late/kept/kept.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include "casebase/casebase.h"
#include "planner/door/late/late.h"
#include "planner/door/pipeline/cases/corrected_card.h"
#include "planner/model/nouns/all.h"
#include "planner/model/plan/resources/by_cases.h"
#include "planner/model/plan/resources/specific_force.h"
#include "tests/door/late/brought.h"
#include "tests/support/differences/subjects.h"
#include "tests/support/soak.h"
#include "tooling/library/nouns/nouns.h"

namespace capstan::late {
namespace {

const std::string kBracket = capstan::testing::source_dir() + "/examples/bracket.p21";

const LatePolicy kInTime = {.deadline = std::nullopt};

const Brought& bracket() {
  static const Brought kBrought = brought(kBracket, pipeline::Format::kJson);
  return kBrought;
}

/// Paths and feeds of two plans, step by step.
void expect_same_steps(const model::Plan& a, const model::Plan& b) {
  ASSERT_EQ(a.steps.size(), b.steps.size());
  for (std::size_t i = 0; i < a.steps.size(); ++i) {
    EXPECT_TRUE(*a.steps[i].path == *b.steps[i].path) << i;
    EXPECT_TRUE(*a.steps[i].schedule == *b.steps[i].schedule) << i;
    EXPECT_EQ(a.steps[i].feed_mm_min, b.steps[i].feed_mm_min) << i;
    EXPECT_EQ(a.steps[i].loads, b.steps[i].loads) << i;
  }
}

TEST(LateKept, AToolOfAnotherLengthPlansNothingAndIsChecked) {
  for (const auto format : {pipeline::Format::kJson, pipeline::Format::kAp238}) {
    const Brought early = brought(kBracket, format);
    const int mill = eight_mill(early.plan);
    const std::string line = "T" + std::to_string(mill) + " ";
    for (const double by : {0.5, -0.5}) {
      Job job;
      const std::string table = with(early.table, mill, "Z", by);
      const auto bound = bind(early.plan, shop_of(table), kInTime, job);
      ASSERT_TRUE(bound) << to_text(bound.error());
      EXPECT_TRUE(bound->kept);
      EXPECT_FALSE(bound->improved);
      expect_same_steps(bound->plan, early.plan);
      EXPECT_FALSE(bound->program.text.empty());
      EXPECT_NE(bound->program.tool_table.find(table.substr(table.find(line), 14)), std::string::npos);
    }
  }
}

// A surface's plan lists the operations of steps that were left out: once their tools, which nobody loads,
// made a bind plan it anew.
TEST(LateKept, AnOperationThatNoWorkingstepExecutesNeedsNoTool) {
  model::Plan plan = bracket().plan;
  const auto* ws = plan.model.get<model::MachiningWorkingstep>(plan.steps[2].step);
  ASSERT_NE(ws, nullptr);
  const std::string mill = std::to_string(eight_mill(plan));
  const auto other = std::find_if(plan.cutters.begin(), plan.cutters.end(), [&](const model::Cutter& c) {
    return c.cutter_class == model::CutterClass::kTwistDrill;
  });
  ASSERT_NE(other, plan.cutters.end());
  const auto left_out = plan.model.add<model::Drilling>({});
  model::Cutter drill = *other;
  drill.id = "left out";
  drill.cutting_diameter_mm = 3.141;
  plan.model.get<model::MachiningOperation>(left_out)->its_id = "left out";
  plan.model.get<model::MachiningOperation>(left_out)->its_tool = tooling::tool_noun(plan.model, drill);
  plan.model.get<model::ManufacturingFeature>(ws->its_feature)->its_operations.items.push_back(left_out);
  Job job;
  const auto bound = bind(plan, shop_of(with(bracket().table, std::stoi(mill), "Z", 0.5)), kInTime, job);
  ASSERT_TRUE(bound) << to_text(bound.error());
  EXPECT_TRUE(bound->kept);
}

TEST(LateKept, AToolInAnotherPlaceIsCalledThere) {
  std::string table = bracket().table;
  const std::string number = std::to_string(eight_mill(bracket().plan));
  const std::string line = "T" + number + " P" + number;
  table.replace(table.find(line), line.size(), "T12 P12");
  Job job;
  const auto bound = bind(bracket().plan, shop_of(table), kInTime, job);
  ASSERT_TRUE(bound) << to_text(bound.error());
  EXPECT_TRUE(bound->kept);
  EXPECT_NE(bound->program.text.find("T12 "), std::string::npos);
  EXPECT_EQ(bound->program.text.find("T" + number + " "), std::string::npos);
  for (const model::StepResult& s : bound->plan.steps) {
    const auto* ws = bound->plan.model.get<model::MachiningWorkingstep>(s.step);
    const auto* op =
        ws == nullptr ? nullptr : bound->plan.model.get<model::MachiningOperation>(ws->its_operation);
    if (op == nullptr) continue;
    const auto* usage = bound->plan.model.get<model::ToolUsage>(
        bound->plan.model.at<model::MachiningTool>(op->its_tool).its_usage);
    const model::Cutter* c = model::find_cutter(bound->plan, s.cutter_id);
    EXPECT_EQ(usage->its_position, std::to_string(c->pocket));
  }
}

TEST(LateKept, APlanThatTheCheckCondemnsAsItIsIsMadeAnew) {
  // So short that the holder would run into the slot: the path holds no more.
  const int mill = eight_mill(bracket().plan);
  Job job;
  const auto bound = bind(bracket().plan, shop_of(with(bracket().table, mill, "Z", -40.0)), kInTime, job);
  EXPECT_TRUE(!bound || !bound->kept);
}

TEST(LateKept, AnotherMachineMaterialOrDiameterIsPlannedFor) {
  const auto kept = [](pipeline::Inputs in) {
    Job job;
    const auto bound = bind(bracket().plan, std::move(in), kInTime, job);
    EXPECT_TRUE(bound) << (bound ? "" : to_text(bound.error()));
    return bound && bound->kept;
  };
  pipeline::Inputs in = shop_of(bracket().table);
  EXPECT_TRUE(kept(in));
  pipeline::Inputs slower = in;
  slower.machine.tool_change_s += 1.0;
  EXPECT_FALSE(kept(slower));
  pipeline::Inputs harder = in;
  for (model::WorkMaterial& m : harder.materials)
    if (m.id == bracket().plan.material.id) m.kc11_n_mm2 *= 1.001;
  EXPECT_FALSE(kept(harder));
  EXPECT_FALSE(kept(shop_of(with(bracket().table, eight_mill(bracket().plan), "D", -0.05))));
}

TEST(LateKept, APlanWithSomethingOpenIsPlanned) {
  model::Plan plan = bracket().plan;
  for (const auto at : plan.model.all_below(model::TypeId::kMachiningWorkingstep)) {
    const auto* ws = plan.model.get<model::MachiningWorkingstep>(at);
    const auto technology = plan.model.at<model::MachiningOperation>(ws->its_operation).its_technology;
    if (technology.set()) plan.ledger.reopen({technology, "feedrate"});
  }
  Job job;
  const auto bound = bind(plan, shop_of(bracket().table), kInTime, job);
  ASSERT_TRUE(bound) << to_text(bound.error());
  EXPECT_FALSE(bound->kept);
}

TEST(LateKeptProperty, WhateverChangedTheFindingsAreThoseOfAWholeCheck) {
  pipeline::Inputs first = shop_of(bracket().table);
  const auto proofs = std::make_shared<memo::Memo>(), memo = std::make_shared<memo::Memo>();
  int bound_to_end = 0, at = 0;
  for (int tool = 1; tool <= tools(bracket()); ++tool) {
    for (const std::string& table :
         {with(bracket().table, tool, "Z", 0.25), with(bracket().table, tool, "Z", -0.25),
          with(bracket().table, tool, "D", -0.05), without(bracket().table, tool)}) {
      // Of a sample every second table, beginning with another for each tool.
      if (!soaking() && (at++ + tool) % 2 == 0) continue;
      pipeline::Inputs in = shop_of(table);
      in.proofs = proofs;
      in.memo = memo;
      Job job;
      const auto bound = bind(bracket().plan, std::move(in), kInTime, job);
      if (!bound) continue;
      ++bound_to_end;
      Job whole;
      EXPECT_EQ(testing::subjects(bound->findings),
                testing::subjects(pipeline::findings_of(bound->plan, whole)))
          << tool << "\n"
          << table;
    }
  }
  EXPECT_GT(bound_to_end, rounds(1, 2) * tools(bracket()));
  EXPECT_GT(proofs->counts(memo::Stage::kSweep).found, proofs->counts(memo::Stage::kSweep).made);
}

TEST(LateKept, EachBindingIsARowOfThePlansRecordInEveryForm) {
  for (const auto format : {pipeline::Format::kJson, pipeline::Format::kAp238, pipeline::Format::kIso14649}) {
    const Brought early = brought(kBracket, pipeline::Format::kJson);
    LatePolicy policy = kInTime;
    policy.time = "2026-11-25T12:00:00Z";
    Job job;
    auto once = bind(early.plan, shop_of(early.table), policy, job);
    ASSERT_TRUE(once) << to_text(once.error());
    const auto text = pipeline::write_plan(once->plan, format, job);
    ASSERT_TRUE(text);
    auto again = pipeline::read_plan(*text, "plan", job);
    ASSERT_TRUE(again) << to_text(again.error());
    policy.time = "2026-11-25T13:00:00Z";
    const auto twice =
        bind(*again, shop_of(with(early.table, eight_mill(early.plan), "Z", 0.5)), policy, job);
    ASSERT_TRUE(twice) << to_text(twice.error());
    std::vector<model::Provenance> rows;
    for (const auto& p : twice->plan.provenance)
      if (p.what.starts_with("late binding ")) rows.push_back(p);
    ASSERT_EQ(rows.size(), 2U);
    EXPECT_EQ(rows[0].what, "late binding 1");
    EXPECT_EQ(rows[0].value, "2026-11-25T12:00:00Z");
    EXPECT_EQ(rows[1].value, "2026-11-25T13:00:00Z");
    EXPECT_NE(rows[0].source, rows[1].source) << "one tool has another length";
    EXPECT_EQ(rows[0].source.substr(0, rows[0].source.find(", tools")),
              rows[1].source.substr(0, rows[1].source.find(", tools")))
        << "the machine is the same";
  }
}

/// The plan with a force that cases are said to have put into its card.
model::Plan by_cases(model::Plan plan) {
  const auto* own = model::measured_set(plan.material, model::Substrate::kCarbide);
  EXPECT_NE(own, nullptr);
  model::MechanisticSet set = *own;
  set.ktc_n_mm2 *= 0.8;
  set.source.assign(model::kByCases);
  plan.material.mechanistic.insert(plan.material.mechanistic.begin(), set);
  return plan;
}

TEST(LateKept, WhatCasesSaidOfTheCardIsNotKeptWithoutThemAndThatIsTold) {
  const model::Plan plan = by_cases(bracket().plan);
  Job job;
  const auto bound = bind(plan, shop_of(bracket().table), kInTime, job);
  ASSERT_TRUE(bound) << to_text(bound.error());
  EXPECT_FALSE(bound->kept);
  EXPECT_FALSE(model::corrected_by_cases(bound->plan.material));
  EXPECT_EQ(bound->plan.material, bracket().plan.material);
  EXPECT_TRUE(std::any_of(job.diagnostics().begin(), job.diagnostics().end(), [](const Diagnostic& d) {
    return d.code == "CASE-MODEL" && d.severity == Severity::kWarning;
  }));
}

TEST(LateKept, ACardOfCasesThatSayNothingMoreIsNotKept) {
  const std::string file = capstan::testing::scratch_file("late_cases.db");
  std::remove(file.c_str());
  Job job;
  pipeline::Inputs in = shop_of(bracket().table);
  auto base = casebase::CaseBase::open_or_create(file, job);
  ASSERT_TRUE(base);
  in.cases = std::make_shared<casebase::CaseBase>(*std::move(base));
  const auto plain = bind(bracket().plan, in, kInTime, job);
  ASSERT_TRUE(plain) << to_text(plain.error());
  EXPECT_TRUE(plain->kept);  // cases that change nothing
  const auto bound = bind(by_cases(bracket().plan), in, kInTime, job);
  ASSERT_TRUE(bound) << to_text(bound.error());
  EXPECT_FALSE(bound->kept);
  EXPECT_EQ(bound->plan.material, bracket().plan.material);
}

/// A bracket's mills as cut on four edges with nine tenths of the force that was expected.
std::vector<casebase::Case> measured_cuts() {
  Job job;
  std::vector<casebase::Case> out;
  for (int edge = 0; edge < 4; ++edge) {
    for (casebase::Case c : casebase::cases_of(bracket().plan, job)) {
      if (!(c.predicted.specific_force_n_mm2 > 0.0)) continue;
      c.origin = casebase::Origin::kMeasured;
      c.observed = {};
      c.observed.peak_force_n = casebase::Figure{.value = (0.9 + 0.01 * edge) * c.predicted.peak_force_n /
                                                          c.predicted.force_margin};
      c.observed.executed_fz_mm = casebase::Figure{.value = c.predicted.held_fz_mm};
      c.from.tool_instance = "E" + std::to_string(edge);
      c.from.part = std::to_string(edge);
      c.from.source = "log";
      out.push_back(c);
    }
  }
  return out;
}

TEST(LateKept, APlanWhoseCardStandsByTheseCasesIsHeldAgainstTheirHeadsAlone) {
  const std::string file = capstan::testing::scratch_file("late_state.db");
  std::remove(file.c_str());
  Job job;
  pipeline::Inputs in = shop_of(bracket().table);
  auto base = casebase::CaseBase::open_or_create(file, job);
  ASSERT_TRUE(base);
  ASSERT_TRUE(base->add(measured_cuts()));
  in.cases = std::make_shared<casebase::CaseBase>(*std::move(base));
  const auto corrected =
      pipeline::corrected_card(*in.cases, bracket().plan.material, bracket().plan.machine.id);
  ASSERT_TRUE(model::corrected_by_cases(corrected.card));
  model::Plan plan = bracket().plan;
  plan.material = corrected.card;
  plan.provenance.insert(plan.provenance.end(), corrected.rows.begin(), corrected.rows.end());
  const auto kept = [&] {
    Job quiet;
    const auto bound = bind(plan, in, kInTime, quiet);
    EXPECT_TRUE(bound) << to_text(bound.error());
    return bound && bound->kept;
  };
  EXPECT_TRUE(kept());
  // The record alone is asked: what it says of the card as it is.
  const auto state = [&](const model::WorkMaterial& card) {
    return pipeline::state_of_card(*in.cases, card, plan.machine.id);
  };
  const auto row = std::find_if(plan.provenance.begin(), plan.provenance.end(),
                                [](const auto& p) { return p.what == pipeline::kCardByCases; });
  ASSERT_NE(row, plan.provenance.end());
  EXPECT_EQ(row->value, state(plan.material));
  model::WorkMaterial altered = plan.material;
  altered.mechanistic.front().ktc_n_mm2 *= 0.99;
  EXPECT_NE(row->value, state(altered));
  EXPECT_NE(row->value, state(bracket().plan.material));
  plan.material = altered;
  EXPECT_FALSE(kept()) << "a card that somebody altered in the file";
  plan.material = corrected.card;
  // Another case of this machine and material, and a verdict on one, are other cases; those elsewhere are
  // not.
  auto again = casebase::CaseBase::open(file, job);
  ASSERT_TRUE(again);
  casebase::Case elsewhere = measured_cuts().front();
  elsewhere.asked.machine_class = "another";
  ASSERT_TRUE(again->add(elsewhere));
  EXPECT_EQ(pipeline::state_of_card(*again, plan.material, plan.machine.id), row->value);
  casebase::Case more = measured_cuts().front();
  more.from.part = "further";
  ASSERT_TRUE(again->add(more));
  EXPECT_NE(pipeline::state_of_card(*again, plan.material, plan.machine.id), row->value);
}

}  // namespace
}  // namespace capstan::late
