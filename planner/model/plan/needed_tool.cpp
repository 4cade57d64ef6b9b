#include "planner/model/plan/needed_tool.h"

#include <algorithm>

#include "planner/ground/base/number.h"
#include "planner/ground/vocabulary/unit_factors.h"
#include "planner/model/plan/corner_rest.h"

namespace capstan::model {
namespace {

/// Whether two differ in their lengths alone.
bool same_kind(const Cutter& a, const Cutter& b) {
  Cutter other = b;
  other.id = a.id;
  other.description = a.description;
  other.maximum_depth_of_cut_mm = a.maximum_depth_of_cut_mm;
  other.usable_length_mm = a.usable_length_mm;
  other.stick_out_mm = a.stick_out_mm;
  other.functional_length_mm = a.functional_length_mm;
  other.overall_length_mm = a.overall_length_mm;
  other.neck_length_mm = a.neck_length_mm;
  other.sources = a.sources;
  return a == other;
}

void lengthen(Cutter& c, const Cutter& by) {
  c.maximum_depth_of_cut_mm = std::max(c.maximum_depth_of_cut_mm, by.maximum_depth_of_cut_mm);
  c.usable_length_mm = std::max(c.usable_length_mm, by.usable_length_mm);
  c.stick_out_mm = std::max(c.stick_out_mm, by.stick_out_mm);
  c.functional_length_mm = std::max(c.functional_length_mm, by.functional_length_mm);
  c.neck_length_mm = std::max(c.neck_length_mm, by.neck_length_mm);
}

std::string names_of(const NeededKind& kind) {
  std::string out;
  for (const std::string& name : kind.features) out += (out.empty() ? "'" : ", '") + name + "'";
  return out;
}

}  // namespace

std::vector<NeededKind> needed_kinds(const Plan& plan, const std::vector<NeededTool>& needed) {
  std::vector<NeededKind> out;
  for (const NeededTool& n : needed) {
    const bool unplanned = std::any_of(plan.unplanned.begin(), plan.unplanned.end(),
                                       [&](const Unplanned& u) { return u.feature == n.feature; });
    if (!unplanned && !corner_rest_of(plan, n.feature_name)) continue;
    auto kind = std::find_if(out.begin(), out.end(),
                             [&](const NeededKind& k) { return same_kind(k.cutter, n.cutter); });
    if (kind == out.end()) kind = out.insert(out.end(), NeededKind{n.cutter, n.words, {}});
    lengthen(kind->cutter, n.cutter);
    auto& names = kind->features;
    if (std::find(names.begin(), names.end(), n.feature_name) == names.end()) names.push_back(n.feature_name);
  }
  return out;
}

std::string list_entry(const Cutter& c) {
  std::string out = "{id: \"" + c.id + "\", class: " + std::string(to_text(c.cutter_class)) +
                    ", substrate: " + std::string(to_text(c.substrate));
  const auto add = [&](const char* key, double v) {
    if (v > 0.0) out += ", " + std::string(key) + ": " + trimmed(v, 4);
  };
  add("cutting_diameter", c.cutting_diameter_mm);
  add("corner_radius", c.corner_radius_mm);
  add("tip_diameter", c.tip_diameter_mm);
  add("teeth", c.teeth);
  add("maximum_depth_of_cut", c.maximum_depth_of_cut_mm);
  add("usable_length", c.usable_length_mm);
  add("stick_out", c.stick_out_mm);
  add("shank_diameter", c.shank_diameter_mm);
  add("neck_diameter", c.neck_diameter_mm);
  add("neck_length", c.neck_length_mm);
  add("cutting_width", c.cutting_width_mm);
  add("point_angle_deg", c.point_angle_rad / kRadPerDegree);
  add("lead_angle_deg", c.lead_angle_rad / kRadPerDegree);
  add("taper_angle_deg", c.taper_angle_rad / kRadPerDegree);
  add("maximum_ramp_angle_deg", c.maximum_ramp_angle_rad / kRadPerDegree);
  add("thread_pitch", c.thread_pitch_mm);
  add("thread_size", c.thread_size_mm);
  add("lead_threads", c.lead_threads);
  add("adjustable_to", c.adjustable_to_mm);
  if (!c.thread_form.empty()) out += ", thread_form: " + c.thread_form;
  if (c.centre_cutting) out += ", centre_cutting: true";
  if (c.coolant_through) out += ", coolant_through: true";
  if (c.hand == Hand::kLeft) out += ", hand: left";
  return out + "}";
}

Provenance provenance_of(const NeededKind& kind, std::size_t number) {
  return {"needed tool " + std::to_string(number), list_entry(kind.cutter), "for " + names_of(kind)};
}

std::string text_of(const NeededKind& kind) {
  const Cutter& c = kind.cutter;
  std::string out = std::string(to_text(c.cutter_class)) + " " + trimmed(c.cutting_diameter_mm, 4) + " mm";
  const auto add = [&](const char* what, double v, const char* unit) {
    if (v > 0.0) out += ", " + std::string(what) + " " + trimmed(v, 3) + " " + unit;
  };
  add("usable length at least", c.usable_length_mm, "mm");
  add("flutes at least", c.maximum_depth_of_cut_mm, "mm");
  add("corner radius", c.corner_radius_mm, "mm");
  add("point", c.point_angle_rad / kRadPerDegree, "deg");
  add("pitch", c.thread_pitch_mm, "mm");
  add("neck at most", c.neck_diameter_mm, "mm");
  return out + ", for " + names_of(kind);
}

}  // namespace capstan::model
