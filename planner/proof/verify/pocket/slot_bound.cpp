#include "planner/proof/verify/pocket/slot_bound.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "planner/physics/mechanics/constants.h"
#include "planner/proof/verify/stated_values.h"
#include "planner/proof/verify/sweep/step_checks.h"

namespace capstan::verify {
namespace {

constexpr double kPi = std::numbers::pi;
/// Halvings of the way between no feed and the chip's: to a millionth of it.
constexpr int kHalvings = 20;

/// Mean loads of a slot, a worn edge.
struct Loads {
  double force_n = 0.0, torque_nm = 0.0, power_w = 0.0;
};

Loads loads_at(const model::Plan& plan, const model::Cutter& c, double depth_mm, double rpm, double feed) {
  const double d = c.cutting_diameter_mm;
  // The mean chip of half a turn is 2 / pi of the feed per tooth.
  const double chip = 2.0 / kPi * feed / (rpm * std::max(1, c.teeth));
  const double per_minute = worn_specific_force(plan, c, chip) * depth_mm * d * feed;  // N mm/min
  Loads out;
  out.power_w = per_minute / 60000.0;
  out.torque_nm = out.power_w / (rpm * 2.0 * kPi / 60.0);
  // Of all edges together: over half a turn they point the same way for pi / 4 of it (sweep/rates.cpp).
  out.force_n =
      0.25 * kPi * per_minute / (kPi * d * rpm) * std::hypot(1.0, mechanics::kRadialToTangentialRatio);
  return out;
}

}  // namespace

SlotBound slot_bound(const model::Plan& plan, const model::StepResult& step, const model::Cutter& cutter,
                     double depth_mm, double rpm) {
  const FeedLimit chip = feed_limit(cutter, plan.material);
  SlotBound out{chip.mm * std::max(1, cutter.teeth) * rpm, "the largest chip, " + chip.source};
  const model::Spindle& s = plan.machine.spindle;
  const double share = mechanics::spindle_efficiency(s.efficiency);
  const model::SpindlePoint gives = s.curve.empty() ? model::SpindlePoint{} : spindle_at(s, rpm);
  const auto hold = [&](double most, const char* by, double Loads::*load) {
    if (!(most > 0.0)) return;
    double lo = 0.0, hi = out.feed_mm_min;
    if (loads_at(plan, cutter, depth_mm, rpm, hi).*load <= kMeasured * most) return;
    for (int i = 0; i < kHalvings; ++i) {
      const double mid = 0.5 * (lo + hi);
      (loads_at(plan, cutter, depth_mm, rpm, mid).*load <= kMeasured * most ? lo : hi) = mid;
    }
    out = {lo, by};
  };
  hold(gives.power_w * share, "the spindle's power", &Loads::power_w);
  hold(gives.torque_nm * share, "the spindle's torque", &Loads::torque_nm);
  hold(step.loads.peak_force_n, "the largest force that the plan states for the step", &Loads::force_n);
  hold(step.loads.torque_nm, "the largest torque that the plan states for the step", &Loads::torque_nm);
  hold(step.loads.power_w, "the largest power that the plan states for the step", &Loads::power_w);
  return out;
}

}  // namespace capstan::verify
