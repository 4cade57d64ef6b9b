#include "planner/model/plan/cutter/cutter_faults.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <type_traits>
#include <utility>

#include "planner/ground/base/text.h"
#include "planner/model/plan/cutter/cutter_fields.h"
#include "planner/model/plan/range/ranges.h"

namespace capstan::model {
namespace {

constexpr double kSlackMm = 1e-9;

void check_number(double v, const char* name, const Range& range, std::vector<std::string>& out) {
  if (range.holds(v)) return;
  out.push_back(std::string(name) + (v < 0.0 && range.least >= 0.0 ? " is negative: " : " is ") +
                value_text(v) + "; it can be " + to_text(range));
}
void check_angle(double v, const char* name, double most, std::vector<std::string>& out) {
  check_number(v, name, {1e-6, most, true}, out);
}

/// What must be said, since a guess would spoil the thread or the shape.
std::string missing_of(const Cutter& c) {
  const CutterMust must = row_of(c.cutter_class).must;
  bool states = must.field.empty();
  for_each_field(c, [&](const auto& row, const auto& value) {
    if constexpr (std::is_same_v<std::decay_t<decltype(value)>, double>)
      states = states || (row.name == must.field && value != 0.0);
  });
  if (states) return {};
  return "a " + std::string(words_of(c.cutter_class)) + " without " + std::string(must.words);
}

void check_together(const Cutter& c, std::vector<std::string>& out) {
  const double radius = 0.5 * c.cutting_diameter_mm;
  if (c.cutting_diameter_mm == 0.0) {
    out.emplace_back("the cutting diameter is zero");
    return;
  }
  if (c.corner_radius_mm > radius + kSlackMm)
    out.push_back("the corner radius " + mm_text(c.corner_radius_mm, 4) +
                  " is larger than half the diameter " + mm_text(c.cutting_diameter_mm, 4));
  if (c.tip_diameter_mm > c.cutting_diameter_mm + kSlackMm)
    out.push_back("the tip " + mm_text(c.tip_diameter_mm, 4) + " is wider than the diameter " +
                  mm_text(c.cutting_diameter_mm, 4));
  if (c.maximum_depth_of_cut_mm > c.stick_out_mm + kSlackMm)
    out.push_back("the flutes (" + mm_text(c.maximum_depth_of_cut_mm, 4) +
                  ") are longer than the tool sticks out (" + mm_text(c.stick_out_mm, 4) + ")");
  if (c.usable_length_mm > c.stick_out_mm + kSlackMm)
    out.push_back("the usable length " + mm_text(c.usable_length_mm, 4) +
                  " is longer than the tool sticks out (" + mm_text(c.stick_out_mm, 4) + ")");
  if (c.stick_out_mm > c.functional_length_mm + kSlackMm)
    out.push_back("the tool sticks out " + mm_text(c.stick_out_mm, 4) +
                  ", more than from gage line to tip (" + mm_text(c.functional_length_mm, 4) + ")");
  const auto longer = [&](double v, const char* what, double than, const char* other) {
    if (than > 0.0 && v > than + kSlackMm)
      out.push_back(std::string(what) + " (" + mm_text(v, 4) + ") is longer than " + other + " (" +
                    mm_text(than, 4) + ")");
  };
  longer(c.maximum_depth_of_cut_mm, "the length of the flutes", c.overall_length_mm, "the whole tool");
  longer(c.stick_out_mm, "what sticks out", c.overall_length_mm, "the whole tool");
  longer(c.neck_length_mm, "the neck, from the tip,", c.overall_length_mm, "the whole tool");
  if (c.neck_length_mm > 0.0)
    longer(c.maximum_depth_of_cut_mm, "the length of the flutes", c.neck_length_mm, "the neck, from the tip");
  const double widest = std::max(c.cutting_diameter_mm, c.shank_diameter_mm);
  if (c.neck_diameter_mm > widest + kSlackMm)
    out.push_back("the neck " + mm_text(c.neck_diameter_mm, 4) + " is thicker than head and shank (" +
                  mm_text(widest, 4) + ")");
  const bool probe = c.cutter_class == CutterClass::kTouchProbe;
  if (!range::kTeeth.holds(c.teeth) && !(probe && c.teeth == 0))
    out.push_back(std::to_string(c.teeth) + " teeth");
  if (c.pocket < 0) out.push_back("the tool number is negative: " + std::to_string(c.pocket));
  if (std::string missing = missing_of(c); !missing.empty()) out.push_back(std::move(missing));
  if (c.fz_min_mm > c.fz_max_mm)
    out.push_back("the least feed per tooth " + mm_text(c.fz_min_mm, 4) + " is above the largest " +
                  mm_text(c.fz_max_mm, 4));
  if (c.adjustable_to_mm != 0.0 && c.adjustable_to_mm < c.cutting_diameter_mm)
    out.push_back("it can be set to " + mm_text(c.adjustable_to_mm, 4) + ", less than its diameter " +
                  mm_text(c.cutting_diameter_mm, 4));
}

}  // namespace

std::vector<std::string> value_faults_of(const Cutter& c) {
  std::vector<std::string> out;
  const std::pair<double, const char*> lengths[] = {{c.corner_radius_mm, "the corner radius"},
                                                    {c.tip_diameter_mm, "the tip diameter"},
                                                    {c.maximum_depth_of_cut_mm, "the depth of cut"},
                                                    {c.usable_length_mm, "the usable length"},
                                                    {c.stick_out_mm, "the stick-out"},
                                                    {c.functional_length_mm, "the length"},
                                                    {c.shank_diameter_mm, "the shank diameter"},
                                                    {c.holder_diameter_mm, "the holder diameter"},
                                                    {c.thread_pitch_mm, "the pitch"},
                                                    {c.fz_min_mm, "the least feed per tooth"},
                                                    {c.fz_max_mm, "the largest feed per tooth"},
                                                    {c.adjustable_to_mm, "the largest diameter"},
                                                    {c.overall_length_mm, "the overall length"},
                                                    {c.neck_diameter_mm, "the neck's diameter"},
                                                    {c.neck_length_mm, "the neck's length"},
                                                    {c.cutting_width_mm, "the cutting width"},
                                                    {c.thread_size_mm, "the thread's size"},
                                                    {c.lead_length_mm, "the lead's length"}};
  for (const auto& [value, name] : lengths) check_number(value, name, range::kToolLengthMm, out);
  const double pi = std::numbers::pi;
  check_angle(c.point_angle_rad, "the point angle (rad)", pi, out);
  check_angle(std::abs(c.helix_rad), "the helix (rad)", 0.5 * pi, out);
  check_angle(c.lead_angle_rad, "the lead angle (rad)", 0.5 * pi, out);
  check_angle(c.maximum_ramp_angle_rad, "the ramp angle (rad)", 0.5 * pi, out);
  check_number(c.maximum_speed_rpm, "the largest speed", range::kToolSpeedRpm, out);
  check_number(c.life_min, "the life", range::kToolLifeMin, out);
  check_number(c.price, "the price", range::kPrice, out);
  check_angle(c.taper_angle_rad, "the taper (rad)", 0.5 * pi, out);
  check_number(c.lead_threads, "the threads in the lead", range::kLeadThreads, out);
  check_number(c.life_used_min, "the life used", range::kToolLifeMin, out);
  for (const HolderSegment& s : c.holder) {
    check_number(s.height_mm, "a holder segment's height", range::kToolLengthMm, out);
    check_number(s.lower_diameter_mm, "a holder segment's diameter", range::kToolLengthMm, out);
    check_number(s.upper_diameter_mm, "a holder segment's diameter", range::kToolLengthMm, out);
  }
  check_number(c.runout_mm, "the runout", range::kToolLengthMm, out);
  if (c.cutting_diameter_mm != 0.0)
    check_number(c.cutting_diameter_mm, "the cutting diameter", range::kToolDiameterMm, out);
  return out;
}

std::vector<std::string> faults_of(const Cutter& c) {
  std::vector<std::string> out = value_faults_of(c);
  if (out.empty()) check_together(c, out);
  return out;
}

}  // namespace capstan::model
