#include <algorithm>
#include <cmath>
#include <numbers>

#include "planner/model/plan/cutter/ramp.h"
#include "planner/physics/mechanics/bending/beam.h"
#include "planner/physics/mechanics/bending/deflection.h"
#include "planner/physics/mechanics/constants.h"
#include "planner/physics/mechanics/force/drilling.h"
#include "planner/physics/mechanics/force/force_law.h"
#include "planner/physics/mechanics/force/immersion.h"
#include "planner/physics/mechanics/force/kienzle.h"
#include "planner/physics/mechanics/force/thread_cut.h"
#include "planner/physics/mechanics/loads/width.h"
#include "planner/physics/mechanics/spindle.h"
#include "planner/physics/mechanics/stability.h"
#include "tooling/library/cutters/edge_kind.h"
#include "tooling/selection/limits.h"

// Estimated time of a step with a cutter: rough, the same for all candidates, without any optimiser.

namespace capstan::tooling {
namespace {

using model::Cutter;
using model::CutterClass;
using model::Machine;
using model::ToolRequirement;
using model::WorkMaterial;

constexpr double kPi = std::numbers::pi;
/// Volume of a step whose removal is unknown. Default, unsourced.
constexpr double kNominalVolumeMm3 = 2000.0;
/// A mill's cut at most, as parts of its diameter; default, unsourced (the optimiser's own bounds are wider).
constexpr double kWidthRatio = 0.5, kDepthRatio = 1.0;
/// The usual side allowance of roughing, mm; default, unsourced.
constexpr double kAllowanceMm = 0.3;
/// Bending of the tip that roughing may have, mm: what that allowance leaves over the thinnest pass that
/// finishes it, at least half of it (as planner/making/step/cut/question.cpp).
double bending_mm(const Cutter& c, const WorkMaterial& w) {
  const bool hss = c.substrate == model::Substrate::kHss;
  const double least = mechanics::least_depth_mm(c.cutting_diameter_mm, hss, w.iso_group);
  return std::max(0.5 * kAllowanceMm, kAllowanceMm - least);
}
/// In aluminium and copper chips need room: teeth beyond these are not counted. Default, unsourced.
constexpr int kTeethInSoft = 3;

struct Capacity {
  double power_w = 0.0, torque_nm = 0.0;
};
std::optional<Capacity> capacity(const Turning& t, double rpm) {
  const auto& curve = t.curve;
  if (!curve) return std::nullopt;
  const auto at = curve->at(std::clamp(rpm, curve->min_rpm(), curve->max_rpm()));
  if (!at) return std::nullopt;
  const double e = mechanics::spindle_efficiency(t.machine.spindle.efficiency);
  return Capacity{at->power_w * e, at->torque_nm * e};
}

double margin_of(const WorkMaterial& w) { return mechanics::kienzle_margin(w).factor(); }

void scale_down(double part, const char* by, double& scale, std::string& limited) {
  if (part >= scale) return;
  scale = part;
  limited = by;
}

/// Of the tip, mm/N. A long neck is most of what bends; without one the holder is left out as stiff.
Result<double> compliance_mm_n(const Cutter& c) {
  if (c.neck_diameter_mm > 0.0) return mechanics::tip_compliance_mm_n(c);
  const double d = c.cutting_diameter_mm;
  const double e = c.substrate == model::Substrate::kCarbide ? mechanics::kCarbideYoungsModulusNMm2
                                                             : mechanics::kHssYoungsModulusNMm2;
  const double out = c.stick_out_mm > 0.0 ? c.stick_out_mm : 3.0 * d;
  const double shank = c.shank_diameter_mm > 0.0 ? c.shank_diameter_mm : d;
  const double flute = c.maximum_depth_of_cut_mm > 0.0 ? std::min(c.maximum_depth_of_cut_mm, out) : out;
  return mechanics::tip_compliance_mm_n({out, shank, flute, d, e});
}

/// Deepest level of roughing, mm: as far as the cutter stays quiet where no modes are known, and no deeper
/// than its slots where each level begins with one; the limits that the optimiser keeps
/// (making/optimise/cut).
double deepest_mm(const Cutter& c, const WorkMaterial& w, const Machine& m, const Preferences& p,
                  std::string& limited) {
  double ap = kDepthRatio * c.cutting_diameter_mm;
  if (c.maximum_depth_of_cut_mm > 0.0) ap = std::min(ap, c.maximum_depth_of_cut_mm);
  if (p.depth_mm > 0.0) ap = std::min(ap, p.depth_mm);
  if (!p.roughs) return ap;
  const auto lower = [&](double most, const char* by) {
    if (!(most > 0.0) || most >= ap) return;
    ap = most;
    limited = by;
  };
  if (c.stick_out_mm > 0.0 && mechanics::modes_for(m, c.id).empty())
    lower(mechanics::slender_depth_mm(c.cutting_diameter_mm, c.stick_out_mm), "its stick-out");
  if (p.walled) lower(model::ramp_of(c, w).slot_depth_mm, "the depth of its slots");
  return ap;
}

/// A thread: a turn for each pitch, all of them in one where the cutter's profiles are as long as the thread,
/// a half to lead in and one to lead out (planner/making/toolpath/hole, bore_and_thread.cpp). All profiles
/// that are in the cut push at once. What they do is as long as they are; only the feed can give way, and the
/// force falls with its power of 1 - mc.
double thread_s(const Cutter& c, double fz_mm, double rpm, int teeth, const WorkMaterial& w, const Turning& t,
                const Preferences& p, std::string& limited) {
  const double d = c.cutting_diameter_mm, r = 0.5 * (p.bore_mm - d);
  const double core = p.pre_hole_mm > 0.0 ? p.pre_hole_mm : p.bore_mm - p.pitch_mm;
  const auto cut =
      mechanics::thread_bound(d, c.maximum_depth_of_cut_mm, {p.bore_mm, p.pitch_mm, p.depth_mm, core});
  const mechanics::WorkMaterial work = mechanics::milled_with(w, c);
  const double chip = mechanics::max_chip_thickness_mm(1.0, cut.ae_mm, d);
  double fz = fz_mm * cut.centre_share / chip;
  const double h_mean = mechanics::mean_chip_thickness_mm(fz, cut.ae_mm, d);
  double scale = 1.0;
  if (h_mean > 0.0) {
    const double margin = margin_of(w), kc = mechanics::specific_force_n_mm2(work, h_mean);
    const double power = margin * mechanics::cutting_power_w(cut.ap_mm * cut.ae_mm * fz * teeth * rpm, kc);
    if (const auto most = capacity(t, rpm)) {
      scale_down(most->power_w / power, "power", scale, limited);
      scale_down(most->torque_nm / mechanics::spindle_torque_nm(power, rpm), "torque", scale, limited);
    }
    const double in_cut =
        std::max(1.0, mechanics::mean_engaged_teeth(teeth, mechanics::immersion_angle_rad(cut.ae_mm, d)));
    const double one = mechanics::specific_force_n_mm2(work, fz * chip) * fz * chip * cut.ap_mm;
    const double force = margin * one * in_cut * std::hypot(1.0, mechanics::kRadialToTangentialRatio);
    const double bending = p.bending_mm > 0.0 ? p.bending_mm : bending_mm(c, w);
    if (const auto bend = mechanics::tip_compliance_mm_n(c))
      scale_down(std::min(bending, mechanics::enduring_bend_mm(c).value_or(bending)) / (force * *bend),
                 "bending", scale, limited);
  }
  fz *= std::pow(scale, 1.0 / (1.0 - work.mc));
  const bool all_at_once = c.maximum_depth_of_cut_mm >= p.depth_mm;
  const double turns = all_at_once ? 1.0 : std::ceil(p.depth_mm / p.pitch_mm - 1e-9);
  return 60.0 * kPi * r * (2.0 * turns + 1.0) / (fz * teeth * rpm);
}

/// Way of a cutter's middle along the helix of a bore, mm, in lengths at its full feed; nothing where the
/// bore is cleared as a pocket. As planner/making/toolpath/hole (bore_and_thread.cpp): a mill goes round the
/// hole that is there as deep as it may cut, else down by its ramp; a last turn is level.
std::optional<double> helix_mm(const Cutter& c, const WorkMaterial& w, const Preferences& p, double ap_mm) {
  const double d = c.cutting_diameter_mm, r = 0.5 * (p.bore_mm - d);
  if (!(r > 0.0)) return std::nullopt;
  const double turn = 2.0 * kPi * r, in_and_out = kPi * r;
  const double hole = 0.5 * p.pre_hole_mm, flat = std::max(0.5 * d - c.corner_radius_mm, 0.25 * d);
  if (r - flat > hole + 1e-9) return std::nullopt;  // a core would stay
  if (r + model::kMiddleOfRadius * 0.5 * d <= 0.5 * p.open_below_mm)
    return turn * (std::ceil(p.depth_mm / ap_mm - 1e-9) + 1.0) + in_and_out;
  const model::Ramp ramp = model::ramp_of(c, w);
  if (!(ramp.angle_rad > 0.0) || r > 0.5 * d + 1e-9) return std::nullopt;
  return p.depth_mm / (std::sin(ramp.angle_rad) * ramp.feed_share) + turn + in_and_out;
}

/// Passes over an open face of this width.
double passes_over(const Cutter& c, double width_mm) {
  constexpr double kSlack = 1e-9;
  const double d = c.cutting_diameter_mm, flat = std::max(d - 2.0 * c.corner_radius_mm, 0.1 * d);
  if (width_mm <= std::min(mechanics::kFaceWidthRatio * d, flat) * (1.0 + kSlack)) return 1.0;
  return std::ceil(width_mm / std::min(mechanics::kRoughWidthRatio * d, flat) - kSlack);
}

double milling_s(const Cutter& c, const ToolRequirement& r, const StartValues& s, const WorkMaterial& w,
                 const Turning& t, const Preferences& p, std::string& limited) {
  const double d = c.cutting_diameter_mm;
  const double volume = p.volume_mm3 > 0.0 ? p.volume_mm3 : kNominalVolumeMm3;
  double ae = kWidthRatio * d;
  if (p.width_mm > 0.0) ae = std::min(ae, p.width_mm);
  const bool face = p.face_mm > 0.0 && p.width_mm > 0.0;
  const double passes = face ? passes_over(c, p.width_mm) : 0.0;
  if (face) ae = p.width_mm / passes;
  double ap = deepest_mm(c, w, t.machine, p, limited);
  // The speed is that of the widest circle that cuts, the start values are at the tip's.
  const double slower = d / widest_circle_mm(c, ap);
  const double rpm = slower * s.spindle_rpm;
  double feed = slower * s.feed_mm_min;
  int teeth = c.teeth;
  if (w.iso_group == "N" && teeth > kTeethInSoft) {
    feed *= static_cast<double>(kTeethInSoft) / teeth;
    teeth = kTeethInSoft;
  }
  if (p.pitch_mm > 0.0 && p.bore_mm > d) return thread_s(c, s.fz_mm, rpm, teeth, w, t, p, limited);
  const mechanics::WorkMaterial work = mechanics::milled_with(w, c);
  const double sin_kappa = std::cos(c.lead_angle_rad);
  const double h_mean = mechanics::mean_chip_thickness_mm(s.fz_mm, ae, d, sin_kappa);
  const double h_max = mechanics::max_chip_thickness_mm(s.fz_mm, ae, d, sin_kappa);
  double scale = 1.0;
  if (h_mean > 0.0 && h_max > 0.0) {
    const double margin = margin_of(w);
    const double kc = mechanics::specific_force_n_mm2(work, h_mean);
    const double power = margin * mechanics::cutting_power_w(ap * ae * feed, kc);
    if (const auto most = capacity(t, rpm)) {
      scale_down(most->power_w / power, "power", scale, limited);
      scale_down(most->torque_nm / mechanics::spindle_torque_nm(power, rpm), "torque", scale, limited);
    }
    // One tooth at its thickest chip, radial force included, or all that are in the cut on average.
    const double in_cut =
        std::max(1.0, mechanics::mean_engaged_teeth(teeth, mechanics::immersion_angle_rad(ae, d)));
    const double one = mechanics::specific_force_n_mm2(work, h_max) * h_max * ap / sin_kappa;
    const double force = margin * one * in_cut * std::hypot(1.0, mechanics::kRadialToTangentialRatio);
    const double bending = bending_mm(c, w);
    if (const auto bend = compliance_mm_n(c))
      scale_down(std::min(bending, mechanics::enduring_bend_mm(c).value_or(bending)) / (force * *bend),
                 "bending", scale, limited);
  }
  ap *= scale;
  if (p.bore_mm > 0.0) {
    if (const auto helix = helix_mm(c, w, p, ap)) return 60.0 * *helix / feed;
  }
  // The edges come into the face and leave it within a diameter of the cutter's way. What a limit asks is
  // given by more levels or by less feed, whichever takes less: the force falls with the feed's power of
  // 1 - mc.
  if (face && p.depth_mm > 0.0) {
    const auto levels = [&](double each_mm) { return std::ceil(p.depth_mm / each_mm - 1e-9); };
    const double slowed = levels(ap / scale) / std::pow(scale, 1.0 / (1.0 - work.mc));
    return 60.0 * std::min(levels(ap), slowed) * passes * (p.face_mm + d) / feed;
  }
  // Levels are whole.
  if (p.depth_mm > 0.0) ap = p.depth_mm / std::ceil(p.depth_mm / ap - 1e-9);
  double minutes = volume / (ap * ae * feed);
  if (p.floor_mm2 > 0.0 && p.depth_mm > 0.0) {  // less what the passes along its walls cover
    const double walls = volume / (p.depth_mm * ae);
    minutes += std::max(0.0, p.floor_mm2 - walls * d) / (kWidthRatio * d * feed);
  }
  const bool blind_bore = p.bore_mm > 0.0 && !(p.open_below_mm > 0.0);
  if ((r.centre_cutting && p.walled) || blind_bore) {
    const model::Ramp ramp = model::ramp_of(c, w);
    if (ramp.angle_rad > 0.0) minutes += p.depth_mm / (std::sin(ramp.angle_rad) * ramp.feed_share * feed);
  }
  return 60.0 * minutes;
}

/// Parallel passes of a ball over a surface, as far apart as their ridges allow on a level one.
double passes_s(const Cutter& c, const StartValues& s, const Preferences& p) {
  const double d = c.cutting_diameter_mm, h = std::min(p.ridges_mm, 0.5 * d);
  return 60.0 * p.passes_mm2 / (2.0 * std::sqrt(h * (d - h)) * s.feed_mm_min);
}

double axial_s(const Cutter& c, const ToolRequirement& r, const StartValues& s, const WorkMaterial& w,
               const Turning& t, const Preferences& p, std::string& limited) {
  double length = p.depth_mm > 0.0 ? p.depth_mm : r.depth_of_cut_mm;
  if (!(length > 0.0)) length = r.reach_mm > 0.0 ? r.reach_mm : c.cutting_diameter_mm;
  double scale = 1.0;
  if (model::has(c.cutter_class, model::CutterTrait::kDrills)) {
    const double hole = p.pre_hole_mm < c.cutting_diameter_mm ? p.pre_hole_mm : 0.0;
    const auto l =
        mechanics::drilling_loads({c.cutting_diameter_mm, s.fz_mm * c.teeth, s.spindle_rpm, c.teeth,
                                   c.point_angle_rad > 0.0 ? c.point_angle_rad : kPi, hole},
                                  {w.kc11_n_mm2, w.mc});
    const auto most = capacity(t, s.spindle_rpm);
    if (l && most) {
      const double margin = margin_of(w), slope = 1.0 / (1.0 - w.mc);  // M grows with f^(1 - mc)
      scale_down(std::pow(most->torque_nm / (margin * l->torque_nm), slope), "torque", scale, limited);
      scale_down(std::pow(most->power_w / (margin * l->power_w), slope), "power", scale, limited);
    }
  }
  // These come out as slowly as they go in.
  const bool slowly = c.cutter_class == CutterClass::kTap || c.cutter_class == CutterClass::kReamer ||
                      c.cutter_class == CutterClass::kBoringTool;
  const double ways = slowly ? 2.0 : 1.0;
  return ways * 60.0 * length / (scale * s.feed_mm_min);
}

}  // namespace

std::optional<double> life_left_min(const Cutter& c) {
  if (!(c.life_min > 0.0)) return std::nullopt;
  double left = std::max(0.0, c.life_min - c.life_used_min);
  for (const auto& s : c.sisters) left += std::max(0.0, s.life_left_min);
  return left;
}

Estimate estimate(const Cutter& c, const ToolRequirement& r, const StartValues& s, const WorkMaterial& w,
                  const Turning& t, const Preferences& p) {
  const Machine& m = t.machine;
  Estimate out;
  if (c.cutter_class == CutterClass::kTouchProbe || !(s.feed_mm_min > 0.0)) return out;
  const bool passes =
      p.passes_mm2 > 0.0 && p.ridges_mm > 0.0 && model::has(c.cutter_class, model::CutterTrait::kBall);
  out.cutting_s = passes ? passes_s(c, s, p)
                  : model::has(c.cutter_class, model::CutterTrait::kAlongAxis)
                      ? axial_s(c, r, s, w, t, p, out.limited_by)
                      : milling_s(c, r, s, w, t, p, out.limited_by);
  out.cutting_s *= std::max(1, p.places);
  const double minutes = out.cutting_s / 60.0 * std::max(1, p.batch);
  double whole = 0.0;  // of the batch
  if (c.price > 0.0 && c.life_min > 0.0) {
    // 60 per hour where the machine states no rate: default, unsourced.
    const double per_second = (m.cost_per_hour > 0.0 ? m.cost_per_hour : 60.0) / 3600.0;
    whole += minutes * c.price / c.life_min / per_second;
  }
  if (const auto left = life_left_min(c); left && minutes > *left) {
    // Time beyond the remaining life needs further edges, each loaded by hand.
    whole += std::ceil((minutes - *left) / c.life_min) * (m.tool_change_s + kLoadingS);
  }
  out.tool_s = whole / std::max(1, p.batch);
  return out;
}

}  // namespace capstan::tooling
