#include "planner/making/optimise/feeds/cut_loads.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "planner/ground/base/stopping.h"
#include "planner/making/optimise/cut/limits.h"
#include "planner/physics/mechanics/constants.h"
#include "planner/physics/mechanics/force/drilling.h"
#include "planner/physics/mechanics/force/force_law.h"
#include "planner/physics/mechanics/surface.h"

namespace capstan::optimise::feed {
namespace {

using std::numbers::pi;

constexpr double kNoLimit = std::numeric_limits<double>::infinity();  // of what nobody states
/// Width of an arc across the feed.
double width_of(double entry, double exit, double diameter) {
  return 0.5 * diameter * (std::cos(entry) - std::cos(exit));
}

/// An arc of this width within a measured one, at the side where the measured one ends in the wall.
Cut trimmed_arc(double ap, double width, const CutSample& s, double diameter) {
  const double w = std::clamp(width, 0.0, diameter);
  const double phi = std::acos(std::clamp(1.0 - 2.0 * w / diameter, -1.0, 1.0));
  const bool up = s.entry_rad < pi - s.exit_rad - 1e-9;
  return up ? Cut{.ap_mm = ap, .exit_rad = phi} : Cut{.ap_mm = ap, .entry_rad = pi - phi, .exit_rad = pi};
}

/// Of the thickest chip that a measured arc can have.
double front_of(const CutSample& s) {
  const double entry = std::clamp(s.entry_rad, 0.0, pi);
  const double exit = std::clamp(s.exit_rad, 0.0, pi);
  if (!(exit > entry)) return 0.0;
  if (entry <= 0.5 * pi && exit >= 0.5 * pi) return 1.0;
  return std::max(std::sin(entry), std::sin(exit));
}

/// The rectangle of a depth and a width at the section's place. It keeps the measured arc if that is about as
/// wide; else it takes an arc of that width. The area that the arc lacks is removed by the edge's higher
/// speed.
Cut rectangle(double ap, double ae, const CutSample& s, double diameter) {
  const double entry = std::clamp(s.entry_rad, 0.0, pi);
  const double exit = std::clamp(s.exit_rad, entry, pi);
  const double measured = width_of(entry, exit, diameter);
  // Inside of a corner the edge removes more than the arc's width; much more is an arc not measured.
  constexpr double kTooWide = 0.98;
  constexpr double kTooNarrow = 1.4;
  Cut c = measured > 0.0 && ae >= kTooWide * measured && ae <= kTooNarrow * measured
              ? Cut{.ap_mm = ap, .entry_rad = entry, .exit_rad = exit}
              : trimmed_arc(ap, ae, s, diameter);
  const double width = width_of(c.entry_rad, c.exit_rad, diameter);
  if (width > 0.0) c.gain = std::max(1.0, ae / width);
  // Inside of a corner the edge's way is longer: that is in the gain.
  c.front_sin = front_of(s);
  return c;
}

}  // namespace

Cuts cuts_of(const CutSample& sample, const CutQuestion& question) {
  Cuts out;
  const model::Cutter& cutter = question.cutter;
  CutSample s = sample;
  const double diameter = cutter.cutting_diameter_mm;
  if (s.end_mm2 > 0.0 && s.end_slope > 0.0 && s.ae_mm > 0.0) {
    const double slot = s.end_mm2 * std::pow(std::min(s.end_slope, 1.0), -question.material.mc);
    s.csa_mm2 += slot - s.end_mm2;
    s.ap_mm += slot / s.ae_mm;
  }
  const double ap = s.ap_mm;
  const double ae = s.ae_mm;
  if (!(ap > 0.0) || !(ae > 0.0) || !(diameter > 0.0) || !std::isfinite(ap * ae)) return out;
  // Sections are measured for a clockwise tooth; one that turns the other way meets the right side first.
  if (cutter.hand == model::Hand::kLeft) {
    s.entry_rad = pi - sample.exit_rad;
    s.exit_rad = pi - sample.entry_rad;
  }
  const double corner = mechanics::tooth_of(cutter).corner_radius_mm;
  if (corner > 0.0) {
    const double entry = std::clamp(s.entry_rad, 0.0, pi);
    const double exit = std::clamp(s.exit_rad, 0.0, pi);
    const double area = s.csa_mm2 > 0.0 ? s.csa_mm2 : ap * ae;
    // Above the tip the edge is steeper, so its chip is thicker.
    const double up = std::min(std::max(ap, s.top_mm), corner);
    const double kappa_sin = std::sqrt(up * (2.0 * corner - up)) / corner;
    // Without a measured arc, make one from the width.
    Cut c = exit > entry ? Cut{.ap_mm = ap, .entry_rad = entry, .exit_rad = exit}
                         : trimmed_arc(ap, ae, s, diameter);
    c.csa_mm2 = area;
    c.front_sin = front_of(s) * kappa_sin;
    if (s.chip_over_feed > 0.0) {
      c.front_sin = s.chip_over_feed;
      c.chip_measured = true;
    }
    const double strip = width_of(c.entry_rad, c.exit_rad, diameter);
    if (area >= kWholeSection * ap * strip) {
      out.cut[out.n++] = c;
      return out;
    }
    // As deep, a band along the edge; as wide, a layer.
    Cut layer = c;
    layer.ap_mm = area / strip;
    c.band_mm = area / ap;
    out.cut[out.n++] = c;
    out.cut[out.n++] = layer;
    return out;
  }
  if (s.csa_mm2 > 0.0 && s.csa_mm2 < kWholeSection * ap * ae) {
    out.cut[out.n++] = rectangle(ap, s.csa_mm2 / ap, s, diameter);
    out.cut[out.n++] = rectangle(s.csa_mm2 / ae, ae, s, diameter);
    return out;
  }
  out.cut[out.n++] = rectangle(ap, std::max(ae, s.csa_mm2 / ap), s, diameter);
  return out;
}

double ratio(const Column& load, const Column& limit) {
  double worst = 0.0;
  for (std::size_t i = 0; i < kLimits; ++i) worst = std::max(worst, load[i] / limit[i]);
  return worst;
}

bool stated(double limit) { return limit < kNoLimit; }

CutLoads::CutLoads(const CutQuestion& question, double feed_mm_min, double n_rpm)
    : q_(question),
      n_(std::abs(n_rpm)),
      tooth_(mechanics::tooth_of(question.cutter)),
      law_(mechanics::force_law(question.material, question.cutter)) {
  margin_ = margin_of(q_).factor();
  if (auto beam = mechanics::beam_of(q_.cutter)) {
    compliance_ = mechanics::bending_mm_n(*beam, force_height_mm(q_.cutter), 0.0);
    if (q_.wall_error_limit_mm > 0.0) beam_ = *std::move(beam);
  }
  // Limits are those of `cut`.
  const Measures m = measures(q_, {}, 0.0, n_, 0.0);
  for (const Limit l : model::kSectionLimits) limits_.of(l) = std::min(m[l].limit, kNoLimit);
  const double chip = limits_.of(Limit::kChipThickness);
  const double nominal = feed_mm_min;
  // A finishing move may exceed the planned feed only if a required Ra limits it, or if the step was planned
  // for a median of the measured sections: thinner sections allow more, by their chips.
  const bool faster =
      chip < kNoLimit && (q_.kind == CutKind::kRough || q_.surface_ra_um > 0.0 || q_.as_measured);
  whole_chip_ = faster ? std::max(nominal, chip * tooth_.teeth * n_) : nominal;
  ceiling_ = faster ? std::max(nominal, kMostThinning * chip * tooth_.teeth * n_) : nominal;
  // The lower bound never exceeds the planned feed: a thinner feed chosen for the step is the minimum there.
  floor_ = std::min(nominal, std::max(kLeastFeedShare * nominal, least_feed_mm_min(q_, n_)));
  ceiling_ = std::max(ceiling_, floor_);
}

double CutLoads::slot_share(const Cut& cut) const {
  const bool slot = q_.kind == CutKind::kRough && cut.exit_rad - cut.entry_rad >= kSlotArc;
  return slot ? deep_slot_share(cut.ap_mm, q_.cutter.cutting_diameter_mm) : 1.0;
}

double CutLoads::surface_um(double fz) const {
  const double wall = mechanics::wall_rz_mm(fz, q_.cutter.cutting_diameter_mm);
  const double corner = q_.cutter.corner_radius_mm;
  const double rz = corner > 0.0 ? std::max(wall, mechanics::floor_rz_mm(fz, corner)) : wall;
  return 1000.0 * kRoughnessOverGeometry * mechanics::kArcRaOverRz * rz;
}

bool CutLoads::make_walls_ready(ReadyCut& cut) const {
  constexpr double kReaches = 1e-9;
  mechanics::Section to_wall = cut.section;
  to_wall.csa_mm2 = to_wall.band_mm = 0.0;
  // A corner or ball that is not in with its full radius touches the wall with what is in.
  const double top =
      mechanics::effective_diameter_mm(to_wall.ap_mm, tooth_.cutting_diameter_mm, tooth_.corner_radius_mm);
  const double at_wall = std::acos(std::min(1.0, top / tooth_.cutting_diameter_mm)) + kReaches;
  if (tooth_.corner_radius_mm > 0.0) {
    if (to_wall.arc.entry_rad <= at_wall) to_wall.arc.entry_rad = 0.0;
    if (to_wall.arc.exit_rad >= pi - at_wall) to_wall.arc.exit_rad = pi;
  }
  const auto ready = [&](mechanics::WallSide side, std::optional<mechanics::WallAtFeeds>& out) {
    auto wall = mechanics::WallAtFeeds::of(to_wall, tooth_, law_, side, beam_);
    if (!wall) return false;
    out = *std::move(wall);
    return true;
  };
  if (to_wall.arc.entry_rad <= kReaches && !ready(mechanics::WallSide::kLeft, cut.left)) return false;
  return to_wall.arc.exit_rad < pi - kReaches || ready(mechanics::WallSide::kRight, cut.right);
}

std::optional<ReadyCut> CutLoads::ready(const Cut& cut) const {
  tick(16);  // it takes some 30 us
  const mechanics::Section section{.ap_mm = cut.ap_mm,
                                   .arc = {cut.entry_rad, cut.exit_rad},
                                   .csa_mm2 = cut.csa_mm2,
                                   .band_mm = cut.band_mm};
  auto loads = mechanics::SectionAtFeeds::of(section, tooth_, law_);
  if (!loads) return std::nullopt;
  ReadyCut out{
      .cut = cut, .section = section, .loads = *std::move(loads), .strip = {}, .left = {}, .right = {}};
  if (cut.band_mm > 0.0 && !cut.chip_measured) {
    auto strip = mechanics::ThickestChip::of({.ap_mm = section.ap_mm, .arc = section.arc}, tooth_, law_);
    if (!strip) return std::nullopt;
    out.strip = *std::move(strip);
  }
  if (!beam_.segments.empty() && !make_walls_ready(out)) return std::nullopt;
  return out;
}

std::optional<State> CutLoads::at(const Cut& cut, double feed) const {
  const auto made = ready(cut);
  return made ? at(*made, feed) : std::nullopt;
}

std::optional<State> CutLoads::at(const ReadyCut& made, double feed) const {
  tick();
  const Cut& cut = made.cut;
  const double fz = feed / (n_ * tooth_.teeth) * cut.gain;
  const auto l = made.loads.at(fz, n_);
  if (!l) return std::nullopt;
  double chip = l->h_max_mm;
  if (cut.chip_measured) {
    // A longer tooth takes what the others leave, at most all of it (mechanics/loads/section.h).
    const double longer = tooth_.runout_mm * std::sin(pi / tooth_.teeth);
    chip = std::min(fz * cut.front_sin + longer, fz * cut.front_sin * tooth_.teeth);
  } else if (made.strip) {
    // How the area lies in the strip is not known: the chip is that of the front, wherever the arc has it.
    chip = std::max(chip, made.strip->at_mm(fz));
  }
  // The area of a section that is no rectangle may lie anywhere in its arc: a rib stands in front.
  chip =
      std::max(chip, fz * cut.front_sin * std::cos(tooth_.lead_angle_rad) * std::cos(tooth_.taper_angle_rad));
  State s;
  s.raw = *l;
  s.chip_mm = chip;
  const double force = l->peak_force_n * margin_;
  const double area = cut.csa_mm2 > 0.0
                          ? cut.csa_mm2
                          : cut.ap_mm * width_of(cut.entry_rad, cut.exit_rad, tooth_.cutting_diameter_mm);
  const double power =
      std::max(l->power_w * margin_, power_by_card_w(q_, area * fz * tooth_.teeth * n_, l->h_mean_mm));
  s.load.of(Limit::kPeakForce) = force;
  s.load.of(Limit::kToolDeflection) = force * compliance_;
  s.load.of(Limit::kSpindleTorque) = std::max(l->torque_nm * margin_, 30.0 * power / (pi * n_));
  s.load.of(Limit::kSpindlePower) = power;
  s.load.of(Limit::kChipThickness) = chip / slot_share(cut);
  s.load.of(Limit::kSurfaceRoughness) = surface_um(fz);
  for (const auto* side : {&made.left, &made.right}) {
    if (!*side) continue;
    const auto wall = (*side)->at(fz);
    if (!wall) return std::nullopt;
    double& worst = s.load.of(Limit::kWallError);
    worst = std::max(worst, std::abs(wall->largest_mm()) * margin_);
  }
  for (const double v : s.load) {
    if (!std::isfinite(v)) return std::nullopt;
  }
  return s;
}

std::optional<State> CutLoads::plunging(double area_mm2, double feed) const {
  mechanics::DrillingCut c;
  c.diameter_mm = q_.cutter.cutting_diameter_mm;
  c.feed_mm_per_rev = feed / n_;
  c.n_rpm = n_;
  c.teeth = tooth_.teeth;
  c.point_angle_rad = pi;
  const auto l = mechanics::drilling_loads(c, law_.kienzle);
  if (!l) return std::nullopt;
  const double disc = 0.25 * pi * c.diameter_mm * c.diameter_mm;
  const double share = area_mm2 > 0.0 ? std::min(1.0, area_mm2 / disc) : 1.0;
  const double margin = drilling_margin_of(q_).factor() * share;
  State s;
  s.load.of(Limit::kSpindleTorque) = l->torque_nm * margin;
  s.load.of(Limit::kSpindlePower) = l->power_w * margin;
  s.load.of(Limit::kChipThickness) = s.chip_mm = l->chip_thickness_mm;
  return s;
}

double CutLoads::largest(const Cut& cut, double most) const {
  const auto made = ready(cut);
  const auto ok = [&](double feed) {
    const auto s = made ? at(*made, feed) : std::nullopt;
    return s && ratio(s->load, limits_) <= 1.0;
  };
  if (!(most > 0.0) || ok(most)) return most;
  double lo = floor_;
  double hi = most;
  if (!(lo < hi) || !ok(lo)) return 0.0;
  constexpr double kNear = 1e-7;
  for (int i = 0; i < 60 && hi > lo * (1.0 + kNear); ++i) {
    const double mid = std::sqrt(lo * hi);
    (ok(mid) ? lo : hi) = mid;
  }
  return lo;
}

}  // namespace capstan::optimise::feed
