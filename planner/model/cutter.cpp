#include "planner/model/cutter.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace capstan::model {
namespace {

constexpr std::array<std::string_view, 23> kClasses = {"endmill",
                                                       "bullnose_endmill",
                                                       "ball_endmill",
                                                       "facemill",
                                                       "twist_drill",
                                                       "center_drill",
                                                       "spotdrill",
                                                       "reamer",
                                                       "tap",
                                                       "thread_mill",
                                                       "boring_tool",
                                                       "countersink",
                                                       "counterbore",
                                                       "chamfer_mill",
                                                       "t_slot_mill",
                                                       "dovetail_mill",
                                                       "gun_drill",
                                                       "back_counterbore",
                                                       "back_countersink",
                                                       "corner_rounding_mill",
                                                       "tapered_endmill",
                                                       "side_mill",
                                                       "touch_probe"};
static_assert(kClasses.size() == static_cast<std::size_t>(kLastCutterClass) + 1);
constexpr std::array<std::string_view, 2> kSubstrates = {"hss", "carbide"};

template <class E, std::size_t N>
std::optional<E> from_text(const std::array<std::string_view, N>& names, std::string_view text) {
  const auto it = std::find(names.begin(), names.end(), text);
  if (it == names.end()) return std::nullopt;
  return static_cast<E>(it - names.begin());
}

bool has_cone(const Cutter& c) {
  switch (c.cutter_class) {
    case CutterClass::kTwistDrill:
    case CutterClass::kCenterDrill:
    case CutterClass::kSpotDrill:
    case CutterClass::kCountersink:
    case CutterClass::kChamferMill:
    case CutterClass::kGunDrill:
      return c.point_angle_rad > 0.0;
    default:
      return false;
  }
}

}  // namespace

std::string_view to_text(CutterClass c) { return kClasses.at(static_cast<std::size_t>(c)); }
std::optional<CutterClass> cutter_class_from_text(std::string_view text) {
  return from_text<CutterClass>(kClasses, text);
}
std::string_view to_text(Substrate s) { return kSubstrates.at(static_cast<std::size_t>(s)); }
std::optional<Substrate> substrate_from_text(std::string_view text) {
  return from_text<Substrate>(kSubstrates, text);
}

geometry::CutterProfile profile_of(const Cutter& c) {
  const double length = c.maximum_depth_of_cut_mm;
  if (has_cone(c)) {
    return geometry::cone_profile(c.cutting_diameter_mm, c.point_angle_rad, length, c.tip_diameter_mm);
  }
  if (c.cutter_class == CutterClass::kTaperedEndmill && c.taper_angle_rad > 0.0) {
    // From a flat tip, whatever its corner: what it cuts besides lies below the real cutter's.
    const double top = c.cutting_diameter_mm + 2.0 * length * std::tan(c.taper_angle_rad);
    return geometry::cone_profile(top, 2.0 * c.taper_angle_rad, length, c.cutting_diameter_mm);
  }
  if (c.cutter_class == CutterClass::kFacemill && c.lead_angle_rad > 0.0 && length > 0.0) {
    // DC is measured at the tip, the inserts lean outwards (ISO 13399: DCX = DC + 2 APMX tan PSIR). Their
    // corners' rounding is left out: what is cut besides lies below the real cutter's.
    const double top = c.cutting_diameter_mm + 2.0 * length * std::tan(c.lead_angle_rad);
    return geometry::cone_profile(top, 2.0 * c.lead_angle_rad, length, c.cutting_diameter_mm);
  }
  if (c.cutter_class == CutterClass::kBallEndmill)
    return geometry::ball_profile(c.cutting_diameter_mm, length);
  return geometry::bull_profile(c.cutting_diameter_mm, c.corner_radius_mm, length);
}

double tip_length(const Cutter& c) { return profile_of(c).height(0.5 * c.cutting_diameter_mm); }

}  // namespace capstan::model
