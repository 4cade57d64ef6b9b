#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

#include "planner/ground/base/stopping.h"
#include "planner/making/optimise/cut/law/law.h"
#include "planner/making/optimise/cut/limits.h"
#include "planner/physics/mechanics/bending/beam.h"
#include "planner/physics/mechanics/constants.h"
#include "planner/physics/mechanics/force/force_law.h"
#include "planner/physics/mechanics/loads/section.h"
#include "planner/physics/mechanics/loads/side_section.h"
#include "planner/physics/mechanics/surface.h"

namespace capstan::optimise {
namespace {

using std::numbers::pi;

/// Height Rz of the feed marks on the wall, and on the floor if there is a corner radius, mm; at the planned
/// feed.
double surface_rz(const CutQuestion& q, double fz_mm) {
  const double wall = mechanics::wall_rz_mm(fz_mm, q.cutter.cutting_diameter_mm);
  const double corner = q.cutter.corner_radius_mm;
  return corner > 0.0 ? std::max(wall, mechanics::floor_rz_mm(fz_mm, corner)) : wall;
}

}  // namespace

double force_height_mm(const model::Cutter& cutter) {
  return cutter.cutter_class == model::CutterClass::kTSlotMill ? 0.5 * cutter.maximum_depth_of_cut_mm : 0.0;
}

model::AxisForces axis_forces(const mechanics::ForceVector& f, double margin, const model::Cutter& cutter) {
  const double left = cutter.hand == model::Hand::kLeft ? -1.0 : 1.0;
  return {f.fx_n * margin, left * f.fy_n * margin, -f.fz_n * margin};
}

mechanics::ForceMargin margin_of(const CutQuestion& q) {
  return mechanics::force_margin(q.material, q.cutter.substrate, {feed_override(q), q.margin_deviations});
}

double power_by_card_w(const CutQuestion& q, double removal_mm3_min, double mean_chip_mm) {
  if (mechanics::measured_set(q.material, q.cutter.substrate) == nullptr || !(mean_chip_mm > 0.0)) return 0.0;
  mechanics::ForceMargin margin = drilling_margin_of(q);
  margin.spread = 1.0;
  const double h =
      std::clamp(mean_chip_mm, mechanics::kKienzleMinChipThicknessMm, mechanics::kKienzleMaxChipThicknessMm);
  const double kc = mechanics::specific_force_n_mm2(mechanics::milled_with(q.material, q.cutter), h);
  return kc * removal_mm3_min / 60000.0 * margin.factor();  // N mm/min = 1/60000 W
}

mechanics::ForceMargin drilling_margin_of(const CutQuestion& q) {
  return mechanics::kienzle_margin(q.material, {feed_override(q), q.margin_deviations});
}

double feed_override(const CutQuestion& q) {
  if (q.override_locked || feeds_by_pitch(q)) return 1.0;
  if (q.feed_mm_min && !q.feed_by_planning) return 1.0;
  return std::max(1.0, q.machine.abilities.feed_override_max);
}

MillingLoads::MillingLoads(const CutQuestion& q)
    : q_(q),
      tooth_(mechanics::tooth_of(q.cutter)),
      law_(mechanics::force_law(q.material, q.cutter)),
      margin_(margin_of(q).factor()) {
  auto beam = mechanics::beam_of(q.cutter);
  if (!beam) return;
  beam_ = *std::move(beam);
  compliance_mm_n_ = mechanics::bending_mm_n(*beam_, force_height_mm(q.cutter), 0.0);
}

std::optional<model::StepLoads> MillingLoads::at(double ap_mm, double ae_mm, double n_rpm, double fz_mm) {
  tick();
  const CutQuestion& q = q_;
  const mechanics::Tooth& tooth = tooth_;
  const mechanics::ForceLaw& law = law_;
  const double margin = margin_;
  if (!beam_ || !(ae_mm > 0.0) || !(ap_mm > 0.0)) return std::nullopt;
  if (ap_mm != ap_mm_ || ae_mm != ae_mm_) {
    ready_ = {};
    walls_ = {};
  }
  ap_mm_ = ap_mm;
  ae_mm_ = ae_mm;
  model::StepLoads out;
  for (const auto direction : {mechanics::CutDirection::kUp, mechanics::CutDirection::kDown}) {
    const bool is_up = direction == mechanics::CutDirection::kUp;
    const std::size_t way = is_up ? 0 : 1;
    auto& ready = ready_[way];
    if (!ready) {
      auto made =
          mechanics::SectionAtFeeds::of(mechanics::side_section(ap_mm, ae_mm, tooth, direction), tooth, law);
      if (!made) return std::nullopt;
      ready = *std::move(made);
    }
    const auto l = ready->at(fz_mm, n_rpm);
    if (!l) return std::nullopt;
    if (l->peak_force_n * margin > out.peak_force_n) {
      out.peak_force_n = l->peak_force_n * margin;
      out.mean_force = axis_forces(l->mean, margin, q.cutter);
      out.peak_force = axis_forces(l->peak, margin, q.cutter);
    }
    const double removal = ap_mm * ae_mm * fz_mm * tooth.teeth * n_rpm;
    const double power = std::max(l->power_w * margin, power_by_card_w(q, removal, l->h_mean_mm));
    out.torque_nm = std::max({out.torque_nm, l->torque_nm * margin, 30.0 * power / (pi * n_rpm)});
    out.power_w = std::max(out.power_w, power);
    out.chip_thickness_mm = std::max(out.chip_thickness_mm, l->h_max_mm);
    if (q.wall_error_limit_mm > 0.0) {
      auto& wall = walls_[way];
      if (!wall) {
        // The wall stands at the full radius, where the flank makes it.
        const mechanics::Section flank{
            .ap_mm = ap_mm, .arc = mechanics::immersion_arc(ae_mm, tooth.cutting_diameter_mm, direction)};
        auto made = mechanics::WallAtFeeds::of(
            flank, tooth, law, is_up ? mechanics::WallSide::kLeft : mechanics::WallSide::kRight, *beam_);
        if (!made) return std::nullopt;
        wall = *std::move(made);
      }
      const auto at_feed = wall->at(fz_mm);
      if (!at_feed) return std::nullopt;
      const double error_mm = at_feed->largest_mm() * margin;
      if (std::abs(error_mm) > std::abs(out.wall_error_mm)) out.wall_error_mm = error_mm;
    }
  }
  out.force_margin = margin;
  out.deflection_mm = out.peak_force_n * compliance_mm_n_;
  out.mrr_mm3_min = ap_mm * ae_mm * fz_mm * tooth.teeth * n_rpm;
  out.surface_rz_mm = surface_rz(q, fz_mm);
  return out;
}

std::optional<model::StepLoads> loads_of(const CutQuestion& q, double ap_mm, double ae_mm, double n_rpm,
                                         double feed_mm_min) {
  const double fz = feed_mm_min / (n_rpm * teeth_of(q));
  if (is_milling(q.kind))
    return MillingLoads(q).at(ap_mm, std::min(ae_mm, q.cutter.cutting_diameter_mm), n_rpm, fz);
  auto out = law_of(q).loads(q, n_rpm, feed_mm_min);
  if (!out) return std::nullopt;
  const double margin = drilling_margin_of(q).factor();
  out->force_margin = margin;
  out->peak_force_n *= margin;
  out->torque_nm *= margin;
  out->power_w *= margin;
  return out;
}

const AxialLaw& law_of(const CutQuestion& q) {
  static const std::vector<AxialLaw> kLaws = axial_laws();
  const auto it =
      std::find_if(kLaws.begin(), kLaws.end(), [&](const AxialLaw& l) { return l.name == q.law; });
  if (it == kLaws.end()) throw std::logic_error("no law of loads is called " + q.law);
  return *it;
}

bool feeds_by_pitch(const CutQuestion& q) { return q.kind == CutKind::kAxial && law_of(q).feed_is_pitch; }

}  // namespace capstan::optimise
