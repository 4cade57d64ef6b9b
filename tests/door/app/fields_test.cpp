#include <gtest/gtest.h>

#include "planner/door/app/diff/diff.h"
#include "planner/making/step/cut/cuts.h"
#include "planner/model/plan/cutter/cutter_faults.h"
#include "planner/model/plan/cutter/cutter_fields.h"
#include "planner/model/plan/plan_fields.h"
#include "planner/model/plan/resources/machine_fields.h"
#include "planner/model/plan/resources/material_fields.h"
#include "planner/physics/mechanics/bending/beam.h"
#include "planner/physics/mechanics/force/force_law.h"
#include "tests/door/app/plans.h"
#include "tests/support/shop.h"
#include "tooling/library/formats/all.h"
#include "tooling/library/formats/import.h"
#include "tooling/library/formats/own/own_list.h"
#include "tooling/library/store/store.h"

// Every field of the tables, with a value unlike its default, comes back from each form.

namespace capstan::app {
namespace {

using model::Cutter;
using model::for_each_field;
using model::Unit;

/// Gives every field of what has a table a value that no field before had. Lengths rise in the table's order.
class Filler {
 public:
  template <model::HasFields S>
  void fill(S& x) {
    for_each_field(x, [&](const auto& row, auto& v) {
      ++n_;
      give(row.unit, v);
    });
  }

 private:
  template <class T>
  void give(Unit unit, T& v) {
    if constexpr (std::is_same_v<T, double>) {
      v = unit == Unit::kAngle ? 0.1 + 0.01 * n_ : unit == Unit::kNone ? 2.0 + 0.125 * n_ : 20.0 + 0.5 * n_;
    } else if constexpr (std::is_same_v<T, int>) {
      v = 2 + n_;
    } else if constexpr (std::is_same_v<T, std::size_t>) {
      v = 1;  // a place among set-ups: the second
    } else if constexpr (std::is_same_v<T, bool>) {
      v = !v;
    } else if constexpr (IsText<T>) {
      v = "text " + std::to_string(n_);
    } else if constexpr (std::is_same_v<T, model::CutterClass>) {
      v = model::CutterClass::kTaperedEndmill;
    } else if constexpr (std::is_same_v<T, model::Substrate>) {
      v = model::Substrate::kHss;
    } else if constexpr (std::is_same_v<T, model::Hand>) {
      v = model::Hand::kLeft;
    } else if constexpr (std::is_same_v<T, std::pair<std::string, std::string>>) {
      v = {"of " + std::to_string(n_), "stated: here"};
    } else if constexpr (model::HasFields<T>) {
      fill(v);
    } else if constexpr (
        requires { v.set(); } || requires { v.use_count(); }) {
      // nouns and shared columns stay as they are
    } else if constexpr (requires { v.emplace_back(); }) {
      v.clear();
      give(unit, v.emplace_back());
    } else if constexpr (requires { v.emplace(); }) {
      give(unit, v.emplace());
    } else {
      for (auto& item : v) give(unit, item);
    }
  }
  int n_ = 0;
};

/// What the fields of one cutter ask of one another.
Cutter filled_cutter() {
  Cutter c;
  Filler().fill(c);
  c.cutting_diameter_mm = 50.0;
  c.corner_radius_mm = 24.0;
  c.adjustable_to_mm = 55.0;
  c.overall_length_mm = 90.0;
  // A holder's outline says how wide it is, and a table's line how long the tool.
  c.holder.front().upper_diameter_mm = c.holder_diameter_mm;
  c.holder.front().lower_diameter_mm = c.holder_diameter_mm - 1.0;
  c.table_line->words = {{"Z", c.functional_length_mm}};
  return c;
}

/// The same but for units, which round.
template <class T>
bool same(const T& a, const T& b) {
  bool out = true;
  if constexpr (std::is_same_v<T, double>) {
    out = std::abs(a - b) <= 1e-12 * std::max(1.0, std::abs(b));
  } else if constexpr (model::HasFields<T>) {
    for_each_field(a, [&](const auto& row, const auto& value) { out = out && same(value, b.*row.member); });
  } else if constexpr (!std::is_same_v<T, std::string> && requires { a.size(); }) {
    out = std::equal(a.begin(), a.end(), b.begin(), b.end(),
                     [](const auto& x, const auto& y) { return same(x, y); });
  } else {
    out = a == b;
  }
  return out;
}

/// Names of the fields that are not as they were, but for those that `excused` names.
template <model::HasFields S>
std::string lost(const S& was, const S& is, const std::vector<std::string_view>& excused = {}) {
  std::string out;
  for_each_field(was, [&](const auto& row, const auto& value) {
    const bool is_excused = std::find(excused.begin(), excused.end(), row.name) != excused.end();
    if (!is_excused && !same(is.*row.member, value)) out += std::string(row.name) + " ";
  });
  return out;
}

model::Plan plan_with(const Cutter& c) {
  Job job;
  auto plan = pipeline::read_plan(testing::drilled_plate(), "plate.p21", job);
  EXPECT_TRUE(plan);
  plan->cutters = {c};
  Filler fill;
  fill.fill(plan->machine);
  fill.fill(plan->material);
  return *std::move(plan);
}

TEST(CutterFields, AFilledCutterHasNoDefaultLeftAndNoFault) {
  const Cutter c = filled_cutter(), unsaid;
  for_each_field(
      c, [&](const auto& row, const auto& value) { EXPECT_FALSE(value == unsaid.*row.member) << row.name; });
  EXPECT_TRUE(model::faults_of(c).empty()) << model::faults_of(c).front();
}

TEST(CutterFields, ComeBackFromEachFormOfAPlan) {
  const Cutter c = filled_cutter();
  const model::Plan plan = plan_with(c);
  for (const auto form : {pipeline::Format::kJson, pipeline::Format::kIso14649, pipeline::Format::kAp238}) {
    SCOPED_TRACE(static_cast<int>(form));
    Job job;
    const auto text = pipeline::write_plan(plan, form, job);
    ASSERT_TRUE(text) << to_text(text.error());
    const auto back = pipeline::read_plan(*text, "plan", job);
    ASSERT_TRUE(back) << to_text(back.error());
    ASSERT_EQ(back->cutters.size(), 1u);
    EXPECT_EQ(lost(c, back->cutters[0]), "");
    EXPECT_EQ(lost(plan.machine, back->machine), "");
    EXPECT_EQ(lost(plan.material, back->material), "");
  }
}

TEST(CutterFields, ComeBackFromAStore) {
  const Cutter c = filled_cutter();
  const auto bytes = tooling::store_of(tooling::library_of({c}, "shop"), {c});
  ASSERT_TRUE(bytes) << to_text(bytes.error());
  const auto store = tooling::ToolStore::from_bytes(*bytes, "shop.sqlite");
  ASSERT_TRUE(store) << to_text(store.error());
  const auto all = store->all_cutters();
  ASSERT_TRUE(all) << to_text(all.error());
  EXPECT_EQ(lost(c, all->at(0)), "");
}

TEST(CutterFields, ComeBackFromTheOwnListOrHaveAReasonWhyNot) {
  const Cutter c = filled_cutter();
  Job job;
  const auto written = tooling::own_format().write(tooling::library_of({c}, "shop"), {}, job);
  ASSERT_TRUE(written) << to_text(written.error());
  const auto read = tooling::read_own_list(written->bytes, "shop.yaml", job);
  ASSERT_TRUE(read) << to_text(read.error()) << written->bytes;
  ASSERT_EQ(read->size(), 1u);
  const Cutter& back = read->front();
  std::vector<std::string_view> excused = {"presets"};  // those of the generic tool are added
  for_each_field(c, [&](const auto& row, const auto&) {
    EXPECT_NE(row.own_key == nullptr, row.not_own == nullptr) << row.name << ": a key, or a reason";
    if (row.not_own != nullptr) excused.emplace_back(row.name);
  });
  EXPECT_EQ(lost(c, back, excused), "") << written->bytes;
  EXPECT_EQ(std::count(back.presets.begin(), back.presets.end(), c.presets.front()), 1) << written->bytes;
}

TEST(CutterFields, DiffTellsEachOrHasAReasonWhyNot) {
  const Cutter c = filled_cutter(), unsaid;
  const model::Plan before = plan_with(c);
  ASSERT_TRUE(diff(before, before).same);
  for_each_field(c, [&](const auto& row, const auto&) {
    model::Plan after = before;
    after.cutters[0].*row.member = unsaid.*row.member;
    EXPECT_EQ(diff(before, after).same, row.not_told != nullptr) << row.name;
  });
}

TEST(MachineFields, DiffTellsEach) {
  const model::Plan before = plan_with(filled_cutter());
  const model::Machine unsaid;
  for_each_field(before.machine, [&](const auto& row, const auto&) {
    model::Plan after = before;
    after.machine.*row.member = unsaid.*row.member;
    if constexpr (std::is_same_v<decltype(after.machine.*row.member), std::array<model::LinearAxis, 3>&>)
      after.machine.axes[0].name = before.machine.axes[0].name;  // an axis without a name is not known
    EXPECT_FALSE(diff(before, after).same) << row.name;
  });
}

TEST(MaterialFields, DiffTellsEachOrHasAReasonWhyNot) {
  const model::Plan before = plan_with(filled_cutter());
  const model::WorkMaterial unsaid;
  for_each_field(before.material, [&](const auto& row, const auto&) {
    model::Plan after = before;
    after.material.*row.member = unsaid.*row.member;
    EXPECT_EQ(diff(before, after).same, row.not_told != nullptr) << row.name;
  });
}

/// The plate with raw piece, two set-ups and a step whose every field has a value.
model::Plan plan_with_filled_steps() {
  model::Plan plan = testing::planned_plate();
  Filler fill;
  fill.fill(plan.stock);
  plan.setups.resize(2);
  for (model::SetupResult& s : plan.setups) fill.fill(s);
  for (model::StepResult& s : plan.steps) fill.fill(s);
  return plan;
}

/// Takes one field after another back to its default: diff tells each, but for those with a reason why not.
template <model::HasFields S, class Select>
void expect_diff_tells_each_field(Select&& select) {
  const model::Plan before = plan_with_filled_steps();
  ASSERT_TRUE(diff(before, before).same);
  const S unsaid;
  for_each_field(unsaid, [&](const auto& row, const auto& value) {
    if (std::string_view(row.name) == "step") return;  // without it the result is of no step at all
    model::Plan after = before;
    S& changed = select(after);
    changed.*row.member = value;
    EXPECT_EQ(diff(before, after).same, row.not_told != nullptr) << row.name;
  });
}

TEST(StockFields, DiffTellsEachOrHasAReasonWhyNot) {
  expect_diff_tells_each_field<model::Stock>([](model::Plan & p) -> auto& { return p.stock; });
}

TEST(SetupFields, DiffTellsEachOrHasAReasonWhyNot) {
  expect_diff_tells_each_field<model::SetupResult>([](model::Plan & p) -> auto& { return p.setups[0]; });
}

TEST(WorkholdingFields, DiffTellsEachInEverySetup) {
  for (const std::size_t i : {0, 1})
    expect_diff_tells_each_field<model::Workholding>([i](model::Plan & p) -> auto& {
      return p.setups[i].holding;
    });
}

TEST(WorkholdingFields, DiffTellsEachOfASolid) {
  expect_diff_tells_each_field<model::FixtureSolid>(
      [](model::Plan & p) -> auto& { return p.setups[0].holding.solids.front(); });
}

TEST(StepFields, DiffTellsEachOrHasAReasonWhyNot) {
  expect_diff_tells_each_field<model::StepResult>([](model::Plan & p) -> auto& { return p.steps[0]; });
}

TEST(StepFields, DiffTellsEachLoadAndLimit) {
  expect_diff_tells_each_field<model::StepLoads>([](model::Plan & p) -> auto& { return p.steps[0].loads; });
  expect_diff_tells_each_field<model::ActiveConstraint>(
      [](model::Plan & p) -> auto& { return p.steps[0].active.front(); });
  expect_diff_tells_each_field<model::LimitAlongPath>(
      [](model::Plan & p) -> auto& { return p.steps[0].held_by.front(); });
  expect_diff_tells_each_field<model::ExceededLimit>(
      [](model::Plan & p) -> auto& { return p.steps[0].exceeded.front(); });
}

TEST(WorkholdingFields, ComeBackFromEachFormOfAPlan) {
  model::Plan plan = plan_with(filled_cutter());
  plan.setups.resize(1);
  plan.setups[0].setup = model::Ref<model::Setup>(plan.model.all(model::TypeId::kSetup).front());
  Filler().fill(plan.setups[0].holding);
  const model::Workholding held = plan.setups[0].holding;
  for (const auto form : {pipeline::Format::kJson, pipeline::Format::kIso14649, pipeline::Format::kAp238}) {
    SCOPED_TRACE(static_cast<int>(form));
    Job job;
    const auto text = pipeline::write_plan(plan, form, job);
    ASSERT_TRUE(text) << to_text(text.error());
    const auto back = pipeline::read_plan(*text, "plan", job);
    ASSERT_TRUE(back) << to_text(back.error());
    ASSERT_EQ(back->setups.size(), 1u);
    EXPECT_EQ(lost(held, back->setups[0].holding), "");
  }
}

TEST(CutterFields, EachMakesAnotherQuestionForTheOptimiser) {
  optimise::CutQuestion asked;
  asked.cutter = filled_cutter();
  step::KnownCuts known;
  known.keep(asked, {});
  ASSERT_NE(known.find(asked), nullptr);
  const Cutter unsaid;
  for_each_field(asked.cutter, [&](const auto& row, const auto&) {
    optimise::CutQuestion other = asked;
    other.cutter.*row.member = unsaid.*row.member;
    EXPECT_EQ(known.find(other), nullptr) << row.name;
  });
}

/// What mechanics makes of a cutter, as numbers.
std::vector<double> seen_by_mechanics(const Cutter& c) {
  const auto t = mechanics::tooth_of(c);
  std::vector<double> out = {
      t.cutting_diameter_mm, t.corner_radius_mm,          t.helix_rad, t.lead_angle_rad, t.taper_angle_rad,
      t.runout_mm,           static_cast<double>(t.teeth)};
  if (const auto beam = mechanics::beam_of(c)) {
    for (const auto& s : beam->segments)
      out.insert(out.end(), {s.length_mm, s.diameter_mm, s.youngs_modulus_n_mm2});
  }
  return out;
}

TEST(CutterFields, WhatForcesAndBendingDependOnIsMarkedSo) {
  Cutter c = filled_cutter();
  c.neck_length_mm = 60.0;  // above the flutes, so that both bend
  const Cutter unsaid;
  for_each_field(c, [&](const auto& row, const auto&) {
    Cutter other = c;
    other.*row.member = unsaid.*row.member;
    if (seen_by_mechanics(other) != seen_by_mechanics(c)) {
      EXPECT_TRUE(row.is_load) << row.name;
    }
  });
}

}  // namespace
}  // namespace capstan::app
