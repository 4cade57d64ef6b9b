#include "planner/door/app/command/cases/planned_limits.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "casebase/casebase.h"
#include "planner/making/optimise/cut.h"
#include "planner/model/nouns/executable.h"
#include "planner/physics/mechanics/force/force_law.h"
#include "planner/physics/mechanics/life/life.h"
#include "planner/physics/mechanics/spindle.h"

namespace capstan::app {
namespace {

using casebase::tune::Setting;

/// The power of the spindle at a speed; 0: not known.
double power_at(const model::Machine& machine, double rpm) {
  std::vector<mechanics::SpindlePoint> points;
  for (const auto& p : machine.spindle.curve) points.push_back({p.rpm, p.power_w, p.torque_nm});
  const auto curve = mechanics::SpindleCurve::make(std::move(points));
  if (!curve) return 0.0;
  const auto capacity = curve->at(rpm);
  return capacity ? capacity->power_w : 0.0;
}

/// The step's cut as a question: what it was bound to, and the limits that held it.
optimise::CutQuestion question_of(const model::Plan& plan, const model::StepResult& step,
                                  const model::Cutter& cutter) {
  optimise::CutQuestion q;
  q.cutter = cutter;
  q.material = plan.material;
  q.machine = plan.machine;
  q.depth_mm = step.axial_depth_mm;
  q.width_mm = step.radial_depth_mm;
  q.ap_mm = step.axial_depth_mm;
  q.ae_mm = step.radial_depth_mm;
  for (const model::ActiveConstraint& a : step.active) {
    if (a.name == "peak_force") q.peak_force_limit_n = a.limit;
    if (a.name == "wall_error") q.wall_error_limit_mm = a.limit;
    if (a.name == "surface_roughness") q.surface_ra_um = a.limit;
    if (a.name == "tool_deflection") q.deflection_limit_mm = a.limit;
  }
  return q;
}

}  // namespace

Result<casebase::tune::PlannedStep> planned_step(const model::Plan& plan, const model::StepResult& step) {
  auto asked = casebase::case_of(plan, step);
  if (!asked) return tl::unexpected(asked.error());
  casebase::tune::PlannedStep out;
  out.step = *std::move(asked);
  const model::Cutter& cutter = *model::find_cutter(plan, step.cutter_id);  // case_of has found it
  const auto* ws = plan.model.get<model::MachiningWorkingstep>(step.step);
  out.force_margin = step.loads.force_margin;
  const bool milled = mechanics::is_milled(ws->its_operation.type, cutter);
  out.force_spread = (milled ? mechanics::force_margin(plan.material, cutter.substrate)
                             : mechanics::kienzle_margin(plan.material))
                         .spread;
  out.power_limit_w = mechanics::spindle_efficiency(plan.machine.spindle.efficiency) *
                      power_at(plan.machine, step.spindle_rpm);
  out.mc = plan.material.mc;
  out.taylor_n = mechanics::taylor_exponent(cutter.substrate);
  // Drills, reamers and taps are only ever lowered: their feeds are bound to depth and thread.
  if (!milled || !(step.axial_depth_mm > 0.0) || !(step.radial_depth_mm > 0.0)) return out;
  // What limits the step elsewhere along its path is not in the question: a load that is at its limit there
  // already is not raised here.
  const optimise::CutQuestion base = question_of(plan, step, cutter);
  const auto load_at = [base, vc = step.vc_m_min, fz = step.fz_mm](const Setting& s) {
    optimise::CutQuestion q = base;
    q.vc_start_m_min = vc * std::exp(s.ln_vc);
    q.fz_start_mm = fz * std::exp(s.ln_fz);
    const double n = 1000.0 * q.vc_start_m_min / (std::numbers::pi * q.cutter.cutting_diameter_mm);
    const double feed = n * std::max(1, q.cutter.teeth) * q.fz_start_mm;
    if (n > q.machine.spindle.rpm_max || (q.cutter.maximum_speed_rpm > 0.0 && n > q.cutter.maximum_speed_rpm))
      return 2.0;
    const auto loads = optimise::loads_of(q, *q.ap_mm, *q.ae_mm, n, feed);
    if (!loads) return 2.0;
    double worst = 1.0 + optimise::worst_excess(q, *loads, n);
    if (q.cutter.fz_max_mm > 0.0) worst = std::max(worst, q.fz_start_mm / q.cutter.fz_max_mm);
    return worst;
  };
  out.hard = load_at;
  return out;
}

}  // namespace capstan::app
