#include "planner/making/step/cut/deviation.h"

#include <algorithm>
#include <cmath>

#include "planner/ground/base/number.h"

// The deviation that a path, and the control that follows it, may use: from the tolerance, step by step.

namespace capstan::step {
namespace {

using draft::StepDraft;
using model::AnyRef;
using model::FeatureShape;
using model::Toleranced;

// Shares of what may be lost. A tenth of the tolerance for the finishing step is the rule that gauges are
// chosen by; a quarter of what stays on the wall keeps rough cuts well within it. Defaults, unsourced.
constexpr double kFinishShare = 0.1;
constexpr double kRoughShare = 0.25;
constexpr double kFinest = 0.001;   // mm: what the paths themselves are made to
constexpr double kCoarsest = 0.05;  // mm; default, unsourced
constexpr double kUnstated =
    0.01;  // mm: largest deviation of a finishing step if the machine states none; default, unsourced
constexpr double kGrid = 0.0001;  // mm: stated no finer, and rounded down

double clipped(double v, double most) {
  return std::floor(std::clamp(v, kFinest, most) / kGrid + 1e-6) * kGrid;
}

/// The narrowest tolerance zone of a feature: from its sizes, the general tolerance, form and position.
struct Tightest {
  double mm = 0.0;
  std::string of;
};

void take(Tightest& t, double width, const std::string& of) {
  if (width > 0.0 && (t.mm == 0.0 || width < t.mm)) t = {width, of};
}

Tightest tightest(const PlanSoFar& p, AnyRef feature, const FeatureShape& s) {
  Tightest out;
  const auto size = [&](const Toleranced& t, const char* name) {
    if (!(t.nominal_mm > 0.0)) return;
    if (t.given) return take(out, t.width(), "the tolerance of the " + std::string(name));
    const auto general =
        p.demands.general ? model::general_size(*p.demands.general, t.nominal_mm) : std::nullopt;
    if (general) take(out, 2.0 * *general, "the general tolerance of the " + std::string(name));
  };
  size(s.width, "width");
  size(s.length, "length");
  size(s.diameter, "diameter");
  Toleranced depth = s.depth_tolerance;
  depth.nominal_mm = s.depth_mm;
  if (!s.through) size(depth, "depth");
  if (const auto it = p.demands.qualities.find(feature); it != p.demands.qualities.end()) {
    const model::Quality& q = it->second;
    take(out, q.form_mm.value_or(0.0), "the tolerance of form");
    take(out, q.orientation_mm.value_or(0.0), "the tolerance of orientation");
    take(out, q.location_mm.value_or(0.0), "the tolerance of location");
    take(out, q.runout_mm.value_or(0.0), "the tolerance of run-out");
    take(out, q.profile_mm.value_or(0.0), "the tolerance of profile");
  }
  return out;
}

}  // namespace

Deviation deviation_of(const PlanSoFar& p, const StepDraft& step, const toolpath::PathJob& job) {
  Deviation out;
  const model::Model& m = p.plan.model;
  if (!m.holds<model::MillingTypeOperation>(step.operation) || step.shapes.empty()) return out;
  if (m.holds<model::DrillingTypeOperation>(step.operation)) return out;
  const double own = p.plan.machine.control.path_tolerance_mm;
  const Tightest t = tightest(p, step.feature, step.shapes.front());
  const double most = own > 0.0 ? std::max(own, kFinest) : kUnstated;
  const double share = kFinishShare * t.mm;
  const double finest = t.mm > 0.0 ? clipped(share, most) : own;
  // The allowance on every surface that the step cuts: of a face the floor, of a wall alone the side.
  double left = 0.0;
  if (m.holds<model::PlaneMilling>(step.operation)) {
    left = job.allowance_bottom_mm;
  } else if (m.holds<model::SideMilling>(step.operation) || step.shapes.front().through) {
    left = job.allowance_side_mm;
  } else {
    left = std::min(job.allowance_side_mm, job.allowance_bottom_mm);
  }
  if (left > 0.0 && finest > 0.0) {
    out.mm = std::max(finest, clipped(kRoughShare * left, kCoarsest));
    out.why = "path deviation and contour tolerance " + trimmed(out.mm, 4) + " mm: a quarter of the " +
              trimmed(left, 3) + " mm that it leaves (default, unsourced)";
  } else if (t.mm > 0.0 && finest > 0.0) {
    out.mm = finest;
    const std::string asked =
        "a tenth of " + t.of + ", " + trimmed(t.mm, 4) + " mm wide (default, unsourced)";
    out.why = "path deviation and contour tolerance " + trimmed(out.mm, 4) + " mm: ";
    if (share < kFinest) {
      out.why += "the finest that paths are made to; " + asked + " would be " + trimmed(share, 5) + " mm";
    } else if (share > most) {
      out.why += (own > 0.0 ? "the control's own; " : "the most for a finish (default, unsourced); ") +
                 asked + " would be " + trimmed(share, 4) + " mm";
    } else {
      out.why += asked;
    }
  }
  return out;
}

}  // namespace capstan::step
