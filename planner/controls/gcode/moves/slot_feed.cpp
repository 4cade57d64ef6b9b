#include "planner/controls/gcode/moves/slot_feed.h"

#include <algorithm>
#include <cmath>

#include "planner/making/optimise/cut.h"
#include "planner/making/optimise/cut/limits.h"
#include "planner/making/optimise/feeds.h"

namespace capstan::controls::gcode {
namespace {

/// Levels that are tried at most: more than a hundred make no pocket that anybody would cut so.
constexpr int kMostLevels = 100;
/// Steps in which the feed is lowered: one in fifty.
constexpr double kLower = 0.98;

/// The step's cut as a question whose limits are the loads that its planned path keeps.
optimise::CutQuestion question_of(const model::Plan& plan, const model::StepResult& step,
                                  const model::Cutter& cutter) {
  optimise::CutQuestion q;
  q.kind = optimise::CutKind::kRough;
  q.slot = true;
  q.cutter = cutter;
  q.material = plan.material;
  q.machine = plan.machine;
  q.fz_start_mm = step.fz_mm;
  q.vc_start_m_min = step.vc_m_min;
  q.peak_force_limit_n = step.loads.peak_force_n;
  q.deflection_limit_mm = step.loads.deflection_mm;
  return q;
}

/// The largest feed up to `most` that keeps the limits, and the torque and power of the planned path, in a
/// slot of this depth; 0: none does.
double slot_feed(const optimise::CutQuestion& q, const model::StepLoads& planned, double depth_mm, double rpm,
                 double most, double least) {
  const auto within = [](double load, double largest) { return !(largest > 0.0) || load <= largest; };
  for (double feed = most; feed >= least; feed *= kLower) {
    const auto loads = optimise::loads_of(q, depth_mm, q.cutter.cutting_diameter_mm, rpm, feed);
    if (loads && optimise::worst_excess(q, *loads, rpm) <= 0.0 &&
        within(loads->torque_nm, planned.torque_nm) && within(loads->power_w, planned.power_w))
      return feed;
  }
  return 0.0;
}

}  // namespace

std::optional<SlotLevels> slot_levels(const model::Plan& plan, const model::StepResult& step,
                                      const model::Cutter& cutter, double depth_mm, double deepest_mm,
                                      double rpm, int feed_decimals) {
  const optimise::CutQuestion q = question_of(plan, step, cutter);
  if (!(depth_mm > 0.0) || !(deepest_mm > 0.0) || !(rpm > 0.0) || !(q.fz_start_mm > 0.0) ||
      !(q.peak_force_limit_n > 0.0) || !(q.deflection_limit_mm > 0.0))
    return std::nullopt;
  const double most = std::min(step.feed_mm_min, q.fz_start_mm * std::max(1, cutter.teeth) * rpm);
  const double least = std::max(optimise::least_feed_mm_min(q, rpm), optimise::kLeastFeedShare * most);
  const double unit = std::pow(10.0, -feed_decimals);
  std::optional<SlotLevels> best;
  double cleared = 0.0;
  // Deeper slots ask for a lower speed, and the program has the step's.
  deepest_mm = std::min(deepest_mm, optimise::kFullFeedSlotRatio * cutter.cutting_diameter_mm);
  const int first = std::max(1, static_cast<int>(std::ceil(depth_mm / deepest_mm - 1e-9)));
  for (int n = first; n < first + kMostLevels; ++n) {
    const double level = depth_mm / n;
    if (best && level * most < cleared) break;  // no feed of these is enough
    const double feed = std::floor(slot_feed(q, step.loads, level, rpm, most, least) / unit) * unit;
    if (!(feed > 0.0) || level * feed <= cleared) continue;
    best = SlotLevels{n, feed};
    cleared = level * feed;
  }
  return best;
}

}  // namespace capstan::controls::gcode
