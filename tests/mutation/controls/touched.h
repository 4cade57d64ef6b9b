#pragma once

#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "planner/controls/controls.h"
#include "planner/proof/verify/verify.h"
#include "tests/proof/verify/plans.h"

/// Plans that touch the piece between two steps, to write, to read back, and to plant faults in.
namespace capstan::mutation::touched {

struct Touched {
  geometry::Vec3 from, along;
  double distance = 0.0;
};

inline constexpr double kBall = 3.0;
/// A workpiece of 100 x 100 x 50 with its top at Z0: the ball meets the top.
inline const Touched kTop{{80, 80, 8}, {0, 0, -1}, 5.0};
inline const std::vector<model::ControlOption> kProbe{{"probe_radius_mm", "25"}, {"probe_stylus_mm", "50"}};

inline model::Cutter probe_cutter() {
  model::Cutter c;
  c.id = "probe";
  c.cutter_class = model::CutterClass::kTouchProbe;
  c.cutting_diameter_mm = 2.0 * kBall;
  c.functional_length_mm = 150;
  c.pocket = 20;
  return c;
}

/// A pocket, these touches by T20, and a drilled hole; a jaw 5 mm high beside the piece's front.
inline model::Plan measured(const std::vector<Touched>& touches, const std::string& dialect,
                            std::vector<model::ControlOption> options) {
  auto k = verify::testing::good_plan();
  model::Plan& plan = k.plan;
  model::TouchProbe probe;
  probe.its_id = "probe";
  probe.ball_radius = kBall;
  model::ToolUsage usage;
  usage.its_position = "20";
  probe.its_usage = plan.model.add(usage);
  const auto noun = plan.model.add(probe);
  model::Workplan w;
  w.its_elements.items = {plan.steps[0].step};
  for (const Touched& t : touches) {
    model::Direction along;
    along.direction_ratios = {{t.along.x, t.along.y, t.along.z}, true};
    model::WorkpieceProbing p;
    p.its_id = "P measure +z";
    p.start_position = k.at(t.from.x, t.from.y, t.from.z);
    p.direction = plan.model.add(along);
    p.expected_value = k.length(t.distance);
    p.its_probe = noun;
    w.its_elements.items.push_back(plan.model.add(p));
  }
  w.its_elements.items.push_back(plan.steps[1].step);
  model::Project project;
  project.main_workplan = plan.model.add(w);
  plan.project = plan.model.add(project);
  plan.cutters.push_back(probe_cutter());
  plan.machine = controls::with_control(std::move(plan.machine), dialect);
  plan.machine.control_options = model::ControlOptions{std::move(options)};
  plan.setups[0].work_offset = std::string(controls::find_dialect(dialect)->work_offsets[0]);
  auto& holding = plan.setups[0].holding;
  holding.solids.push_back({"jaw", "jaw", {{0, -40}, {100, -40}, {100, 0}, {0, 0}}, -50, -45, true});
  holding.clearance_mm = 2.0;
  return plan;
}

inline std::string text_of(const model::Plan& plan) {
  Job job;
  const auto text = controls::write_program(plan, job);
  EXPECT_TRUE(text) << (text ? "" : to_text(text.error()));
  return text.value_or("");
}
inline std::string found(const model::Plan& plan, const std::string& text, const std::string& table = "") {
  Job job;
  std::string out;
  for (const auto& f : verify::check_program({"a.nc", text, table}, &plan, plan.machine, plan.cutters, job))
    if (f.severity == Severity::kError) out += f.code + " " + f.message + "\n";
  return out;
}
inline bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}
inline std::string replaced(std::string text, const std::string& from, const std::string& to) {
  EXPECT_TRUE(has(text, from)) << from << "\n" << text;
  return has(text, from) ? text.replace(text.find(from), from.size(), to) : text;
}

}  // namespace capstan::mutation::touched
