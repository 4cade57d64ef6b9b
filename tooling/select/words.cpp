#include <algorithm>
#include <numbers>

#include "planner/ground/base/number.h"
#include "tooling/select/limits.h"
#include "tooling/select/select.h"

namespace capstan::tooling {
namespace {

using model::CutterClass;
using model::ToolRequirement;

std::string mm(double v) { return trimmed(v, 3) + " mm"; }
std::string degrees(double rad) { return trimmed(rad * 180.0 / std::numbers::pi, 1) + " deg"; }

}  // namespace

std::string_view words_of(CutterClass c) {
  switch (c) {
    case CutterClass::kEndmill:
      return "end mill";
    case CutterClass::kBullnoseEndmill:
      return "bull-nose end mill";
    case CutterClass::kBallEndmill:
      return "ball end mill";
    case CutterClass::kFacemill:
      return "face mill";
    case CutterClass::kTwistDrill:
      return "twist drill";
    case CutterClass::kCenterDrill:
      return "centre drill";
    case CutterClass::kSpotDrill:
      return "spot drill";
    case CutterClass::kReamer:
      return "reamer";
    case CutterClass::kTap:
      return "tap";
    case CutterClass::kThreadMill:
      return "thread mill";
    case CutterClass::kBoringTool:
      return "boring tool";
    case CutterClass::kCountersink:
      return "countersink";
    case CutterClass::kCounterbore:
      return "counterbore";
    case CutterClass::kChamferMill:
      return "chamfer mill";
    case CutterClass::kTSlotMill:
      return "T-slot cutter";
    case CutterClass::kDovetailMill:
      return "dovetail cutter";
    case CutterClass::kGunDrill:
      return "gun drill";
    case CutterClass::kBackCounterbore:
      return "back counterbore";
    case CutterClass::kBackCountersink:
      return "back countersink";
    case CutterClass::kCornerRoundingMill:
      return "corner rounding mill";
    case CutterClass::kTaperedEndmill:
      return "tapered end mill";
    case CutterClass::kSideMill:
      return "side mill";
    case CutterClass::kTouchProbe:
      return "touch probe";
  }
  return "cutter";
}

std::string words_of(const ToolRequirement& r) {
  const bool vowel = r.diameter_exact_mm <= 0.0 && (lower_size(r) <= 0.0 || upper_size(r) <= 0.0) &&
                     !r.classes.empty() && r.classes.front() == CutterClass::kEndmill;
  std::string out = vowel ? "an " : "a ";
  const double low = lower_size(r), high = upper_size(r);
  if (r.diameter_exact_mm > 0.0)
    out += mm(r.diameter_exact_mm) + " ";
  else if (low > 0.0 && high > 0.0)
    out += mm(low) + " to " + mm(high) + " ";
  for (std::size_t i = 0; i < r.classes.size(); ++i)
    out += (i == 0 ? "" : " or ") + std::string(words_of(r.classes[i]));
  if (r.classes.empty()) out += "cutter";
  if (r.diameter_exact_mm <= 0.0 && low <= 0.0 && high > 0.0) out += " of at most " + mm(high);
  if (low > 0.0 && high <= 0.0) out += " of at least " + mm(low);
  std::string with;
  const auto add = [&](const std::string& text) { with += (with.empty() ? " with " : ", ") + text; };
  if (r.thread_size_mm > 0.0) add("threads of " + mm(r.thread_size_mm));
  if (r.thread_pitch_mm > 0.0) add(mm(r.thread_pitch_mm) + " pitch");
  if (!r.thread_form.empty()) add("form " + r.thread_form);
  if (r.taper_angle_rad > 0.0) add(degrees(r.taper_angle_rad) + " taper");
  if (r.point_angle_rad > 0.0) add(degrees(r.point_angle_rad) + " point");
  if (r.corner_radius_exact_mm >= 0.0) add(mm(r.corner_radius_exact_mm) + " corner radius");
  if (r.corner_radius_limited) add("at most " + mm(r.corner_radius_max_mm) + " corner radius");
  if (r.cutting_width_min_mm > 0.0 && r.cutting_width_max_mm > 0.0) {
    add(mm(r.cutting_width_min_mm) + " to " + mm(r.cutting_width_max_mm) + " width");
  } else if (r.cutting_width_max_mm > 0.0) {
    add("at most " + mm(r.cutting_width_max_mm) + " width");
  } else if (r.cutting_width_min_mm > 0.0) {
    add("at least " + mm(r.cutting_width_min_mm) + " width");
  }
  if (r.neck_diameter_max_mm > 0.0) add("a neck of at most " + mm(r.neck_diameter_max_mm));
  if (r.neck_step_min_mm > 0.0) {
    add(high > r.neck_step_min_mm ? "a neck of at most " + mm(high - r.neck_step_min_mm) + " (" +
                                        mm(r.neck_step_min_mm) + " below its head)"
                                  : "a neck " + mm(r.neck_step_min_mm) + " below its head");
  }
  if (r.tip_diameter_max_mm > 0.0) add("a tip of at most " + mm(r.tip_diameter_max_mm));
  if (const double flutes = flutes_wanted(r); flutes > 0.0) add(mm(flutes) + " flutes");
  if (r.reach_mm > 0.0) add(mm(r.reach_mm) + " reach");
  if (r.centre_cutting) with += ", cutting to centre or ramping";
  if (r.coolant_through) with += ", with coolant through it";
  if (r.left_hand) with += ", left-hand";
  return out + with;
}

}  // namespace capstan::tooling
