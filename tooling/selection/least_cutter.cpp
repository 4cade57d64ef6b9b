#include "tooling/selection/least_cutter.h"

#include <algorithm>
#include <cmath>

#include "planner/ground/base/number.h"
#include "tooling/library/cutters/check.h"
#include "tooling/library/cutters/complete.h"
#include "tooling/library/cutters/edge_kind.h"
#include "tooling/library/cutters/generic.h"
#include "tooling/selection/limits.h"

namespace capstan::tooling {
namespace {

using model::Cutter;
using model::CutterClass;
using model::CutterTrait;
using model::ToolRequirement;

/// Between what is cut and the holder's face. Default, unsourced.
constexpr double kClearOfHolderMm = 2.0;

/// The least diameter of a tool that only marks: its cone as wide as it is sunk.
double marks_from_mm(const Cutter& c, const ToolRequirement& r) {
  return 2.0 * r.depth_of_cut_mm * std::tan(0.5 * c.point_angle_rad);
}

/// The generic cutter of the class with the largest diameter within the limits, the shortest of these; else
/// the nearest. Of tools that only mark, the smallest that makes the mark: a larger one does nothing more.
/// Null where there is none of the class.
const Cutter* pattern_of(const ToolRequirement& r, CutterClass c, const std::vector<Cutter>& generic) {
  const bool marks = model::has(c, CutterTrait::kMarks);
  const double high = model::upper_size(r);
  const auto off = [&](const Cutter& g) {
    const double d = g.cutting_diameter_mm;
    const double low = std::max(model::lower_size(r), marks ? marks_from_mm(g, r) : 0.0);
    return std::max({0.0, low - d, high > 0.0 ? d - high : 0.0});
  };
  const Cutter* best = nullptr;
  for (const Cutter& g : generic) {
    if (g.cutter_class != c || (r.solid_carbide && g.substrate != model::Substrate::kCarbide)) continue;
    if (drills_with_inserts(g) && r.point_angle_most_rad < g.point_angle_rad) continue;
    const double larger = marks ? -1.0 : 1.0;
    if (best == nullptr || off(g) < off(*best) ||
        (off(g) == off(*best) && (larger * g.cutting_diameter_mm > larger * best->cutting_diameter_mm ||
                                  (g.cutting_diameter_mm == best->cutting_diameter_mm &&
                                   g.usable_length_mm < best->usable_length_mm))))
      best = &g;
  }
  return best;
}

void take_shape(Cutter& c, const ToolRequirement& r) {
  if (r.corner_radius_exact_mm >= 0.0) c.corner_radius_mm = r.corner_radius_exact_mm;
  if (r.corner_radius_limited) c.corner_radius_mm = std::min(c.corner_radius_mm, r.corner_radius_max_mm);
  if (model::has(c.cutter_class, CutterTrait::kBall)) c.corner_radius_mm = 0.5 * c.cutting_diameter_mm;
  if (r.point_angle_rad > 0.0)
    c.point_angle_rad =
        std::clamp(c.point_angle_rad, r.point_angle_rad, std::max(r.point_angle_rad, r.point_angle_most_rad));
  if (r.taper_angle_rad > 0.0)
    (c.cutter_class == CutterClass::kDovetailMill ? c.lead_angle_rad : c.taper_angle_rad) = r.taper_angle_rad;
  if (r.tip_diameter_max_mm > 0.0) c.tip_diameter_mm = std::min(c.tip_diameter_mm, r.tip_diameter_max_mm);
  if (r.cutting_width_max_mm > 0.0 && c.cutting_width_mm > 0.0)
    c.cutting_width_mm = std::min(c.cutting_width_mm, r.cutting_width_max_mm);
  if (r.thread_pitch_mm > 0.0) c.thread_pitch_mm = r.thread_pitch_mm;
  if (r.thread_size_mm > 0.0) c.thread_size_mm = r.thread_size_mm;
  if (!r.thread_form.empty()) c.thread_form = r.thread_form;
  c.hand = r.left_hand ? model::Hand::kLeft : model::Hand::kRight;
  c.coolant_through = r.coolant_through;
  c.centre_cutting = c.centre_cutting || r.centre_cutting;
  double neck = r.neck_diameter_max_mm;
  if (r.neck_step_min_mm > 0.0) {
    const double by_step = c.cutting_diameter_mm - r.neck_step_min_mm;
    neck = neck > 0.0 ? std::min(neck, by_step) : by_step;
  }
  if (neck > 0.0) {
    c.neck_diameter_mm = neck;
    c.neck_length_mm = r.reach_mm;
  }
}

/// A mill's shank follows it into the work, so that it is no thicker; a drill's flutes are as long as it is
/// used, for chips leave by them.
void take_lengths(Cutter& c, const ToolRequirement& r) {
  const bool mills = !model::has(c.cutter_class, CutterTrait::kAlongAxis);
  if (mills && c.neck_diameter_mm == 0.0 && c.shank_diameter_mm > c.cutting_diameter_mm)
    c.shank_diameter_mm = c.cutting_diameter_mm;
  c.usable_length_mm = std::max(r.reach_mm, r.depth_of_cut_mm);
  const bool flutes_carry = model::has(c.cutter_class, CutterTrait::kDrills);
  c.maximum_depth_of_cut_mm = std::max(
      flutes_carry ? c.usable_length_mm : 0.0,
      r.depth_of_cut_mm > 0.0
          ? flutes_needed(c, r)
          : std::min(c.maximum_depth_of_cut_mm, std::max(c.usable_length_mm, c.cutting_diameter_mm)));
  c.usable_length_mm = std::max(c.usable_length_mm, flutes_carry ? 0.0 : c.maximum_depth_of_cut_mm);
  c.stick_out_mm = std::max(c.usable_length_mm, c.maximum_depth_of_cut_mm) + kClearOfHolderMm;
}

/// Whether nobody sells a mill so long and thin: 10 x D is the longest of reach tools (amgcarbidetool.com,
/// the relationship between end mill diameter and length), as the longest necks of the generic series.
bool beyond_reach(const Cutter& c) {
  constexpr double kLongest = 10.0;
  return !model::has(c.cutter_class, CutterTrait::kAlongAxis) &&
         c.usable_length_mm > kLongest * c.cutting_diameter_mm;
}

}  // namespace

std::optional<model::Candidate> needed_cutter(const ToolRequirement& r, const model::WorkMaterial& material,
                                              const model::Machine& machine, const Preferences& preferences) {
  const auto& generic = shared_generic_library();
  if (!generic) return std::nullopt;
  for (const CutterClass wanted : r.classes) {
    const Cutter* like = pattern_of(r, wanted, *generic);
    if (like == nullptr) continue;
    Cutter c = *like;
    const double low = model::lower_size(r), high = model::upper_size(r);
    if (r.diameter_exact_mm > 0.0)
      c.cutting_diameter_mm = r.diameter_exact_mm;
    else if (c.cutting_diameter_mm < low || (high > 0.0 && c.cutting_diameter_mm > high))
      c.cutting_diameter_mm = high > 0.0 ? high : low;
    c.adjustable_to_mm = 0.0;
    c.overall_length_mm = 0.0;
    const double gage = c.functional_length_mm - c.stick_out_mm;
    take_shape(c, r);
    take_lengths(c, r);
    for (double* v : {&c.maximum_depth_of_cut_mm, &c.usable_length_mm, &c.stick_out_mm, &c.neck_length_mm})
      *v = std::ceil(*v * 10.0 - 1e-6) / 10.0;
    c.functional_length_mm = gage + c.stick_out_mm;
    c.id = "needed " + std::string(model::to_text(c.cutter_class)) + " " + trimmed(c.cutting_diameter_mm, 4);
    if (c.corner_radius_mm > 0.0 && !model::has(wanted, CutterTrait::kBall))
      c.id += "r" + trimmed(c.corner_radius_mm, 4);
    c.id += "x" + trimmed(c.usable_length_mm, 1);
    c.description = c.id;
    c.pocket = 0;
    if (!faults_of(c).empty() || beyond_reach(c)) continue;
    auto fits = select(r, {c}, material, machine, preferences);
    if (!fits.ranked.empty()) return std::move(fits.ranked.front());
  }
  return std::nullopt;
}

}  // namespace capstan::tooling
