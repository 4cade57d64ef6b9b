#include "planner/proof/verify/copies.h"

namespace capstan::verify {

using model::CutterClass;

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

bool finishes(model::TypeId op) {
  using model::TypeId;
  return op == TypeId::kSideFinishMilling || op == TypeId::kBottomAndSideFinishMilling ||
         op == TypeId::kPlaneFinishMilling || op == TypeId::kFreeformFinishMilling;
}

}  // namespace capstan::verify
