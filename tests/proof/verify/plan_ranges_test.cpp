#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "planner/proof/verify/verify.h"
#include "tests/proof/verify/plans.h"

// Values that an edited plan may come back with.

namespace capstan::verify {
namespace {

bool refused(const model::Plan& plan) {
  Job job;
  const auto findings = check_plan(plan, job);
  return std::any_of(findings.begin(), findings.end(), [](const auto& f) { return f.code == "CHK-RANGE"; });
}

TEST(EditedPlan, AValueThatCannotBeIsAnError) {
  const model::Plan good = testing::good_plan().plan;
  ASSERT_FALSE(refused(good));
  using Change = void (*)(model::Plan&);
  const std::pair<const char*, Change> changes[] = {
      {"raw piece of no width", [](model::Plan& p) { p.stock.box.hi.x = p.stock.box.lo.x; }},
      {"force below zero", [](model::Plan& p) { p.material.kc11_n_mm2 = -641.0; }},
      {"exponent above one", [](model::Plan& p) { p.material.mc = 2.5; }},
      {"efficiency of nothing", [](model::Plan& p) { p.machine.spindle.efficiency = 0.0; }},
      {"efficiency above one", [](model::Plan& p) { p.machine.spindle.efficiency = 8.0; }},
      {"stick-out below zero", [](model::Plan& p) { p.cutters[0].stick_out_mm = -40.0; }},
      {"no stick-out", [](model::Plan& p) { p.cutters[0].stick_out_mm = 0.0; }},
      {"no stick-out, and no flutes",
       [](model::Plan& p) {
         p.cutters[0].stick_out_mm = p.cutters[0].maximum_depth_of_cut_mm = p.cutters[0].usable_length_mm =
             0.0;
       }},
      {"flutes longer than the tool sticks out",
       [](model::Plan& p) { p.cutters[0].maximum_depth_of_cut_mm = p.cutters[0].stick_out_mm + 1.0; }},
      {"longer out than it is",
       [](model::Plan& p) { p.cutters[0].overall_length_mm = p.cutters[0].stick_out_mm - 1.0; }},
      {"neck longer than the tool",
       [](model::Plan& p) {
         p.cutters[0].overall_length_mm = 100.0;
         p.cutters[0].neck_length_mm = 101.0;
       }},
      {"neck shorter than the flutes",
       [](model::Plan& p) { p.cutters[0].neck_length_mm = p.cutters[0].maximum_depth_of_cut_mm - 1.0; }},
      {"neck thicker than head and shank",
       [](model::Plan& p) {
         p.cutters[0].neck_diameter_mm =
             std::max(p.cutters[0].cutting_diameter_mm, p.cutters[0].shank_diameter_mm) + 1.0;
       }},
      {"corner wider than the tool",
       [](model::Plan& p) { p.cutters[0].corner_radius_mm = p.cutters[0].cutting_diameter_mm; }},
      {"no diameter", [](model::Plan& p) { p.cutters[1].cutting_diameter_mm = 0.0; }},
      {"travel backwards",
       [](model::Plan& p) { std::swap(p.machine.axes[2].travel_min_mm, p.machine.axes[2].travel_max_mm); }},
      {"curve backwards",
       [](model::Plan& p) { std::reverse(p.machine.spindle.curve.begin(), p.machine.spindle.curve.end()); }},
      {"decimals below zero", [](model::Plan& p) { p.machine.control.decimals = -4; }},
      {"depth not finite",
       [](model::Plan& p) { p.steps[0].axial_depth_mm = std::numeric_limits<double>::quiet_NaN(); }},
      {"feed below zero", [](model::Plan& p) { p.steps[0].feed_mm_min = -600.0; }},
  };
  for (const auto& [name, change] : changes) {
    model::Plan plan = good;
    change(plan);
    EXPECT_TRUE(refused(plan)) << name;
  }
}

TEST(EditedPlan, AToolWithTwoStickOutsIsAnError) {
  model::Plan plan = testing::good_plan().plan;
  plan.cutters.push_back(plan.cutters[0]);
  plan.cutters.back().stick_out_mm += 5.0;
  Job job;
  const auto findings = check_plan(plan, job);
  EXPECT_TRUE(std::any_of(findings.begin(), findings.end(), [](const auto& f) {
    return f.code == "CHK-TWICE" && f.message.find("sticks out") != std::string::npos;
  }));
}

}  // namespace
}  // namespace capstan::verify
