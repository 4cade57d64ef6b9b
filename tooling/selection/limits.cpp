#include "tooling/selection/limits.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "planner/ground/base/number.h"
#include "planner/ground/base/text.h"
#include "planner/model/features/fillet_slack.h"
#include "planner/model/plan/requirement.h"
#include "planner/model/plan/resources/changed_by_hand.h"
#include "planner/physics/mechanics/constants.h"
#include "planner/physics/mechanics/force/drilling.h"
#include "planner/physics/mechanics/force/immersion.h"
#include "planner/physics/mechanics/force/kienzle.h"
#include "planner/physics/mechanics/spindle.h"
#include "tooling/library/cutters/complete.h"
#include "tooling/library/cutters/edge_kind.h"
#include "tooling/library/nouns/tool_material.h"

namespace capstan::tooling {

using model::Cutter;
using model::CutterClass;
using model::kSizeSlackMm;
using model::lower_size;
using model::Machine;
using model::ToolRequirement;
using model::upper_size;
using model::WorkMaterial;

namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kAngleSlackRad = 0.5 * kPi / 180.0;
/// Drawings show the point of a twist drill, 118 degrees, as 120; the difference in the cone is 1.2 % of the
/// diameter. The next point of a catalogue, 130 degrees, is another. Default, unsourced.
constexpr double kPointSlackRad = 2.0 * kPi / 180.0;
/// The least point of a carbide drill that centres itself: makers grind 130 to 150 degrees, and such a drill
/// needs no spot (cutting-tool-supply.com, high performance drill point angles; ctemag.com, get it straight).
constexpr double kStartsAloneRad = 130.0 * kPi / 180.0;
/// The spindle's slowest turn may exceed the preset's cutting speed by this much and no more.
constexpr double kFastestOverPreset = 1.25;  // default, unsourced
/// The least cut that is worth a tool: a mill's depth and width, a drill's share of its start feed. Defaults,
/// unsourced; the optimiser may go as low, so that nothing is refused here that it could plan.
constexpr double kLeastDepthMm = 0.2;
constexpr double kLeastWidthRatio = 0.1;
constexpr double kLeastFeedRatio = 0.4;
/// Densities for the estimate of mass, kg/mm3: steel 7.85 and cemented carbide (6 % Co) 14.9 g/cm3
/// (handbook values).
constexpr double kSteelDensity = 7.85e-6, kCarbideDensity = 14.9e-6;

std::optional<std::string> wrong_thread(const Cutter& c, const ToolRequirement& r) {
  if (r.thread_pitch_mm > 0.0 && std::abs(c.thread_pitch_mm - r.thread_pitch_mm) > model::kPitchSlackMm)
    return "pitch " + mm_text(c.thread_pitch_mm) + " is not " + mm_text(r.thread_pitch_mm);
  if (!model::has(c.cutter_class, model::CutterTrait::kThreads)) return std::nullopt;
  if (!r.thread_form.empty() && !c.thread_form.empty() && r.thread_form != c.thread_form)
    return "thread form " + c.thread_form + " is not " + r.thread_form;
  if (r.lead_threads_max > 0.0 && c.lead_threads > r.lead_threads_max + model::kPitchSlackMm)
    return "its lead of " + trimmed(c.lead_threads, 1) + " threads is above " +
           trimmed(r.lead_threads_max, 1);
  if (r.thread_size_mm > 0.0 && c.thread_size_mm > 0.0) {
    if (c.cutter_class == CutterClass::kTap &&
        std::abs(c.thread_size_mm - r.thread_size_mm) > model::kPitchSlackMm)
      return "thread " + mm_text(c.thread_size_mm) + " is not " + mm_text(r.thread_size_mm);
    if (c.thread_size_mm > r.thread_size_mm + model::kPitchSlackMm)
      return "made for threads from " + mm_text(c.thread_size_mm) + ", above " + mm_text(r.thread_size_mm);
  }
  return std::nullopt;
}

std::optional<std::string> wrong_hand(const Cutter& c, const ToolRequirement& r) {
  // A single-profile thread mill cuts either hand: its path turns the other way.
  const bool tap = c.cutter_class == CutterClass::kTap;
  const bool left = c.hand == model::Hand::kLeft;
  if (tap && r.left_hand && !left) return std::string("it cuts right-hand threads");
  if (left && !(tap && r.left_hand))
    return tap ? std::string("it cuts left-hand threads") : std::string("it is a left-hand cutter");
  return std::nullopt;
}

std::optional<std::string> wrong_point(const Cutter& c, const ToolRequirement& r) {
  const bool drill = c.cutter_class == CutterClass::kTwistDrill;
  const double slack = drill ? kPointSlackRad : kAngleSlackRad;
  const double point = c.point_angle_rad, least = r.point_angle_rad;
  const double most = drill ? std::max(least, r.point_angle_most_rad) : least;
  if (least > 0.0 && point < least - slack - 1e-9)
    return "point angle " + deg_text(point) + (most > least ? " is below " : " is not ") + deg_text(least);
  if (least > 0.0 && point > most + slack + 1e-9)
    return "point angle " + deg_text(point) + (most > least ? " is above " : " is not ") + deg_text(most);
  if (model::has(c.cutter_class, model::CutterTrait::kMarks) && r.point_angle_most_rad > 0.0 &&
      point > r.point_angle_most_rad + kAngleSlackRad)
    return "point angle " + deg_text(point) + " marks wider than the hole; at most " +
           deg_text(r.point_angle_most_rad);
  if (!drill) return std::nullopt;
  if (drills_with_inserts(c) && r.point_angle_most_rad < point)
    return "its inserts make a hole from the solid, of IT13 and coarser, without a spot and at one go";
  const bool carbide = c.substrate == model::Substrate::kCarbide;
  if (r.solid_carbide && !(carbide && point >= kStartsAloneRad - slack))
    return carbide ? "its point of " + deg_text(point) + " does not centre it"
                   : std::string(model::to_text(c.substrate)) + " is not the carbide that is wanted";
  // Its corners would meet the spot's cone first, at the whole feed.
  if (carbide && r.spot_angle_rad > 0.0 && point > r.spot_angle_rad + kAngleSlackRad)
    return "a spot of " + deg_text(r.spot_angle_rad) + " is steeper than its carbide point of " +
           deg_text(point) + ", whose corners would meet it first";
  return std::nullopt;
}

std::optional<std::string> wrong_neck(const Cutter& c, const ToolRequirement& r) {
  double most = r.neck_diameter_max_mm;
  if (r.neck_step_min_mm > 0.0) {
    const double by_step = c.cutting_diameter_mm - r.neck_step_min_mm;
    if (by_step <= 0.0) return "diameter " + mm_text(c.cutting_diameter_mm) + " leaves no neck";
    most = most > 0.0 ? std::min(most, by_step) : by_step;
  }
  if (most <= 0.0) return std::nullopt;
  const bool necked = c.neck_diameter_mm > 0.0;
  const double thick = necked ? c.neck_diameter_mm : c.shank_diameter_mm;
  if (thick > most + kSizeSlackMm)
    return std::string(necked ? "neck " : "shank ") + mm_text(thick) + " is above " + mm_text(most);
  if (necked && c.neck_length_mm + kSizeSlackMm < r.reach_mm && c.shank_diameter_mm > most + kSizeSlackMm)
    return "neck of " + mm_text(c.neck_length_mm) + " is shorter than " + mm_text(r.reach_mm);
  return std::nullopt;
}

double efficiency(const Machine& m) { return mechanics::spindle_efficiency(m.spindle.efficiency); }

/// The largest torque at or below a speed; nothing where the machine states no curve.
std::optional<double> largest_torque_nm(const Turning& t, double rpm) {
  const auto& curve = t.curve;
  if (!curve) return std::nullopt;
  const Machine& m = t.machine;
  double out = 0.0;
  const auto look = [&](double n) {
    const auto at = curve->at(std::clamp(n, curve->min_rpm(), curve->max_rpm()));
    if (at) out = std::max(out, at->torque_nm);
  };
  look(rpm);
  look(m.spindle.rpm_min);
  for (const auto& p : m.spindle.curve) {
    if (p.rpm <= rpm && p.rpm >= m.spindle.rpm_min) look(p.rpm);
  }
  return out;
}

/// The least feed per tooth that planning may choose: the cutter's own where it is known.
double least_fz_mm(const Cutter& c, const StartValues& s) {
  const double share = kLeastFeedRatio * s.fz_mm;
  return c.fz_min_mm > 0.0 ? std::min(c.fz_min_mm, share) : share;
}

/// Torque of the least cut that is worth it, Nm; nothing where no formula covers the class.
std::optional<double> least_torque_nm(const Cutter& c, const StartValues& s, const WorkMaterial& w,
                                      const Preferences& p) {
  const mechanics::WorkMaterial work{w.kc11_n_mm2, w.mc};
  // Average values: margins for spread and wear are the optimiser's, which may feed slower for them.
  const double n = std::max(1.0, s.spindle_rpm);
  if (model::has(c.cutter_class, model::CutterTrait::kDrills)) {
    const double hole = p.pre_hole_mm < c.cutting_diameter_mm ? p.pre_hole_mm : 0.0;
    const auto l = mechanics::drilling_loads({c.cutting_diameter_mm, least_fz_mm(c, s) * c.teeth, n, c.teeth,
                                              c.point_angle_rad > 0.0 ? c.point_angle_rad : kPi, hole},
                                             work);
    if (!l) return std::nullopt;
    return l->torque_nm;
  }
  if (c.cutter_class == CutterClass::kTap) {
    const auto l = mechanics::tapping_loads(mechanics::tapping_cut_of(c, p.pre_hole_mm, n), work);
    if (!l) return std::nullopt;
    return l->torque_nm;
  }
  if (model::has(c.cutter_class, model::CutterTrait::kLayers)) {
    const double d = c.cutting_diameter_mm, ae = kLeastWidthRatio * d;
    const double fz = least_fz_mm(c, s);
    const double h = mechanics::mean_chip_thickness_mm(fz, ae, d);
    if (!(h > 0.0)) return std::nullopt;
    const double ft = mechanics::mean_tangential_force_n(mechanics::specific_force_n_mm2(work, h),
                                                         kLeastDepthMm, ae, fz, c.teeth, d);
    return ft * 0.5 * d / 1000.0;
  }
  return std::nullopt;
}

double frustum_mm3(const model::HolderSegment& s) {
  const double a = 0.5 * s.lower_diameter_mm, b = 0.5 * s.upper_diameter_mm;
  return kPi / 3.0 * s.height_mm * (a * a + a * b + b * b);
}

/// Least mass of a cutter, kg: without the taper in the spindle and a holder that is not described.
double least_mass_kg(const Cutter& c) {
  const double density = c.substrate == model::Substrate::kCarbide && c.cutting_diameter_mm <= 25.0 &&
                                 c.cutter_class != CutterClass::kFacemill
                             ? kCarbideDensity
                             : kSteelDensity;
  const double d = std::min(c.cutting_diameter_mm,
                            c.shank_diameter_mm > 0.0 ? c.shank_diameter_mm : c.cutting_diameter_mm);
  double mass = density * 0.25 * kPi * d * d * c.stick_out_mm;
  for (const auto& s : c.holder) mass += kSteelDensity * frustum_mm3(s);
  return mass;
}

std::optional<std::string> not_in_magazine(const Cutter& c, const Machine& m, const Preferences& p) {
  if (m.tool_diameter_max_mm > 0.0 && c.cutting_diameter_mm > m.tool_diameter_max_mm + kSizeSlackMm)
    return "diameter " + mm_text(c.cutting_diameter_mm) + " is above the magazine's " +
           mm_text(m.tool_diameter_max_mm);
  if (m.tool_length_max_mm > 0.0 && c.functional_length_mm > m.tool_length_max_mm + kSizeSlackMm)
    return "length " + mm_text(c.functional_length_mm) + " is above the magazine's " +
           mm_text(m.tool_length_max_mm);
  if (const double most = m.abilities.magazine_mass_max_kg; most > 0.0 && least_mass_kg(c) > most)
    return "its mass is at least " + trimmed(least_mass_kg(c), 2) + " kg, above the magazine's " +
           trimmed(most, 2) + " kg";
  const auto pockets = static_cast<std::size_t>(std::max(0, m.magazine_pockets));
  const auto used = [&](const std::string& id) {
    return std::find(p.used.begin(), p.used.end(), id) != p.used.end();
  };
  if (!model::changed_by_hand(m) && p.used.size() >= pockets && !used(c.id)) {
    return "the plan uses " + std::to_string(p.used.size()) + " tools, and the magazine has " +
           std::to_string(pockets) + " pockets";
  }
  return std::nullopt;
}

/// Which gear that is not in use would turn as slowly as wanted.
std::string slower_gear(const Machine& m, double rpm) {
  for (const auto& g : m.spindle.gears) {
    if (g.rpm_min <= rpm && rpm <= g.rpm_max && g.rpm_min < m.spindle.rpm_min)
      return "; its gear '" + g.id + "' turns " + trimmed(g.rpm_min, 0) + " to " + trimmed(g.rpm_max, 0) +
             " 1/min";
  }
  return {};
}

}  // namespace

std::optional<std::string> not_cut_with(const Cutter& c, const StartValues& start,
                                        const WorkMaterial& material) {
  if (c.cutter_class == CutterClass::kTouchProbe || start.wanted_vc_m_min > 0.0) return std::nullopt;
  return material.id + " is not cut with " + std::string(model::to_text(c.substrate)) +
         ": its card has no speed for it, and the tool states none" +
         (material_is_open(c)
              ? std::string("; that the tool is ") + std::string(model::to_text(c.substrate)) +
                    " is only assumed: state it, or settle it with --assume tool-material=..."
              : std::string());
}

bool is_other_size(const Cutter& c, const ToolRequirement& r) {
  const double low = lower_size(r), high = upper_size(r), d = c.cutting_diameter_mm;
  return (low > 0.0 && d < low - kSizeSlackMm) || (high > 0.0 && d > high + kSizeSlackMm);
}

namespace {

/// How far a corner's radius may be off the one that is asked: that of an edge's round is all that makes it.
double corner_slack(const Cutter& c) {
  return c.cutter_class == CutterClass::kCornerRoundingMill ? model::kPitchSlackMm : model::kFilletSlackMm;
}

}  // namespace

std::optional<std::string> wrong_shape(const Cutter& c, const ToolRequirement& r) {
  const bool exact = r.corner_radius_exact_mm >= 0.0;
  if (exact && std::abs(c.corner_radius_mm - r.corner_radius_exact_mm) > corner_slack(c) + kSizeSlackMm)
    return "corner radius " + mm_text(c.corner_radius_mm) + " is not " + mm_text(r.corner_radius_exact_mm);
  if (!exact && r.corner_radius_limited && c.corner_radius_mm > r.corner_radius_max_mm + kSizeSlackMm)
    return "corner radius " + mm_text(c.corner_radius_mm) + " is above " + mm_text(r.corner_radius_max_mm);
  if (auto why = wrong_point(c, r)) return why;
  // A dovetail's flanks lean inwards by its lead angle.
  const double taper = c.cutter_class == CutterClass::kDovetailMill ? c.lead_angle_rad : c.taper_angle_rad;
  if (r.taper_angle_rad > 0.0 && std::abs(taper - r.taper_angle_rad) > kAngleSlackRad)
    return "taper " + deg_text(taper) + " is not " + deg_text(r.taper_angle_rad);
  // T-slot cutters of older libraries state their head as the length of flutes.
  const double width = c.cutting_width_mm > 0.0 ? c.cutting_width_mm : c.maximum_depth_of_cut_mm;
  if (r.cutting_width_max_mm > 0.0 && width > r.cutting_width_max_mm + kSizeSlackMm)
    return "cutting width " + mm_text(width) + " is above " + mm_text(r.cutting_width_max_mm);
  if (auto why = wrong_thread(c, r)) return why;
  if (auto why = wrong_hand(c, r)) return why;
  if (auto why = wrong_neck(c, r)) return why;
  if (r.tip_diameter_max_mm > 0.0 && c.tip_diameter_mm > r.tip_diameter_max_mm + kSizeSlackMm)
    return "tip of " + mm_text(c.tip_diameter_mm) + " is above " + mm_text(r.tip_diameter_max_mm);
  if (r.centre_cutting && !c.centre_cutting && c.maximum_ramp_angle_rad <= 0.0)
    return std::string("it neither cuts to centre nor ramps");
  if (r.coolant_through && !c.coolant_through) return std::string("no coolant comes through it");
  return std::nullopt;
}

double flutes_needed(const Cutter& c, const ToolRequirement& r) {
  constexpr double kThinnerMm = 0.1;  // on the diameter; default, unsourced
  // Below a through hole: past_mm of the action "ream", for the lead, and the 1 mm that paths go below what
  // is through; blind ones get it as room for chips.
  constexpr double kBelowMm = 3.0;
  const bool thinner = c.shank_diameter_mm > 0.0 && c.shank_diameter_mm + kThinnerMm <= c.cutting_diameter_mm;
  if (c.cutter_class != CutterClass::kReamer || thinner || !(r.depth_of_cut_mm > 0.0))
    return r.depth_of_cut_mm;
  return r.depth_of_cut_mm + kBelowMm;
}

std::optional<std::string> too_short(const Cutter& c, const ToolRequirement& r) {
  if (r.reach_mm > reach_of(c) + kSizeSlackMm) {
    std::string why = "reach " + mm_text(reach_of(c)) + " is below " + mm_text(r.reach_mm);
    const std::string* out = source_of(c, "stick_out_mm");
    if (c.table_line && out != nullptr && !out->starts_with("stated"))
      why += " (its stick-out of " + mm_text(c.stick_out_mm) + " is not stated, but " + *out + ")";
    const bool thin_enough = c.shank_diameter_mm > 0.0 && c.shank_diameter_mm <= c.cutting_diameter_mm;
    if (thin_enough && !c.holder.empty() && !model::has(c.cutter_class, model::CutterTrait::kAlongAxis))
      why += ", and its holder (" +
             mm_text(std::max(c.holder.front().lower_diameter_mm, c.holder.front().upper_diameter_mm)) +
             ") would meet the walls";
    return why;
  }
  const double flutes = flutes_needed(c, r);
  if (flutes > c.maximum_depth_of_cut_mm + kSizeSlackMm)
    return "flutes " + mm_text(c.maximum_depth_of_cut_mm) + " are shorter than " + mm_text(flutes) +
           (flutes > r.depth_of_cut_mm ? ", and its shank is as wide as the hole" : "");
  return std::nullopt;
}

std::optional<std::string> not_for_machine(const Cutter& c, const StartValues& start, const WorkMaterial& w,
                                           const Turning& t, const Preferences& p) {
  const Machine& m = t.machine;
  if (auto why = not_in_magazine(c, m, p)) return why;
  if (c.cutter_class == CutterClass::kTouchProbe) return std::nullopt;
  if (auto why = not_cut_with(c, start, w)) return why;
  if (!p.roughs && feeds_high(c))
    return "edges that lean by " + deg_text(c.lead_angle_rad) + " rough, and leave ridges";
  if (c.maximum_speed_rpm > 0.0 && c.maximum_speed_rpm < m.spindle.rpm_min)
    return "its largest speed " + trimmed(c.maximum_speed_rpm, 0) + " 1/min is below the spindle's least " +
           trimmed(m.spindle.rpm_min, 0);
  const double wanted = start.wanted_vc_m_min;
  if (start.vc_m_min > kFastestOverPreset * wanted)
    return "the spindle's least speed " + trimmed(m.spindle.rpm_min, 0) + " 1/min gives " +
           trimmed(start.vc_m_min, 1) + " m/min, " + w.id + " allows " + trimmed(wanted, 1) +
           slower_gear(m, 1000.0 * wanted / (kPi * c.cutting_diameter_mm));
  const auto needed = least_torque_nm(c, start, w, p);
  const auto most = largest_torque_nm(t, start.spindle_rpm);
  if (needed && most && *needed > *most * efficiency(m))
    return "its least useful cut takes " + trimmed(*needed, 2) + " Nm, the spindle gives " +
           trimmed(*most * efficiency(m), 2) + " at or below " + trimmed(start.spindle_rpm, 0) + " 1/min";
  return std::nullopt;
}

}  // namespace capstan::tooling
