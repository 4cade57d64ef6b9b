#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "planner/controls/controls.h"
#include "tests/support/corpus.h"
#include "tests/support/empty_plan.h"

// Plans that the golden programs of several controls are written of, and those programs.

namespace capstan::controls::plans {

using model::CutterPath;
using model::MoveRole;
using model::Plan;

inline Plan plan_for(const char* dialect) {
  Plan plan = capstan::testing::empty_plan();
  plan.machine.axes[2].travel_min_mm = -400.0;
  plan.machine = with_control(plan.machine, dialect);
  const auto offsets = find_dialect(dialect)->work_offsets;
  for (std::size_t i = 0; i < plan.setups.size(); ++i) plan.setups[i].work_offset = offsets[i];
  return plan;
}

inline void choose(Plan& plan, const char* name, const char* value) {
  if (!plan.machine.control_options) plan.machine.control_options.emplace();
  plan.machine.control_options->chosen.push_back({name, value});
}

/// A pocket 30 x 20, corners of 5 mm, entered on a helix.
inline CutterPath pocket() {
  CutterPath p;
  p.start({0, 0, 10});
  p.rapid({0, 0, 2});
  p.line({0, 0, 0.5}, MoveRole::kApproach);
  p.arc({6, 0, -1}, {3, 0}, true, MoveRole::kRamp);
  p.arc({0, 0, -2.5}, {3, 0}, true, MoveRole::kRamp);
  p.line({0, -5.5, -2.5}, MoveRole::kCut);
  p.line({10.123, -5.5, -2.5}, MoveRole::kCut);
  p.arc({15.123, -0.5, -2.5}, {10.123, -0.5}, false, MoveRole::kCut);
  p.line({15.123, 0, -2.5}, MoveRole::kCut);
  p.arc({-15.123, 0, -2.5}, {0, 0}, false, MoveRole::kCut);
  p.rapid({-15.123, 0, 10}, MoveRole::kRetract);
  return p;
}

inline Plan pocket_plan(const char* dialect) {
  Plan plan = plan_for(dialect);
  capstan::testing::add_step(plan, "rough pocket", "em18", pocket(), 3000.4).contour_tolerance_mm = 0.05;
  return plan;
}

inline CutterPath hole(double x, double y, bool feeds_out, bool dwells) {
  CutterPath p;
  p.start({x, y, 10});
  p.rapid({x, y, 2});
  p.line({x, y, -18.2}, MoveRole::kDrill);
  if (dwells) p.dwell();
  if (feeds_out) {
    p.line({x, y, 10}, MoveRole::kRetract);
  } else {
    p.rapid({x, y, 10}, MoveRole::kRetract);
  }
  return p;
}

inline void add_hole(Plan& plan, const char* id, const char* cutter, double x, double y, bool feeds_out,
                     double dwell_s) {
  auto& step = capstan::testing::add_step(plan, id, cutter, hole(x, y, feeds_out, dwell_s > 0.0), 1200, 180);
  model::FeedSchedule s = *step.schedule;
  if (dwell_s > 0.0) s.dwell_s[3] = dwell_s;
  step.schedule = std::make_shared<const model::FeedSchedule>(std::move(s));
}

inline void add_tap(Plan& plan, const char* id, double x, double y) {
  CutterPath p;
  p.start({x, y, 10});
  p.rapid({x, y, 5});
  p.line({x, y, -12}, MoveRole::kTap);
  p.line({x, y, 5}, MoveRole::kTap);
  p.rapid({x, y, 10}, MoveRole::kRetract);
  capstan::testing::add_step(plan, id, "tap_m6", std::move(p), 400.2, 400.2);
}

/// Four holes: two drilled, one of them with a dwell, one reamed out at feed, one tapped.
inline Plan holes_plan(const char* dialect) {
  Plan plan = plan_for(dialect);
  model::Cutter drill = plan.cutters[0], reamer = plan.cutters[0];
  drill.id = "d8";
  drill.cutter_class = model::CutterClass::kTwistDrill;
  drill.cutting_diameter_mm = 8;
  drill.pocket = 3;
  reamer.id = "r8";
  reamer.cutter_class = model::CutterClass::kReamer;
  reamer.pocket = 4;
  plan.cutters.push_back(drill);
  plan.cutters.push_back(reamer);
  add_hole(plan, "H1 drill", "d8", 20, 20, false, 0.0);
  add_hole(plan, "H2 drill", "d8", 40, 20, false, 0.35);
  add_hole(plan, "H3 ream", "r8", 20, 20, true, 0.0);
  add_tap(plan, "H4 tap", 60, 20);
  return plan;
}

/// Equal holes at these places, drilled in one step.
inline Plan pattern_plan(const char* dialect, const std::vector<geometry::Vec2>& places) {
  Plan plan = plan_for(dialect);
  model::Cutter drill = plan.cutters[0];
  drill.id = "d8";
  drill.cutter_class = model::CutterClass::kTwistDrill;
  drill.cutting_diameter_mm = 8;
  drill.pocket = 3;
  plan.cutters.push_back(drill);
  CutterPath p;
  p.start({places.front().x, places.front().y, 10});
  for (const geometry::Vec2 at : places) {
    if (at != places.front()) p.rapid({at.x, at.y, 10});
    p.rapid({at.x, at.y, 2});
    p.line({at.x, at.y, -18.2}, MoveRole::kDrill);
    p.rapid({at.x, at.y, 10}, MoveRole::kRetract);
  }
  capstan::testing::add_step(plan, "pattern", "d8", std::move(p), 1200, 180);
  return plan;
}

/// A hole at (20, 20), pecked to these heights: after each but the last by rapid up to 6 and down at 3000
/// mm/min to 0.5 above it (`clears`), or 0.5 up at that feed.
inline Plan pecked_plan(const char* dialect, const std::vector<double>& bottoms, bool clears) {
  Plan plan = plan_for(dialect);
  model::Cutter drill = plan.cutters[0];
  drill.id = "d8";
  drill.cutter_class = model::CutterClass::kTwistDrill;
  drill.cutting_diameter_mm = 8;
  drill.pocket = 3;
  plan.cutters.push_back(drill);
  CutterPath p;
  p.start({20, 20, 10});
  p.rapid({20, 20, 6}, MoveRole::kApproach);
  p.line({20, 20, 2}, MoveRole::kApproach);
  for (std::size_t i = 0; i < bottoms.size(); ++i) {
    p.line({20, 20, bottoms[i]}, MoveRole::kDrill);
    const bool last = i + 1 == bottoms.size();
    if (last || clears) p.rapid({20, 20, 6}, MoveRole::kRetract);
    if (!last) p.line({20, 20, bottoms[i] + 0.5}, MoveRole::kLink);
  }
  p.rapid({20, 20, 10}, MoveRole::kRetract);
  auto& step = capstan::testing::add_step(plan, "deep hole", "d8", p, 1200, 180);
  model::FeedSchedule s = *step.schedule;
  for (std::size_t i = 0; i < p.size(); ++i) {
    if (p.role[i] == MoveRole::kApproach || p.role[i] == MoveRole::kLink) s.feed_mm_min[i] = 3000.0;
  }
  step.schedule = std::make_shared<const model::FeedSchedule>(std::move(s));
  return plan;
}

/// A hole at (20, 20) whose boring bar comes out with the spindle stopped.
inline Plan bored_plan(const char* dialect) {
  Plan plan = plan_for(dialect);
  auto& step = capstan::testing::add_step(plan, "bore", "em18", hole(20, 20, false, false), 1200, 180);
  model::FeedSchedule s = *step.schedule;
  s.spindle_rpm.back() = 0.0;
  step.schedule = std::make_shared<const model::FeedSchedule>(std::move(s));
  return plan;
}

/// So many places on a circle, counter-clockwise.
inline std::vector<geometry::Vec2> ring(geometry::Vec2 centre, double radius, double first_deg,
                                        double step_deg, int number) {
  std::vector<geometry::Vec2> out;
  for (int i = 0; i < number; ++i) {
    const double angle = (first_deg + i * step_deg) * std::numbers::pi / 180.0;
    out.push_back({centre.x + radius * std::cos(angle), centre.y + radius * std::sin(angle)});
  }
  return out;
}

/// The program in the words of the plan's control.
inline Result<std::string> written(const Plan& plan) {
  Job job;
  return write_program(plan, job);
}
inline std::string program_of(const Plan& plan) {
  const auto text = written(plan);
  EXPECT_TRUE(text) << (text ? "" : to_text(text.error()));
  return text.value_or("");
}
/// A golden program of tests/controls/CONTROL.
inline std::string golden(const std::string& control, const std::string& name) {
  return capstan::testing::slurp(capstan::testing::source_dir() + "/tests/controls/" + control + "/golden/" +
                                 name);
}

}  // namespace capstan::controls::plans
