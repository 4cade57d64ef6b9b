#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>

#include "planner/model/nouns/all.h"
#include "planner/pipeline/shop.h"
#include "planner/verify/verify.h"
#include "tests/support/corpus.h"
#include "tooling/catalogue/machine.h"
#include "tooling/nouns/nouns.h"

namespace capstan::pipeline {
namespace {

const std::string kExamples = std::string(CAPSTAN_SOURCE_DIR) + "/examples/";

Inputs shop() {
  static const Inputs kShop = [] {
    Job job;
    return load_shop({}, job).value();
  }();
  return kShop;
}

model::Plan planned(const Inputs& in, Job& job, const std::string& name = "bracket.p21") {
  auto plan = read_plan(testing::slurp(kExamples + name), name, job);
  return bind(plan.value(), in, {}, job).value();
}

const model::MachineParameters* needs_of(const model::Plan& plan) {
  const auto* project = plan.model.get<model::Project>(plan.project);
  const auto* main = plan.model.get<model::Workplan>(project->main_workplan);
  return plan.model.get<model::MachineParameters>(main->its_minimum_machine_params);
}

bool has(const std::vector<model::Finding>& findings, const std::string& code) {
  return std::any_of(findings.begin(), findings.end(), [&](const auto& f) { return f.code == code; });
}

TEST(MachineNeeds, AreWhatThePlanUsesAndItsMachineHas) {
  Job job;
  const model::Plan plan = planned(shop(), job);
  const auto* p = needs_of(plan);
  ASSERT_NE(p, nullptr);
  double feed = 0.0, rpm = 0.0;
  for (const auto& s : plan.steps) {
    for (const double f : s.schedule->feed_mm_min) feed = std::max(feed, f);
    for (const double n : s.schedule->spindle_rpm) rpm = std::max(rpm, std::abs(n));
  }
  EXPECT_NEAR(*p->feedrate, feed, 0.11);
  EXPECT_GE(*p->feedrate, feed - 1e-9);
  EXPECT_NEAR(*p->spindle_speed, rpm, 0.11);
  EXPECT_GT(*p->spindle_power, 0.0);
  EXPECT_EQ(p->axis_travel.items.size(), 3u);
  for (const auto& f : verify::check_plan(plan, job))
    EXPECT_FALSE(f.code.starts_with("CHK-MACHINE")) << f.message;
}

TEST(MachineNeeds, RefuseAMachineThatCannotNamingTheFigure) {
  Job job;
  model::Plan plan = planned(shop(), job);
  const auto* p = needs_of(plan);
  plan.machine.spindle.rpm_max = *p->spindle_speed - 10.0;  // more than the slack of 1e-4
  auto findings = verify::check_plan(plan, job);
  ASSERT_TRUE(has(findings, "CHK-MACHINE-SPEED"));
  for (const auto& f : findings) {
    if (f.code != "CHK-MACHINE-SPEED") continue;
    EXPECT_EQ(f.property, 16);
    EXPECT_NE(f.message.find("1/min"), std::string::npos) << f.message;
  }
  plan.machine = shop().machine;
  for (auto& point : plan.machine.spindle.curve) point.power_w *= 0.01;
  EXPECT_TRUE(has(verify::check_plan(plan, job), "CHK-MACHINE-POWER"));
  plan.machine = shop().machine;
  plan.machine.axes[0].travel_max_mm = plan.machine.axes[0].travel_min_mm + 1.0;
  EXPECT_TRUE(has(verify::check_plan(plan, job), "CHK-MACHINE-TRAVEL"));
  plan.machine = shop().machine;
  plan.machine.abilities.simultaneous_axes = 1;
  EXPECT_TRUE(has(verify::check_plan(plan, job), "CHK-MACHINE-AXES"));
}

TEST(MachineNeeds, SurviveAp238AndHoldThereToo) {
  Job job;
  const model::Plan plan = planned(shop(), job);
  const auto text = write_plan(plan, Format::kAp238, job);
  ASSERT_TRUE(text) << to_text(text.error());
  const auto back = read_plan(*text, "plan.stp", job);
  ASSERT_TRUE(back) << to_text(back.error());
  const auto* p = needs_of(*back);
  ASSERT_NE(p, nullptr);
  EXPECT_NEAR(*p->spindle_speed, *needs_of(plan)->spindle_speed, 1e-6);
  EXPECT_NEAR(*p->spindle_power, *needs_of(plan)->spindle_power, 1e-6);
}

TEST(ToolUsage, SurvivesAp238WithPocketAndMeasuredLength) {
  Job job;
  const model::Plan plan = planned(shop(), job);
  const auto text = write_plan(plan, Format::kAp238, job);
  ASSERT_TRUE(text) << to_text(text.error());
  const auto back = read_plan(*text, "plan.stp", job);
  ASSERT_TRUE(back) << to_text(back.error());
  std::set<std::string> seen;
  for (const auto ref : back->model.all(model::TypeId::kMillingCuttingTool)) {
    const auto c = tooling::cutter_from_nouns(back->model, model::Ref<model::MachiningTool>(ref), job);
    ASSERT_TRUE(c) << to_text(c.error());
    const auto* was = model::find_cutter(plan, c->id);
    ASSERT_NE(was, nullptr) << c->id;
    EXPECT_EQ(c->pocket, was->pocket);
    EXPECT_NEAR(c->functional_length_mm, was->functional_length_mm, 1e-9);
    seen.insert(c->id);
  }
  EXPECT_EQ(seen.size(), plan.cutters.size());
}

TEST(Tools, WhatIsNotInTheMagazineIsListed) {
  Job job;
  const model::Plan free = planned(shop(), job);
  Inputs in = shop();
  // All but one of the tools of the first plan are loaded.
  const std::string missing = free.cutters.back().id;
  for (auto& c : in.library) {
    for (const auto& used : free.cutters) {
      if (c.id != used.id || c.id == missing) continue;
      c.pocket = used.pocket;
      c.loaded = true;
    }
  }
  Job told;
  const model::Plan plan = planned(in, told);
  std::size_t loaded = 0;
  std::string list;
  for (const auto& c : plan.cutters) loaded += c.loaded ? 1 : 0;
  for (const auto& d : told.diagnostics()) {
    if (d.code == "PIP-TO-LOAD") list = d.message;
  }
  EXPECT_GT(loaded, 0u);
  EXPECT_EQ(loaded == plan.cutters.size(), list.empty()) << list;
  for (const auto& c : plan.cutters) {
    EXPECT_EQ(list.find(" " + c.id) != std::string::npos, !c.loaded) << c.id << ": " << list;
  }
}

TEST(Tools, AreFewerWhereAChangeCostsMoreThanTheSlowerTool) {
  Job job;
  Inputs quick = shop(), slow = shop();
  quick.machine.tool_change_s = quick.machine.spindle.spin_up_s = 0.0;
  slow.machine.tool_change_s = 600.0;
  const model::Plan many = planned(quick, job), few = planned(slow, job);
  EXPECT_LE(few.cutters.size(), many.cutters.size());
  EXPECT_TRUE(few.unplanned.empty());
  for (const auto& f : findings_of(few, job)) EXPECT_NE(f.severity, Severity::kError) << f.message;
}

}  // namespace
}  // namespace capstan::pipeline
