#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <string>

#include "planner/model/nouns/all.h"
#include "planner/proof/verify/verify.h"
#include "tests/support/corpus.h"
#include "tests/support/shop.h"
#include "tooling/library/nouns/nouns.h"
#include "tooling/shop/machine/machine.h"

namespace capstan::pipeline {
namespace {

const std::string kExamples = capstan::testing::source_dir() + "/examples/";

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

// Two holes of 8 mm: one right through 50 mm, which only the long drill of 118 degrees reaches; one 20 mm
// deep over a bottom of 120 degrees, for which the short drill of 120 degrees is the better one.
Inputs two_drills() {
  Inputs in = shop();
  const auto is = [](const model::Cutter& c, double diameter) {
    return c.cutter_class == model::CutterClass::kTwistDrill &&
           std::abs(c.cutting_diameter_mm - diameter) < 1e-9;
  };
  model::Cutter pattern;
  for (const auto& c : in.library) {
    if (is(c, 8.0) && c.id.find("hss") != std::string::npos) pattern = c;
  }
  std::erase_if(in.library, [](const auto& c) {
    return c.cutter_class != model::CutterClass::kSpotDrill &&
           c.cutter_class != model::CutterClass::kCenterDrill;
  });
  model::Cutter deep = pattern, blunt = pattern;
  deep.id = "deep/118";
  deep.point_angle_rad = 118.0 * std::numbers::pi / 180.0;
  blunt.id = "blunt/120";
  blunt.point_angle_rad = 120.0 * std::numbers::pi / 180.0;
  for (model::Cutter* c : {&deep, &blunt}) {
    c->maximum_depth_of_cut_mm = c == &deep ? 70.0 : 30.0;  // of flutes
    c->usable_length_mm = c->maximum_depth_of_cut_mm + 5.0;
    c->stick_out_mm = c->usable_length_mm + 5.0;  // less of it: the stiffer, and the first choice
    c->functional_length_mm = c->stick_out_mm + 60.0;
  }
  in.library.insert(in.library.end(), {deep, blunt});
  return in;
}

TEST(Tools, ADrillThatGivesWayLeavesTheDepthToThePointOfTheOther) {
  Inputs in = two_drills();
  const std::string file = capstan::testing::source_dir() + "/tests/door/pipeline/parts/two_points.p21";
  for (const double change_s : {0.0, 600.0}) {
    in.machine.tool_change_s = in.machine.spindle.spin_up_s = change_s;
    Job job;
    auto read = read_plan(testing::slurp(file), "two_points.p21", job);
    ASSERT_TRUE(read);
    const auto plan = bind(*read, in, {}, job);
    ASSERT_TRUE(plan) << to_text(plan.error());
    bool found = false;
    for (const auto& s : plan->steps) {
      const auto* ws = plan->model.get<model::MachiningWorkingstep>(s.step);
      if (ws == nullptr || ws->its_id.value_or("").find("BLIND") == std::string::npos) continue;
      const auto* op = plan->model.get<model::DrillingTypeOperation>(ws->its_operation);
      if (op == nullptr || plan->model.holds<model::CenterDrilling>(ws->its_operation)) continue;
      found = true;
      EXPECT_EQ(s.cutter_id, change_s > 0.0 ? "deep/118" : "blunt/120");
      // The bottom's apex lies 4 tan 30 = 2.3094 below 20 mm; the tip of the sharper drill is
      // 4 tan 31 = 2.4034 long, and must not lie deeper.
      EXPECT_NEAR(op->cutting_depth.value_or(0.0), change_s > 0.0 ? 20.0 + 2.3094 - 2.4034 : 20.0, 1e-4);
      EXPECT_NEAR(*std::min_element(s.path->z.begin(), s.path->z.end()), -20.0 - 2.3094, 1e-3);
    }
    EXPECT_TRUE(found) << "planned: " << plan->steps.size();
    for (const auto& f : findings_of(*plan, job)) EXPECT_NE(f.severity, Severity::kError) << f.message;
  }
}

}  // namespace
}  // namespace capstan::pipeline
