#include <algorithm>
#include <cmath>

#include "planner/model/plan/order/step_ids.h"
#include "planner/proof/verify/plan/plan_checks.h"

namespace capstan::verify {
namespace {

bool finite(double v) { return std::isfinite(v) && std::abs(v) < 1e7; }

bool columns_agree(const model::StepResult& s) {
  const model::CutterPath& p = *s.path;
  const std::size_t n = p.size();
  if (p.y.size() != n || p.z.size() != n || p.cx.size() != n || p.cy.size() != n || p.kind.size() != n ||
      p.role.size() != n) {
    return false;
  }
  if (!s.schedule) return true;
  return s.schedule->feed_mm_min.size() == n && s.schedule->spindle_rpm.size() == n &&
         s.schedule->dwell_s.size() == n;
}

bool step_numbers(const model::StepResult& s) {
  for (const double v :
       {s.axial_depth_mm, s.radial_depth_mm, s.vc_m_min, s.fz_mm, s.spindle_rpm, s.feed_mm_min, s.cutting_s,
        s.rapid_s, s.loads.peak_force_n, s.loads.torque_nm, s.loads.power_w, s.loads.deflection_mm,
        s.loads.chip_thickness_mm, s.loads.mrr_mm3_min}) {
    if (!std::isfinite(v)) return false;
  }
  return true;
}

/// The first of a move's numbers that is none, "its feed is inf"; empty: all are.
std::string not_finite(const model::StepResult& s, std::size_t i) {
  const model::CutterPath& p = *s.path;
  struct Number {
    const char* name;
    double value;
  };
  std::vector<Number> all = {
      {"x", p.x[i]}, {"y", p.y[i]}, {"z", p.z[i]}, {"arc's centre x", p.cx[i]}, {"arc's centre y", p.cy[i]}};
  if (s.schedule)
    all.insert(all.end(), {{"feed", s.schedule->feed_mm_min[i]},
                           {"spindle speed", s.schedule->spindle_rpm[i]},
                           {"dwell", s.schedule->dwell_s[i]}});
  for (const Number& n : all) {
    if (!finite(n.value))
      return std::string("its ") + n.name + " is " + plain(n.value) +
             ", which is not a finite number below 1e7";
  }
  return {};
}

bool moves_finite(const model::StepResult& s, const std::string& id, std::size_t order, Findings& findings) {
  const model::CutterPath& p = *s.path;
  for (std::size_t i = 0; i < p.size(); ++i) {
    std::string wrong = not_finite(s, i);
    if (wrong.empty()) continue;
    findings.error(1, "CHK-NUMBER", {order + 1, id, static_cast<long>(i)}, std::move(wrong));
    return false;
  }
  return true;
}

StepMoves of_step(const model::Plan& plan, const model::StepResult& s, std::size_t order, std::string id) {
  StepMoves out{order, std::move(id), &s, model::find_cutter(plan, s.cutter_id), s.setup, {}};
  const model::CutterPath& p = *s.path;
  // The path's first point is reached by rapid from straight above.
  const double security = s.setup < plan.setups.size() ? plan.setups[s.setup].security_z_mm : p.z[0];
  Move m;
  m.role_known = true;
  m.role = model::MoveRole::kApproach;
  m.to = p.point(0);
  m.from = {m.to.x, m.to.y, std::max(m.to.z, security)};
  m.where = 0;
  m.spindle_rpm = s.schedule ? s.schedule->spindle_rpm[0] : s.spindle_rpm;
  out.moves.push_back(m);
  for (std::size_t i = 1; i < p.size(); ++i) {
    m.kind = p.kind[i];
    m.role = p.role[i];
    m.from = p.point(i - 1);
    m.to = p.point(i);
    m.centre = {p.cx[i], p.cy[i]};
    m.feed_mm_min = s.schedule ? s.schedule->feed_mm_min[i] : s.feed_mm_min;
    m.spindle_rpm = s.schedule ? s.schedule->spindle_rpm[i] : s.spindle_rpm;
    m.dwell_s = s.schedule ? s.schedule->dwell_s[i] : 0.0;
    m.synchronised = m.role == model::MoveRole::kTap;
    m.where = static_cast<long>(i);
    out.moves.push_back(m);
  }
  return out;
}

}  // namespace

std::vector<StepMoves> moves_of(const model::Plan& plan, Findings& findings) {
  return moves_of_first(plan, plan.steps.size(), findings);
}

std::vector<StepMoves> moves_of_first(const model::Plan& plan, std::size_t steps, Findings& findings) {
  std::vector<StepMoves> out;
  std::vector<std::string> ids = model::step_ids(plan);
  for (std::size_t i = 0; i < std::min(steps, plan.steps.size()); ++i) {
    const model::StepResult& s = plan.steps[i];
    if (!s.path || s.path->size() == 0) continue;
    std::string id = std::move(ids[i]);
    if (!columns_agree(s)) {
      findings.error(1, "CHK-COLUMNS", {i + 1, id, -1},
                     "the columns of its path and its feed schedule differ in length; the path has " +
                         std::to_string(s.path->size()) + " moves: plan the step anew");
      continue;
    }
    if (!step_numbers(s)) {
      findings.error(1, "CHK-NUMBER", {i + 1, id, -1},
                     "one of the step's depths, feeds, times or loads is not finite");
    }
    if (!moves_finite(s, id, i, findings)) continue;
    out.push_back(of_step(plan, s, i, std::move(id)));
  }
  return out;
}

std::optional<StepMoves> moves_of_step(const model::Plan& plan, const model::StepResult& step,
                                       std::size_t order, const std::string& id) {
  Findings unsaid;
  if (!step.path || step.path->size() == 0 || !columns_agree(step) || !moves_finite(step, id, order, unsaid))
    return std::nullopt;
  return of_step(plan, step, order, id);
}

}  // namespace capstan::verify
