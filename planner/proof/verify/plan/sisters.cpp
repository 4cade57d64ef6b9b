#include <cmath>
#include <string>

#include "planner/proof/verify/plan/plan_checks.h"

// Tools that take another one's place when its life is used up.

namespace capstan::verify {
namespace {

/// Diameters are measured to a micrometre at best.
constexpr double kSameMm = 0.001;
constexpr double kLengthRoomMm = 0.01, kSameRad = 1e-6;

/// What tells a sister from its tool; empty: nothing that cuts or collides.
std::string differs(const model::Cutter& a, const model::Cutter& b) {
  const auto off = [](double x, double y, double by) { return std::abs(x - y) > by; };
  if (a.cutter_class != b.cutter_class || a.teeth != b.teeth || a.hand != b.hand) return "its kind";
  if (off(a.cutting_diameter_mm, b.cutting_diameter_mm, kSameMm))
    return "its diameter, " + mm(a.cutting_diameter_mm) + " in place of " + mm(b.cutting_diameter_mm);
  if (off(a.corner_radius_mm, b.corner_radius_mm, kSameMm) ||
      off(a.tip_diameter_mm, b.tip_diameter_mm, kSameMm) ||
      off(a.point_angle_rad, b.point_angle_rad, kSameRad) ||
      off(a.taper_angle_rad, b.taper_angle_rad, kSameRad) ||
      off(a.thread_pitch_mm, b.thread_pitch_mm, kSameRad))
    return "the shape of its edges";
  if (off(a.stick_out_mm, b.stick_out_mm, kLengthRoomMm) ||
      off(a.usable_length_mm, b.usable_length_mm, kLengthRoomMm) ||
      off(a.maximum_depth_of_cut_mm, b.maximum_depth_of_cut_mm, kLengthRoomMm) ||
      off(a.shank_diameter_mm, b.shank_diameter_mm, kLengthRoomMm) ||
      off(a.holder_diameter_mm, b.holder_diameter_mm, kLengthRoomMm) || a.holder != b.holder)
    return "how it is held";
  return {};
}

}  // namespace

void check_sisters(const model::Plan& plan, Findings& findings) {
  for (const model::Cutter& c : plan.cutters) {
    for (const model::SisterTool& s : c.sisters) {
      const model::Cutter* tool = model::find_cutter(plan, s.id);
      if (tool == nullptr) continue;  // a piece on the shelf
      const std::string pair = "tool " + c.id + " takes the place of " + tool->id;
      if (c.pocket <= 0 || c.pocket == tool->pocket) {
        findings.error(30, "CHK-SISTER", {0, {}, -1},
                       pair + " and is not loaded under a number of its own: load it, or take it out");
      } else if (const std::string what = differs(c, *tool); !what.empty()) {
        findings.error(30, "CHK-SISTER", {0, {}, -1},
                       pair + " and differs by " + what + ": load one of the same sizes");
      } else if (const std::string fault = model::offset_fault(c); !fault.empty()) {
        findings.error(30, "CHK-SISTER", {0, {}, -1}, pair + ": " + fault);
      }
    }
  }
}

}  // namespace capstan::verify
