#pragma once

#include <memory>
#include <string>

#include "planner/model/nouns/all.h"
#include "planner/model/plan/plan.h"

namespace capstan::testing {

/// A plan with one set-up and two cutters, T1 an 18 mm end mill and T2 an M6 tap, without steps.
inline model::Plan empty_plan() {
  using namespace model;
  Plan plan;
  Project project;
  project.its_id = "bracket (left)";
  plan.project = plan.model.add(project);
  plan.file_name = "bracket.p21";
  plan.machine.id = "mill";
  plan.material.id = "mild_steel";
  plan.machine.spindle.rpm_max = 8000.0;
  plan.machine.spindle.spin_up_s = 1.5;
  plan.stock.box.add({0, 0, -20});
  plan.stock.box.add({100, 80, 0});
  Cutter mill;
  mill.id = "em18";
  mill.description = "end mill, 18 mm \xC3\x98";
  mill.cutting_diameter_mm = 18.0;
  mill.functional_length_mm = 50.0;
  mill.pocket = 1;
  Cutter tap;
  tap.id = "tap_m6";
  tap.cutter_class = CutterClass::kTap;
  tap.cutting_diameter_mm = 6.0;
  tap.functional_length_mm = 80.0;
  tap.thread_pitch_mm = 1.0;
  tap.pocket = 2;
  plan.cutters = {mill, tap};
  plan.setups.push_back({.setup = {}, .work_offset = "G54", .security_z_mm = 20.0});
  return plan;
}

/// Appends a step that runs `path` at one feed and speed.
inline model::StepResult& add_step(model::Plan& plan, const std::string& id, const std::string& cutter,
                                   model::CutterPath path, double rpm = 3000.0, double feed = 600.0) {
  model::MachiningWorkingstep step;
  step.its_id = id;
  model::StepResult result;
  result.step = plan.model.add(step);
  result.cutter_id = cutter;
  result.spindle_rpm = rpm;
  result.feed_mm_min = feed;
  result.flood = true;
  const std::size_t n = path.size();
  model::FeedSchedule schedule{std::vector<double>(n, feed), std::vector<double>(n, rpm),
                               std::vector<double>(n, 0.0)};
  result.path = std::make_shared<const model::CutterPath>(std::move(path));
  result.schedule = std::make_shared<const model::FeedSchedule>(std::move(schedule));
  plan.steps.push_back(std::move(result));
  return plan.steps.back();
}

}  // namespace capstan::testing
