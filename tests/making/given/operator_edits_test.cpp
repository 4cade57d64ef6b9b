#include "planner/making/given/edits/operator_edits.h"

#include <gtest/gtest.h>

#include "planner/making/given/edits/value_limits.h"
#include "planner/model/nouns/all.h"

namespace capstan::given {
namespace {

using model::Edit;
using model::EditKind;
using model::EditOf;

/// A workplan of a rapid movement, then a drilling step of its file.
model::Plan rapid_then_drilling() {
  model::Plan plan;
  model::Model& m = plan.model;
  model::Workplan work;
  work.its_elements.push_back(m.add(model::RapidMovement{}));
  model::MachiningWorkingstep ws;
  ws.its_id = "DRILL IT";
  ws.its_operation = m.add(model::Drilling{});
  work.its_elements.push_back(m.add(ws));
  model::Project project;
  project.main_workplan = m.add(work);
  plan.project = m.add(project);
  return plan;
}

// A rapid movement is executed and has no operation: it counts among the steps that are cut.
TEST(OpenBeyondEdits, LeavesTheStepsAloneThatAreCutAndNoOther) {
  const std::vector<Edit> edits = {*model::parse_edit(EditKind::kForbid, "operation=drilling", "--forbid")};
  const auto opened = [&](std::size_t cut) {
    model::Plan plan = rapid_then_drilling();
    Job job;
    return open_beyond_edits(plan, edits, {}, cut, job);
  };
  for (const std::size_t cut : {0U, 1U}) {
    const auto ok = opened(cut);
    ASSERT_FALSE(ok) << "the drilling step is to come";
    EXPECT_EQ(ok.error().code, "EDIT-KEPT");
  }
  EXPECT_TRUE(opened(2));
  EXPECT_TRUE(opened(9));
}

TEST(ValueLimits, AreThoseOfMachineControlAndCutter) {
  model::Machine machine;
  machine.id = "mill";
  for (auto& a : machine.axes) a.feed_max_mm_min = 8000.0;
  machine.axes[2].feed_max_mm_min = 5000.0;
  machine.control.feed_decimals = 1;
  machine.spindle.rpm_min = 100.0;
  machine.spindle.rpm_max = 6000.0;
  model::Cutter cutter;
  cutter.id = "em10";
  cutter.substrate = model::Substrate::kCarbide;
  cutter.cutting_diameter_mm = 10.0;
  cutter.maximum_speed_rpm = 5000.0;
  const model::WorkMaterial material;
  const auto no = [&](EditOf of, double number) {
    Edit e;
    e.of = of;
    e.number = number;
    return beyond(e, machine, material, &cutter).value_or("");
  };
  EXPECT_EQ(no(EditOf::kFeed, 8000.0), "");
  EXPECT_EQ(no(EditOf::kFeed, 8001.0), "above the 8000 mm/min of the fastest axis of machine 'mill'");
  EXPECT_EQ(no(EditOf::kFeed, 0.1), "");
  EXPECT_EQ(no(EditOf::kFeed, 0.09),
            "below the 0.1 mm/min of the smallest feed that its control takes (linuxcnc)");
  EXPECT_EQ(no(EditOf::kSpeed, 5000.0), "");
  EXPECT_EQ(no(EditOf::kSpeed, 5001.0), "above the 5000 1/min of its cutter 'em10'");
  EXPECT_EQ(no(EditOf::kSpeed, 6001.0), "above the 6000 1/min of the spindle of machine 'mill'");
  EXPECT_EQ(no(EditOf::kSpeed, 99.0), "below the 100 1/min of the spindle of machine 'mill'");
  // A limit that is never met bounds nothing; one below what there is cannot be kept.
  const auto limited = [&](const char* text) {
    return bool(within_machine({*model::parse_edit(EditKind::kLimit, text, "--limit")}, machine, ""));
  };
  EXPECT_TRUE(limited("feed<=900000"));
  EXPECT_TRUE(limited("speed<=900000"));
  EXPECT_FALSE(limited("feed<=0.000001"));
  EXPECT_FALSE(limited("speed<=1"));
  machine.spindle.gears = {{.id = "low", .rpm_min = 20.0, .rpm_max = 400.0, .curve = {}, .curve_s6 = {}},
                           {.id = "high", .rpm_min = 300.0, .rpm_max = 6000.0, .curve = {}, .curve_s6 = {}}};
  EXPECT_EQ(no(EditOf::kSpeed, 30.0), "") << "another gear turns so slowly";
  // Five edge radii of 0.008 mm: mechanics::least_depth_mm.
  EXPECT_EQ(no(EditOf::kDepth, 0.0401), "");
  EXPECT_EQ(no(EditOf::kDepth, 0.039), "below the 0.04 mm of the shallowest level that 'em10' cuts");
}

}  // namespace
}  // namespace capstan::given
