#include "tooling/library/formats/fusion/keys.h"

#include "tooling/library/formats/values.h"

namespace capstan::tooling::fusion {
namespace {

using model::CutterClass;

constexpr std::array<std::pair<std::string_view, CutterClass>, 21> kTypes{{
    {"flat end mill", CutterClass::kEndmill},
    {"bull nose end mill", CutterClass::kBullnoseEndmill},
    {"ball end mill", CutterClass::kBallEndmill},
    {"face mill", CutterClass::kFacemill},
    {"drill", CutterClass::kTwistDrill},
    {"center drill", CutterClass::kCenterDrill},
    {"spot drill", CutterClass::kSpotDrill},
    {"reamer", CutterClass::kReamer},
    {"tap right hand", CutterClass::kTap},
    {"tap left hand", CutterClass::kTap},
    {"thread mill", CutterClass::kThreadMill},
    {"boring bar", CutterClass::kBoringTool},
    {"boring head", CutterClass::kBoringTool},
    {"counter sink", CutterClass::kCountersink},
    {"counter bore", CutterClass::kCounterbore},
    {"chamfer mill", CutterClass::kChamferMill},
    {"slot mill", CutterClass::kTSlotMill},
    {"dovetail mill", CutterClass::kDovetailMill},
    {"radius mill", CutterClass::kCornerRoundingMill},
    {"tapered mill", CutterClass::kTaperedEndmill},
    {"probe", CutterClass::kTouchProbe},
}};
/// Known, but of no use to planning.
constexpr std::array<std::string_view, 10> kOtherTypes{"circle segment barrel",
                                                       "circle segment lens",
                                                       "circle segment oval",
                                                       "circle segment taper",
                                                       "form mill",
                                                       "lollipop mill",
                                                       "waterjet",
                                                       "plasma cutter",
                                                       "laser cutter",
                                                       "thread forming tap"};

}  // namespace

double preset_factor(char unit, bool inches) {
  switch (unit) {
    case 'L':
      return inches ? kMmPerInch : 1.0;
    case 'V':
      return inches ? kMetresPerFoot : 1.0;
    case 'D':
      return kRadPerDegree;
    default:
      return 1.0;
  }
}

std::optional<CutterClass> class_of(std::string_view type) {
  for (const auto& [name, c] : kTypes)
    if (name == type) return c;
  return std::nullopt;
}

std::optional<std::string_view> type_of(CutterClass c, bool left_hand) {
  if (c == CutterClass::kTap) return left_hand ? "tap left hand" : "tap right hand";
  if (c == CutterClass::kGunDrill) return "drill";
  if (c == CutterClass::kSideMill) return "slot mill";
  for (const auto& [name, k] : kTypes)
    if (k == c) return name;
  return std::nullopt;
}

bool is_type(std::string_view text) {
  if (class_of(text)) return true;
  for (const auto t : kOtherTypes)
    if (t == text) return true;
  return false;
}

}  // namespace capstan::tooling::fusion
