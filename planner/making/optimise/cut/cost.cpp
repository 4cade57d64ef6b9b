#include "planner/making/optimise/cut/cost.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string_view>

#include "planner/making/optimise/cut/limits.h"
#include "planner/physics/mechanics/life/life.h"

namespace capstan::optimise {
namespace {

const model::ToolLifeLaw* law_of(const CutQuestion& q) {
  const std::string_view substrate = model::to_text(q.cutter.substrate);
  for (const model::ToolLifeLaw& l : q.material.life) {
    if (l.substrate == substrate && l.life_min > 0.0) return &l;
  }
  return nullptr;
}

/// What a minute counts. What stands still while an edge is changed costs what it would have earned, too.
double minute_of(const CutQuestion& q) {
  if (q.aim == Aim::kTime) return 1.0;
  const double rate = (q.machine.cost_per_hour > 0.0 ? q.machine.cost_per_hour : kMachinePerHour) / 60.0;
  return rate + (q.aim == Aim::kProfit ? std::max(0.0, q.earning_per_min) : 0.0);
}

}  // namespace

double edge_life_min(const CutQuestion& q, const CutPoint& at) {
  // An edge that is in the cut for a short arc lives as one at a lower speed.
  const double vc = std::numbers::pi * speed_diameter_mm(q) * at.n_rpm / 1000.0 / speed_by_arc(q, at.ae_mm);
  if (const auto* l = law_of(q)) {
    const double fz = at.feed_mm_min / (at.n_rpm * teeth_of(q));
    const double depth = is_milling(q.kind) ? at.ap_mm : 0.5 * q.cutter.cutting_diameter_mm;
    const double life = mechanics::median_life_min(*l, vc, fz, depth) * std::exp(-mechanics::scatter_of(*l));
    if (life > 0.0) return life;
  }
  const double n = mechanics::taylor_exponent(q.cutter.substrate);
  const double at_table = q.cutter.life_min > 0.0 ? q.cutter.life_min : mechanics::kLifeAtTableMin;
  return q.vc_start_m_min > 0.0 ? at_table * mechanics::taylor_factor(vc, q.vc_start_m_min, n) : at_table;
}

double time_of(const CutQuestion& q, const CutPoint& at) {
  if (!is_milling(q.kind)) return 1.0 / at.feed_mm_min;
  // The area of a level is at least that of a square on the narrower side.
  const double area =
      q.width_mm > 0.0 ? q.width_mm * std::max(q.width_mm, q.cutter.cutting_diameter_mm) : 0.0;
  const double change =
      area > 0.0 && q.kind == CutKind::kRough ? kLevelOverheadS / 60.0 / (area * at.ap_mm) : 0.0;
  return 1.0 / (at.ap_mm * at.ae_mm * at.feed_mm_min) + change;
}

double objective_without_edges(const CutQuestion& q, const CutPoint& at) {
  return minute_of(q) * time_of(q, at);
}

double objective_of(const CutQuestion& q, const CutPoint& at) {
  if (q.aim == Aim::kTime) return time_of(q, at);
  const double cutting =
      is_milling(q.kind) ? 1.0 / (at.ap_mm * at.ae_mm * at.feed_mm_min) : 1.0 / at.feed_mm_min;
  const double edge = std::max(0.0, q.cutter.price) + minute_of(q) * q.machine.tool_change_s / 60.0;
  return objective_without_edges(q, at) + edge * cutting / edge_life_min(q, at);
}

}  // namespace capstan::optimise
