#include <algorithm>
#include <cmath>
#include <numbers>

#include "planner/mechanics/constants.h"
#include "planner/mechanics/drilling.h"
#include "planner/mechanics/loads.h"
#include "planner/mechanics/surface.h"
#include "planner/optimise/cut/limits.h"

namespace capstan::optimise {
namespace {

using std::numbers::pi;

/// How much larger a force may be than the coefficients say: their spread, and a worn edge.
double force_margin(const CutQuestion& q) {
  return std::max(mechanics::kForceUncertaintyFactor, 1.0 + q.material.kc_uncertainty) *
         mechanics::kWearForceFactor;
}

mechanics::ToolStiffness stiffness(const model::Cutter& c) {
  const double e = c.substrate == model::Substrate::kCarbide ? mechanics::kCarbideYoungsModulusNMm2
                                                             : mechanics::kHssYoungsModulusNMm2;
  const double out =
      c.stick_out_mm > 0.0 ? c.stick_out_mm : std::max(c.usable_length_mm, 3.0 * c.cutting_diameter_mm);
  const double shank = c.shank_diameter_mm > 0.0 ? c.shank_diameter_mm : c.cutting_diameter_mm;
  const double flute = c.maximum_depth_of_cut_mm > 0.0 ? std::min(c.maximum_depth_of_cut_mm, out) : out;
  return {out, shank, flute, c.cutting_diameter_mm, e};
}

/// Feed marks on the wall, and on the floor where a corner radius leaves some; at the planned feed.
double surface_rz(const CutQuestion& q, double fz_mm) {
  const double wall = mechanics::wall_rz_mm(fz_mm, q.cutter.cutting_diameter_mm);
  const double corner = q.cutter.corner_radius_mm;
  return corner > 0.0 ? std::max(wall, mechanics::floor_rz_mm(fz_mm, corner)) : wall;
}

}  // namespace

double feed_override(const CutQuestion& q) {
  if (q.override_locked || q.kind == CutKind::kTap) return 1.0;
  if (q.feed_mm_min && !q.feed_by_planning) return 1.0;
  return std::max(1.0, q.machine.abilities.feed_override_max);
}

std::optional<model::StepLoads> loads_of(const CutQuestion& q, double ap_mm, double ae_mm, double n_rpm,
                                         double feed_mm_min) {
  const mechanics::WorkMaterial work{q.material.kc11_n_mm2, q.material.mc};
  const double margin = force_margin(q);
  const double up = feed_override(q);
  const double fz = up * feed_mm_min / (n_rpm * teeth_of(q));
  model::StepLoads out;
  if (is_milling(q.kind)) {
    mechanics::MillingCut c;
    c.ap_mm = ap_mm;
    c.ae_mm = std::min(ae_mm, q.cutter.cutting_diameter_mm);
    c.fz_mm = fz;
    c.n_rpm = n_rpm;
    c.cutting_diameter_mm = q.cutter.cutting_diameter_mm;
    c.teeth = teeth_of(q);
    c.helix_rad = q.cutter.helix_rad;
    c.corner_radius_mm = q.cutter.corner_radius_mm;
    c.ball = q.cutter.cutter_class == model::CutterClass::kBallEndmill;
    const auto l = mechanics::milling_loads(c, work, stiffness(q.cutter));
    if (!l) return std::nullopt;
    out.peak_force_n = l->peak_force_n * margin;
    out.torque_nm = l->torque_nm * margin;
    out.power_w = l->power_w * margin;
    out.deflection_mm = l->deflection_mm * margin;
    out.chip_thickness_mm = l->h_max_mm / up;
    out.mrr_mm3_min = l->mrr_mm3_min / up;
    out.surface_rz_mm = surface_rz(q, fz / up);
    return out;
  }
  if (q.kind == CutKind::kTap) {
    mechanics::TappingCut c;
    c.nominal_diameter_mm = q.cutter.cutting_diameter_mm;
    c.pitch_mm = q.cutter.thread_pitch_mm;
    c.core_hole_diameter_mm = q.pre_hole_mm > 0.0 ? q.pre_hole_mm : c.nominal_diameter_mm - c.pitch_mm;
    c.n_rpm = n_rpm;
    const auto l = mechanics::tapping_loads(c, work);
    if (!l) return std::nullopt;
    out.torque_nm = l->torque_nm * margin;
    out.power_w = l->power_w * margin;
    out.chip_thickness_mm = l->chip_thickness_mm;
    return out;
  }
  mechanics::DrillingCut c;
  c.diameter_mm = q.cutter.cutting_diameter_mm;
  c.feed_mm_per_rev = up * feed_mm_min / n_rpm;
  c.n_rpm = n_rpm;
  c.teeth = teeth_of(q);
  c.point_angle_rad = q.cutter.point_angle_rad > 0.0 ? q.cutter.point_angle_rad : pi;
  if (q.engaged_diameter_mm > 0.0) c.diameter_mm = std::min(c.diameter_mm, q.engaged_diameter_mm);
  c.pre_hole_diameter_mm = q.pre_hole_mm < c.diameter_mm ? q.pre_hole_mm : 0.0;
  const auto l =
      q.kind == CutKind::kReam ? mechanics::reaming_loads(c, work) : mechanics::drilling_loads(c, work);
  if (!l) return std::nullopt;
  out.peak_force_n = l->thrust_n * margin;
  out.torque_nm = l->torque_nm * margin;
  out.power_w = l->power_w * margin;
  out.chip_thickness_mm = l->chip_thickness_mm / up;
  out.mrr_mm3_min = l->removal_mm3_min / up;
  return out;
}

}  // namespace capstan::optimise
