#include "tooling/catalogue/check.h"

#include <cmath>
#include <map>
#include <numbers>
#include <utility>

#include "planner/base/number.h"

namespace capstan::tooling {
namespace {

using model::Cutter;
using model::CutterClass;

/// Above any milling tool; a value beyond it is a wrong unit or a slip.
constexpr double kLongestMm = 2000.0;
constexpr int kMostTeeth = 60;
constexpr double kSlackMm = 1e-9;

std::string mm(double v) { return trimmed(v, 4) + " mm"; }

void check_number(double v, const char* name, double most, std::vector<std::string>& out) {
  if (!std::isfinite(v)) {
    out.push_back(std::string(name) + " is not a finite number");
  } else if (v < 0.0) {
    out.push_back(std::string(name) + " is negative: " + trimmed(v, 6));
  } else if (v > most) {
    out.push_back(std::string(name) + " is " + trimmed(v, 6) + ", beyond " + trimmed(most, 6));
  }
}

/// What must be said, since a guess would spoil the thread or the shape.
const char* missing_of(const Cutter& c) {
  switch (c.cutter_class) {
    case CutterClass::kTap:
      return c.thread_pitch_mm == 0.0 ? "a tap without a pitch" : nullptr;
    case CutterClass::kThreadMill:
      return c.thread_pitch_mm == 0.0 ? "a thread mill without a pitch" : nullptr;
    case CutterClass::kBullnoseEndmill:
      return c.corner_radius_mm == 0.0 ? "a bull nose end mill without a corner radius" : nullptr;
    case CutterClass::kChamferMill:
      return c.point_angle_rad == 0.0 ? "a chamfer mill without the angle of its cone" : nullptr;
    case CutterClass::kCountersink:
    case CutterClass::kBackCountersink:
      return c.point_angle_rad == 0.0 ? "a countersink without the angle of its cone" : nullptr;
    case CutterClass::kTaperedEndmill:
      return c.taper_angle_rad == 0.0 ? "a tapered end mill without its angle" : nullptr;
    default:
      return nullptr;
  }
}

void check_together(const Cutter& c, std::vector<std::string>& out) {
  const double radius = 0.5 * c.cutting_diameter_mm;
  if (c.cutting_diameter_mm == 0.0) {
    out.emplace_back("the cutting diameter is zero");
    return;
  }
  if (c.corner_radius_mm > radius + kSlackMm)
    out.push_back("the corner radius " + mm(c.corner_radius_mm) + " is larger than half the diameter " +
                  mm(c.cutting_diameter_mm));
  if (c.tip_diameter_mm > c.cutting_diameter_mm + kSlackMm)
    out.push_back("the tip " + mm(c.tip_diameter_mm) + " is wider than the diameter " +
                  mm(c.cutting_diameter_mm));
  if (c.maximum_depth_of_cut_mm > c.stick_out_mm + kSlackMm)
    out.push_back("the flutes (" + mm(c.maximum_depth_of_cut_mm) + ") are longer than the tool sticks out (" +
                  mm(c.stick_out_mm) + ")");
  if (c.usable_length_mm > c.stick_out_mm + kSlackMm)
    out.push_back("the usable length " + mm(c.usable_length_mm) + " is longer than the tool sticks out (" +
                  mm(c.stick_out_mm) + ")");
  if (c.stick_out_mm > c.functional_length_mm + kSlackMm)
    out.push_back("the tool sticks out " + mm(c.stick_out_mm) + ", more than from gage line to tip (" +
                  mm(c.functional_length_mm) + ")");
  const bool probe = c.cutter_class == CutterClass::kTouchProbe;
  if (c.teeth < (probe ? 0 : 1) || c.teeth > kMostTeeth) out.push_back(std::to_string(c.teeth) + " teeth");
  if (c.pocket < 0) out.push_back("the tool number is negative: " + std::to_string(c.pocket));
  if (const char* missing = missing_of(c)) out.emplace_back(missing);
  if (c.fz_min_mm > c.fz_max_mm)
    out.push_back("the least feed per tooth " + mm(c.fz_min_mm) + " is above the largest " + mm(c.fz_max_mm));
  if (c.adjustable_to_mm != 0.0 && c.adjustable_to_mm < c.cutting_diameter_mm)
    out.push_back("it can be set to " + mm(c.adjustable_to_mm) + ", less than its diameter " +
                  mm(c.cutting_diameter_mm));
}

}  // namespace

std::vector<std::string> faults_of(const Cutter& c) {
  std::vector<std::string> out;
  const std::pair<double, const char*> lengths[] = {
      {c.cutting_diameter_mm, "the cutting diameter"}, {c.corner_radius_mm, "the corner radius"},
      {c.tip_diameter_mm, "the tip diameter"},         {c.maximum_depth_of_cut_mm, "the depth of cut"},
      {c.usable_length_mm, "the usable length"},       {c.stick_out_mm, "the stick-out"},
      {c.functional_length_mm, "the length"},          {c.shank_diameter_mm, "the shank diameter"},
      {c.holder_diameter_mm, "the holder diameter"},   {c.thread_pitch_mm, "the pitch"},
      {c.fz_min_mm, "the least feed per tooth"},       {c.fz_max_mm, "the largest feed per tooth"},
      {c.adjustable_to_mm, "the largest diameter"},    {c.overall_length_mm, "the overall length"},
      {c.neck_diameter_mm, "the neck's diameter"},     {c.neck_length_mm, "the neck's length"},
      {c.cutting_width_mm, "the cutting width"},       {c.thread_size_mm, "the thread's size"},
      {c.lead_length_mm, "the lead's length"}};
  for (const auto& [value, name] : lengths) check_number(value, name, kLongestMm, out);
  const double pi = std::numbers::pi;
  check_number(c.point_angle_rad, "the point angle (rad)", pi, out);
  check_number(std::abs(c.helix_rad), "the helix (rad)", 0.5 * pi, out);
  check_number(c.lead_angle_rad, "the lead angle (rad)", 0.5 * pi, out);
  check_number(c.maximum_ramp_angle_rad, "the ramp angle (rad)", 0.5 * pi, out);
  check_number(c.maximum_speed_rpm, "the largest speed", 1e6, out);
  check_number(c.life_min, "the life", 1e6, out);
  check_number(c.price, "the price", 1e9, out);
  check_number(c.taper_angle_rad, "the taper (rad)", 0.5 * pi, out);
  check_number(c.lead_threads, "the threads in the lead", 100, out);
  check_number(c.life_used_min, "the life used", 1e6, out);
  for (const model::HolderSegment& s : c.holder) {
    check_number(s.height_mm, "a holder segment's height", kLongestMm, out);
    check_number(s.lower_diameter_mm, "a holder segment's diameter", kLongestMm, out);
    check_number(s.upper_diameter_mm, "a holder segment's diameter", kLongestMm, out);
  }
  if (out.empty()) check_together(c, out);
  return out;
}

std::string unlikely_of(const Cutter& c) {
  // default, unsourced: beyond these only face mills, discs and bored-in heads are common
  constexpr double kWideMm = 100.0, kLongFlutesMm = 300.0;
  const bool wide = c.cutter_class == CutterClass::kFacemill || c.cutter_class == CutterClass::kSideMill ||
                    c.cutter_class == CutterClass::kBoringTool || c.cutter_class == CutterClass::kGunDrill;
  if (c.cutting_diameter_mm > kWideMm && !wide)
    return "a diameter of " + mm(c.cutting_diameter_mm) + " is unlikely for a " +
           std::string(model::to_text(c.cutter_class));
  if (c.maximum_depth_of_cut_mm > kLongFlutesMm && c.cutter_class != CutterClass::kGunDrill)
    return "flutes of " + mm(c.maximum_depth_of_cut_mm) + " are unlikely";
  return {};
}

std::vector<Diagnostic> check_cutters(const std::vector<Cutter>& cutters, const std::string& file,
                                      const std::vector<std::uint64_t>& lines) {
  std::vector<Diagnostic> out;
  std::map<std::string, std::size_t> ids;
  std::map<int, std::size_t> numbers;
  for (std::size_t i = 0; i < cutters.size(); ++i) {
    const Cutter& c = cutters[i];
    const std::uint64_t line = i < lines.size() ? lines[i] : 0;
    for (std::string& what : faults_of(c))
      out.push_back(
          {.code = "TOOL-VALUE", .message = std::move(what), .file = file, .line = line, .path = c.id});
    if (c.id.empty())
      out.push_back({.code = "TOOL-ID", .message = "a tool has no id", .file = file, .line = line});
    if (!ids.emplace(c.id, i).second)
      out.push_back({.code = "TOOL-ID",
                     .message = "the id '" + c.id + "' is given twice",
                     .file = file,
                     .line = line,
                     .path = c.id});
    if (c.pocket > 0) {
      const auto [it, fresh] = numbers.emplace(c.pocket, i);
      if (!fresh)
        out.push_back({.code = "TOOL-NUMBER",
                       .message = "tool number " + std::to_string(c.pocket) + " is given twice, first to '" +
                                  cutters[it->second].id + "'",
                       .file = file,
                       .line = line,
                       .path = c.id});
    }
  }
  return out;
}

}  // namespace capstan::tooling
