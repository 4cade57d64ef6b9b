#include "planner/model/plan/requirement.h"

#include <algorithm>

#include "planner/ground/base/number.h"
#include "planner/ground/base/text.h"

namespace capstan::model {
double lower_size(const ToolRequirement& r) {
  return r.diameter_exact_mm > 0.0 ? r.diameter_exact_mm - r.diameter_tolerance_mm : r.diameter_min_mm;
}
double upper_size(const ToolRequirement& r) {
  return r.diameter_exact_mm > 0.0 ? r.diameter_exact_mm + r.diameter_tolerance_mm : r.diameter_max_mm;
}

std::string words_of(const ToolRequirement& r) {
  const bool vowel = r.diameter_exact_mm <= 0.0 && (lower_size(r) <= 0.0 || upper_size(r) <= 0.0) &&
                     !r.classes.empty() && r.classes.front() == CutterClass::kEndmill;
  std::string out = vowel ? "an " : "a ";
  const double low = lower_size(r), high = upper_size(r);
  if (r.diameter_exact_mm > 0.0)
    out += mm_text(r.diameter_exact_mm) + " ";
  else if (low > 0.0 && high > 0.0)
    out += mm_text(low) + " to " + mm_text(high) + " ";
  for (std::size_t i = 0; i < r.classes.size(); ++i)
    out += (i == 0 ? "" : " or ") + std::string(words_of(r.classes[i]));
  if (r.classes.empty()) out += "cutter";
  if (r.diameter_exact_mm <= 0.0 && low <= 0.0 && high > 0.0) out += " of at most " + mm_text(high);
  if (low > 0.0 && high <= 0.0) out += " of at least " + mm_text(low);
  std::string with;
  const auto add = [&](const std::string& text) { with += (with.empty() ? " with " : ", ") + text; };
  if (r.thread_size_mm > 0.0) add("threads of " + mm_text(r.thread_size_mm));
  if (r.thread_pitch_mm > 0.0) add(mm_text(r.thread_pitch_mm) + " pitch");
  if (!r.thread_form.empty()) add("form " + r.thread_form);
  if (r.lead_threads_max > 0.0) add("a lead of at most " + trimmed(r.lead_threads_max, 1) + " threads");
  if (r.taper_angle_rad > 0.0) add(deg_text(r.taper_angle_rad) + " taper");
  if (r.point_angle_rad <= 0.0 && r.point_angle_most_rad > 0.0 && !r.solid_carbide)
    add("a point of at most " + deg_text(r.point_angle_most_rad));
  if (r.point_angle_rad > 0.0)
    add((r.point_angle_most_rad > r.point_angle_rad
             ? "a point of " + deg_text(r.point_angle_rad) + " to " + deg_text(r.point_angle_most_rad)
             : deg_text(r.point_angle_rad) + " point"));
  if (r.corner_radius_exact_mm >= 0.0) add(mm_text(r.corner_radius_exact_mm) + " corner radius");
  if (r.corner_radius_limited) add("at most " + mm_text(r.corner_radius_max_mm) + " corner radius");
  if (r.cutting_width_max_mm > 0.0) add("at most " + mm_text(r.cutting_width_max_mm) + " width");
  if (r.neck_diameter_max_mm > 0.0) add("a neck of at most " + mm_text(r.neck_diameter_max_mm));
  if (r.neck_step_min_mm > 0.0) {
    add(high > r.neck_step_min_mm ? "a neck of at most " + mm_text(high - r.neck_step_min_mm) + " (" +
                                        mm_text(r.neck_step_min_mm) + " below its head)"
                                  : "a neck " + mm_text(r.neck_step_min_mm) + " below its head");
  }
  if (r.tip_diameter_max_mm > 0.0) add("a tip of at most " + mm_text(r.tip_diameter_max_mm));
  if (r.depth_of_cut_mm > 0.0) add(mm_text(r.depth_of_cut_mm) + " flutes");
  if (r.reach_mm > 0.0) add(mm_text(r.reach_mm) + " reach");
  const bool inserts_do = r.point_angle_rad <= 0.0 && r.point_angle_most_rad > 0.0;
  if (r.solid_carbide) with += inserts_do ? ", of solid carbide or with inserts" : ", of solid carbide";
  if (r.centre_cutting) with += ", cutting to centre or ramping";
  if (r.coolant_through) with += ", with coolant through it";
  if (r.left_hand) with += ", left-hand";
  return out + with;
}

}  // namespace capstan::model
