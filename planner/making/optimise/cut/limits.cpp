#include "planner/making/optimise/cut/limits.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "planner/making/optimise/cut/law/law.h"
#include "planner/model/plan/cutter/ramp.h"
#include "planner/model/plan/preset_feeds.h"
#include "planner/physics/mechanics/bending/beam.h"
#include "planner/physics/mechanics/constants.h"
#include "planner/physics/mechanics/life/arc_speed.h"
#include "planner/physics/mechanics/stability.h"
#include "planner/physics/mechanics/surface.h"

namespace capstan::optimise {

using model::Limit;

namespace {

double efficiency(const CutQuestion& q) {
  return mechanics::spindle_efficiency(q.machine.spindle.efficiency);
}

/// Largest feed of the axes, mm/min: the smaller of X and Y in milling, else Z. An axis that states none is
/// unlimited.
double axis_feed(const CutQuestion& q) {
  const auto& a = q.machine.axes;
  if (!is_milling(q.kind)) return a[2].feed_max_mm_min;
  return std::min(a[0].feed_max_mm_min, a[1].feed_max_mm_min);
}

/// Share of the force of a true-running cutter that one with the usual runout may have at the start feed. The
/// tooth with the largest runout takes a chip that is thicker by kColletRunoutMm sin(pi / z) (as in
/// mechanics/loads/section.h), and its force grows by Kienzle's law. That is one more factor of the margin,
/// which knows nothing of the others: their logarithms add as squares. Thin cutters, whose feeds are of the
/// runout's size, lose a fifth by it, others a few per cent. 1 where a runout is stated: the forces have it.
double true_running_share(const CutQuestion& q) {
  const double fz = largest_fz(q);
  if (q.cutter.runout_mm > 0.0 || !(fz > 0.0)) return 1.0;
  const double more = mechanics::kColletRunoutMm * std::sin(std::numbers::pi / std::max(2, teeth_of(q)));
  const double grown = (1.0 - q.material.mc) * std::log1p(more / fz);
  const mechanics::ForceMargin margin = margin_of(q);
  const double others = std::log(margin.factor());
  return std::exp(others - std::hypot(others, margin.deviations * grown));
}

/// The smaller of the stated limit and the bend that the tool's own material endures, mm. The body of a face
/// mill is no bar.
double deflection_limit(const CutQuestion& q) {
  const double asked =
      q.deflection_limit_mm > 0.0 ? q.deflection_limit_mm : std::numeric_limits<double>::infinity();
  if (!is_milling(q.kind) || q.cutter.cutter_class == model::CutterClass::kFacemill) return asked;
  const auto bears = mechanics::enduring_bend_mm(q.cutter, force_height_mm(q.cutter));
  return bears ? std::min(asked, true_running_share(q) * *bears) : asked;
}

}  // namespace

Range speeds(const CutQuestion& q) {
  Range r{std::max(1.0, q.machine.spindle.rpm_min), q.machine.spindle.rpm_max};
  if (q.cutter.maximum_speed_rpm > 0.0) r.hi = std::min(r.hi, q.cutter.maximum_speed_rpm);
  return r;
}

std::optional<mechanics::SpindleCurve> curve_of(const CutQuestion& q) {
  auto curve = mechanics::curve_of(q.machine.spindle);
  if (!curve) return std::nullopt;
  return *std::move(curve);
}

double largest_fz(const CutQuestion& q) {
  double fz = q.fz_start_mm;
  // The start value is what is planned for; the cutter's largest must hold with the override, too.
  if (const double most = model::largest_tooth_feed_mm(q.cutter, q.material); most > 0.0)
    fz = std::min(fz, most / feed_override(q));
  return fz;
}

double least_chip_mm(const CutQuestion& q) {
  const bool hss = q.cutter.substrate == model::Substrate::kHss;
  const double least = mechanics::least_chip_mm(q.cutter.cutting_diameter_mm, hss, q.material.iso_group);
  const double held = model::held_to_cut_mm(q.cutter, q.material);
  return held > 0.0 ? std::min(least, held) : least;
}

double thinnest_chip_mm(const CutQuestion& q) {
  // A given feed is its maker's word.
  const bool given = q.feed_mm_min.has_value() || q.fz_mm.has_value();
  return given ? 0.0 : least_chip_mm(q);
}

double least_fz(const CutQuestion& q) {
  if (feeds_by_pitch(q) || !(q.cutter.fz_min_mm > 0.0)) return 0.0;
  return q.cutter.fz_min_mm;
}

bool least_fz_stated(const CutQuestion& q) {
  const auto& s = q.cutter.sources;
  const auto it = std::find_if(s.begin(), s.end(), [](const auto& p) { return p.first == "fz_min_mm"; });
  return it == s.end() || it->second.starts_with("stated");
}

bool short_of_torque(const CutQuestion& q, double n_rpm) {
  constexpr double kNearlyAll = 0.98;
  const auto curve = curve_of(q);
  if (!curve) return false;
  double most = 0.0;
  for (const auto& p : curve->points()) {
    if (const auto c = curve->at(p.rpm)) most = std::max(most, c->power_w);
  }
  const auto c = curve->at(std::clamp(n_rpm, curve->min_rpm(), curve->max_rpm()));
  // Beyond the speed of most power the power falls again, and it is power that is short.
  if (!c || c->power_w >= kNearlyAll * most) return false;
  return std::any_of(curve->points().begin(), curve->points().end(), [&](const auto& p) {
    const auto at = curve->at(p.rpm);
    return at && p.rpm > n_rpm && at->power_w > c->power_w;
  });
}

double ease_of(const CutQuestion& q, std::string_view limit) {
  return q.eased.name == limit ? q.eased.factor : 1.0;
}

double speed_by_arc(const CutQuestion& q, double ae) {
  if (!q.constant_engagement) return 1.0;
  return mechanics::speed_by_arc(ae, q.cutter.cutting_diameter_mm, q.cutter.substrate, q.material.iso_group);
}

namespace {

/// How much deeper than a slot a cut of this width is stable: fewer teeth are in it at a time, and the
/// limiting depth is inverse to their average number. Where fewer than two are, the lobes' own margin counts.
/// Source  Tlusty's limit with the average number of teeth in the cut, b = -1 / (2 Ks Re[G] N*) (Schmitz &
///         Smith, Machining Dynamics, chapter on milling); kSingleToothMargin: mechanics/stability.h.
double deeper_by_arc(double ae_mm, double diameter_mm) {
  if (!(ae_mm > 0.0) || !(diameter_mm > 0.0)) return 1.0;
  const double arc = std::acos(std::clamp(1.0 - 2.0 * ae_mm / diameter_mm, -1.0, 1.0));
  return std::max(1.0, mechanics::kSingleToothMargin * std::numbers::pi / arc);
}

}  // namespace

double slender_depth(const CutQuestion& q) {
  const model::Cutter& c = q.cutter;
  const bool speaks = q.kind == CutKind::kRough && !q.ap_mm && c.stick_out_mm > 0.0 &&
                      mechanics::modes_for(q.machine, c.id).empty();
  const double depth = speaks ? mechanics::slender_depth_mm(c.cutting_diameter_mm, c.stick_out_mm) : 0.0;
  const double arc = q.constant_engagement && q.ae_mm ? deeper_by_arc(*q.ae_mm, c.cutting_diameter_mm) : 1.0;
  return depth > 0.0 ? arc * depth : std::numeric_limits<double>::infinity();
}

double deepest_level(const CutQuestion& q) {
  const double d = q.cutter.cutting_diameter_mm;
  double most = q.cutter.maximum_depth_of_cut_mm > 0.0
                    ? q.cutter.maximum_depth_of_cut_mm * ease_of(q, "cutting_length")
                    : d;
  double level = most;
  if (q.kind == CutKind::kRough && !q.constant_engagement)
    level = std::min({level, model::kDeepestSlotRatio * d, model::hard_level_mm(q.cutter, q.material)});
  if (q.constant_engagement && model::cuts_hard_steel(q.cutter, q.material))
    level = std::min(level, model::kHardCut.narrow_depth * d);
  if (q.ap_most_mm > 0.0) level = std::min(level, q.ap_most_mm);
  level = std::min(level * ease_of(q, "level_depth"), slender_depth(q) * ease_of(q, "stable_depth"));
  return std::min(most, level);
}

double deep_slot_share(double ap, double d) {
  if (!(ap > 0.0) || !(d > 0.0)) return 1.0;
  const double deep = (ap / d - kFullFeedSlotRatio) / (model::kDeepestSlotRatio - kFullFeedSlotRatio);
  return 1.0 - (1.0 - kDeepestSlotShare) * std::clamp(deep, 0.0, 1.0);
}

FixedLimits fixed_limits(const CutQuestion& q) {
  FixedLimits out{.curve = curve_of(q),
                  .rpm = speeds(q),
                  .efficiency = efficiency(q),
                  .largest_fz_mm = largest_fz(q),
                  .thinnest_chip_mm = thinnest_chip_mm(q),
                  .deflection_mm = deflection_limit(q),
                  .axis_feed_mm_min = axis_feed(q),
                  .slender_depth_mm = slender_depth(q)};
  for (const model::LimitRow& r : model::kLimitRows)
    out.ease.at(model::index_of(r.value)) = ease_of(q, r.name);
  return out;
}

Measures measures(const CutQuestion& q, const model::StepLoads& l, double ap, double n, double feed) {
  return measures(q, fixed_limits(q), l, ap, n, feed);
}

Measures measures(const CutQuestion& q, const FixedLimits& fixed, const model::StepLoads& l, double ap,
                  double n, double feed) {
  const bool mills = is_milling(q.kind);
  const Range& rpm = fixed.rpm;
  const auto ease = [&](Limit limit) { return fixed.ease.at(model::index_of(limit)); };
  Measures m;
  if (const auto& curve = fixed.curve) {
    if (const auto c = curve->at(std::clamp(n, curve->min_rpm(), curve->max_rpm()))) {
      m[Limit::kSpindlePower] = {l.power_w, c->power_w * fixed.efficiency};
      m[Limit::kSpindleTorque] = {l.torque_nm, c->torque_nm * fixed.efficiency};
    }
  }
  if (mills) {
    m[Limit::kToolDeflection] = {l.deflection_mm, fixed.deflection_mm};
    // A catalogue's feed is along the feed: with a lead angle its chip is thinner from the start.
    const double slot =
        q.kind == CutKind::kRough && q.slot ? deep_slot_share(ap, q.cutter.cutting_diameter_mm) : 1.0;
    if (fixed.largest_fz_mm > 0.0)
      m[Limit::kChipThickness] = {l.chip_thickness_mm,
                                  slot * fixed.largest_fz_mm * std::cos(q.cutter.lead_angle_rad)};
    if (q.wall_error_limit_mm > 0.0)
      m[Limit::kWallError] = {std::abs(l.wall_error_mm), q.wall_error_limit_mm};
    if (q.surface_ra_um > 0.0)
      m[Limit::kSurfaceRoughness] = {
          1000.0 * kRoughnessOverGeometry * mechanics::kArcRaOverRz * l.surface_rz_mm, q.surface_ra_um};
  }
  if (q.peak_force_limit_n > 0.0) m[Limit::kPeakForce] = {l.peak_force_n, q.peak_force_limit_n};
  if (mills && fixed.thinnest_chip_mm > 0.0)
    m[Limit::kChipThicknessLeast] = {fixed.thinnest_chip_mm, l.chip_thickness_mm};
  m[Limit::kSpindleSpeedLeast] = {rpm.lo, n};
  if (rpm.hi > 0.0) m[Limit::kSpindleSpeedMost] = {n, rpm.hi};
  if (fixed.axis_feed_mm_min > 0.0) m[Limit::kAxisFeed] = {feed, fixed.axis_feed_mm_min};
  if (mills && q.cutter.maximum_depth_of_cut_mm > 0.0)
    m[Limit::kCuttingLength] = {ap, q.cutter.maximum_depth_of_cut_mm};
  if (mills && q.ap_most_mm > 0.0) m[Limit::kLevelDepth] = {ap, q.ap_most_mm};
  m[Limit::kStableDepth] = {ap, fixed.slender_depth_mm};
  for (const model::LimitRow& r : model::kLimitRows) m[r.value].limit *= ease(r.value);
  // More power is more torque at the same speed, and the other way round.
  m[Limit::kSpindlePower].limit *= ease(Limit::kSpindleTorque);
  m[Limit::kSpindleTorque].limit *= ease(Limit::kSpindlePower);
  return m;
}

WorstLoad worst_load(const CutQuestion& q, const model::StepLoads& loads, double n_rpm) {
  const Measures m = measures(q, loads, 0.0, n_rpm, 0.0);
  WorstLoad worst;
  for (const model::LimitRow& r : model::kLimitRows) {
    if (!r.of_loads) continue;
    const double excess = m[r.value].excess();
    if (std::isnan(excess)) return {std::numeric_limits<double>::infinity(), "load", 0.0, 0.0, ""};
    if (excess > worst.excess)
      worst = {excess, std::string(r.name), m[r.value].value, m[r.value].limit, std::string(r.unit)};
  }
  return worst;
}

double worst_excess(const CutQuestion& q, const model::StepLoads& loads, double n_rpm) {
  return worst_load(q, loads, n_rpm).excess;
}

}  // namespace capstan::optimise
