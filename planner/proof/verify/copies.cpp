#include "planner/proof/verify/copies.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace capstan::verify {

using model::CutterClass;

namespace {

constexpr int kFinishingRank = 4;

}  // namespace

bool undercuts(CutterClass c) {
  switch (c) {
    case CutterClass::kTSlotMill:
    case CutterClass::kDovetailMill:
    case CutterClass::kBackCounterbore:
    case CutterClass::kBackCountersink:
    case CutterClass::kSideMill:
      return true;
    default:
      return false;
  }
}

bool under_overhangs(CutterClass c) {
  return c == CutterClass::kTSlotMill || c == CutterClass::kDovetailMill ||
         c == CutterClass::kBackCountersink;
}

bool sizes_hole(CutterClass c) {
  return c == CutterClass::kTwistDrill || c == CutterClass::kGunDrill || c == CutterClass::kReamer ||
         c == CutterClass::kTap;
}

bool breaks_edges(CutterClass c) { return c == CutterClass::kChamferMill || c == CutterClass::kCountersink; }

bool cuts_by_point(CutterClass c) {
  switch (c) {
    case CutterClass::kCenterDrill:
    case CutterClass::kSpotDrill:
    case CutterClass::kCountersink:
    case CutterClass::kBackCountersink:
    case CutterClass::kChamferMill:
      return true;
    default:
      return false;
  }
}

bool mills(CutterClass c) {
  switch (c) {
    case CutterClass::kTwistDrill:
    case CutterClass::kCenterDrill:
    case CutterClass::kSpotDrill:
    case CutterClass::kGunDrill:
    case CutterClass::kReamer:
    case CutterClass::kTap:
    case CutterClass::kBoringTool:
    case CutterClass::kCountersink:
    case CutterClass::kTouchProbe:
      return false;
    default:
      return true;
  }
}

int order_rank(model::TypeId op) {
  using model::TypeId;
  switch (op) {
    case TypeId::kCenterDrilling:
      return 1;
    case TypeId::kDrilling:
    case TypeId::kMultistepDrilling:
      return 2;
    case TypeId::kPlaneRoughMilling:
    case TypeId::kSideRoughMilling:
    case TypeId::kBottomAndSideRoughMilling:
    case TypeId::kFreeformRoughMilling:
      return 3;
    case TypeId::kPlaneFinishMilling:
    case TypeId::kSideFinishMilling:
    case TypeId::kBottomAndSideFinishMilling:
    case TypeId::kFreeformFinishMilling:
      return kFinishingRank;
    case TypeId::kBoring:
    case TypeId::kReaming:
    case TypeId::kBackBoring:
    case TypeId::kTapping:
    case TypeId::kThreadDrilling:
      return 5;
    default:
      return 0;
  }
}

bool finishes(model::TypeId op) { return order_rank(op) == kFinishingRank; }

bool mills_threads(CutterClass c) { return c == CutterClass::kThreadMill; }

double speed_by_arc(double width_ratio, const std::string& group) {
  constexpr double kWidth[] = {0.05, 0.1, 0.15, 0.2, 0.25, 0.3, 0.4, 0.5};
  constexpr double kSpeed[] = {1.48, 1.35, 1.27, 1.22, 1.19, 1.16, 1.11, 1.0};
  if (group != "P" && group != "M" && group != "K") return 1.0;
  double speed = 1.0;
  for (int i = 0; i + 1 < 8; ++i) {
    if (width_ratio < kWidth[i] || width_ratio >= kWidth[i + 1]) continue;
    speed = kSpeed[i] + (width_ratio - kWidth[i]) / (kWidth[i + 1] - kWidth[i]) * (kSpeed[i + 1] - kSpeed[i]);
  }
  if (width_ratio > 0.0 && width_ratio < kWidth[0]) speed = kSpeed[0];
  return speed;
}

double usual_ramp(const model::Cutter& c, const std::string& group) {
  double degrees = 3.0;
  if (group == "N") degrees = 10.0;
  if (c.substrate == model::Substrate::kCarbide && (group == "P" || group == "K")) degrees = 5.0;
  return std::min(c.maximum_ramp_angle_rad, degrees / 180.0 * std::numbers::pi);
}

geometry::CutterProfile outline_of(const model::Cutter& c) {
  const double d = c.cutting_diameter_mm, high = c.maximum_depth_of_cut_mm;
  const auto widening = [&](double lean) {
    return geometry::cone_profile(d + 2.0 * high * std::tan(lean), 2.0 * lean, high, d);
  };
  switch (c.cutter_class) {
    case CutterClass::kTwistDrill:
    case CutterClass::kCenterDrill:
    case CutterClass::kSpotDrill:
    case CutterClass::kGunDrill:
    case CutterClass::kCountersink:
    case CutterClass::kChamferMill:
      if (c.point_angle_rad > 0.0)
        return geometry::cone_profile(d, c.point_angle_rad, high, c.tip_diameter_mm);
      break;
    case CutterClass::kTaperedEndmill:  // its diameter is that of the tip
      if (c.taper_angle_rad > 0.0) return widening(c.taper_angle_rad);
      break;
    case CutterClass::kFacemill:  // ISO 13399: DC is measured at the tip, DCX = DC + 2 APMX tan PSIR
      if (c.lead_angle_rad > 0.0 && high > 0.0) return widening(c.lead_angle_rad);
      break;
    case CutterClass::kBallEndmill:
      return geometry::ball_profile(d, high);
    default:
      break;
  }
  return geometry::bull_profile(d, c.corner_radius_mm, high);
}

}  // namespace capstan::verify
