#include <algorithm>
#include <cmath>

#include "planner/ground/base/number.h"
#include "planner/physics/motion/time.h"

namespace capstan::motion {
namespace {

using geometry::Vec3;
using model::Plan;
using model::StepResult;

// Up to the security plane, across, down.
double link_s(const Plan& plan, const StepResult& from, const StepResult& to) {
  const Vec3 a = from.path->point(from.path->size() - 1);
  const Vec3 b = to.path->point(0);
  if (a == b) return 0.0;
  double top = std::max(a.z, b.z);
  if (to.setup < plan.setups.size()) top = std::max(top, plan.setups[to.setup].security_z_mm);
  model::CutterPath link;
  link.start(a);
  link.rapid({a.x, a.y, top});
  link.rapid({b.x, b.y, top});
  link.rapid(b);
  const std::vector<double> zeros(link.size(), 0.0);
  const auto time = time_of(link, {zeros, zeros, zeros}, plan.machine);
  return time ? time->rapid_s : 0.0;
}

}  // namespace

model::FeedSchedule schedule_of(const StepResult& step) {
  if (step.schedule) return *step.schedule;
  const std::size_t n = step.path ? step.path->size() : 0;
  return {std::vector<double>(n, step.feed_mm_min), std::vector<double>(n, step.spindle_rpm),
          std::vector<double>(n, 0.0)};
}

std::string duration_text(double seconds) {
  const double s = rounded(seconds, 1);
  if (!(s >= 60.0)) return trimmed(s, 1) + " s";
  const double minutes = std::floor(s / 60.0);
  return trimmed(minutes, 0) + " min " + trimmed(s - 60.0 * minutes, 1) + " s";
}

std::string text_of(const PlanTime& t) {
  return duration_text(t.total_s()) + ": cutting " + duration_text(t.at_feed_s()) + ", rapids " +
         duration_text(t.rapid_s) + ", between steps " + duration_text(t.link_s) + ", " +
         std::to_string(t.tool_changes) + (t.tool_changes == 1 ? " tool change " : " tool changes ") +
         duration_text(t.tool_change_s) + ", spindle " + duration_text(t.spin_up_s);
}

Result<PlanTime> time_of(const Plan& plan) {
  PlanTime out;
  out.steps.resize(plan.steps.size());
  const StepResult* before = nullptr;
  StepShare* last = nullptr;
  double speed_before = 0.0;
  for (std::size_t i = 0; i < plan.steps.size(); ++i) {
    const StepResult& step = plan.steps[i];
    if (!step.path || step.path->size() == 0) continue;
    const model::FeedSchedule schedule = schedule_of(step);
    auto time = time_of(*step.path, schedule, plan.machine);
    if (!time) {
      Diagnostic d = time.error();
      d.path = model::step_id(plan, step) + " " + d.path;
      return fail(std::move(d));
    }
    StepShare& share = out.steps[i];
    share.cutting_s = time->cutting_s + time->dwell_s;
    share.rapid_s = time->rapid_s;
    out.cutting_s += time->cutting_s;
    out.rapid_s += time->rapid_s;
    out.dwell_s += time->dwell_s;
    const auto spindle = [&](double s) {
      out.spin_up_s += s;
      share.spindle_s += s;
    };
    spindle(time->spindle_s);
    const bool same_tool = before != nullptr && before->cutter_id == step.cutter_id;
    if (same_tool && before->setup == step.setup) {
      out.link_s += share.link_s = link_s(plan, *before, step);
    } else {
      spindle(spindle_change_s(plan.machine.spindle, speed_before, 0.0));
      speed_before = 0.0;
    }
    if (!same_tool) {
      out.tool_change_s += share.tool_change_s = plan.machine.tool_change_s;
      ++out.tool_changes;
    }
    // The speed of entry 0 is that of the first move.
    const auto& speeds = schedule.spindle_rpm;
    spindle(spindle_change_s(plan.machine.spindle, speed_before, speeds.size() > 1 ? speeds[1] : speeds[0]));
    speed_before = speeds.back();
    before = &step;
    last = &share;
  }
  const double stop = spindle_change_s(plan.machine.spindle, speed_before, 0.0);
  out.spin_up_s += stop;
  if (last != nullptr) last->spindle_s += stop;
  return out;
}

}  // namespace capstan::motion
