#include "planner/ground/vocabulary/cutter_class.h"

#include <algorithm>
#include <array>

namespace capstan::model {
namespace {

constexpr std::uint32_t bit(CutterTrait t) { return static_cast<std::uint32_t>(t); }

constexpr std::uint32_t kAxis = bit(CutterTrait::kAlongAxis);
constexpr std::uint32_t kEnd = bit(CutterTrait::kEndMill);
constexpr std::uint32_t kSolid = bit(CutterTrait::kOpensSolid);
constexpr std::uint32_t kSizes = bit(CutterTrait::kSizesHole);
constexpr std::uint32_t kThread = bit(CutterTrait::kThreads);
constexpr std::uint32_t kUnder = bit(CutterTrait::kUndercuts);
constexpr std::uint32_t kSlot = bit(CutterTrait::kSlotForm);
constexpr std::uint32_t kSink = bit(CutterTrait::kSinks);
constexpr std::uint32_t kLay = bit(CutterTrait::kLayers);
constexpr std::uint32_t kBall = bit(CutterTrait::kBall);
constexpr std::uint32_t kRamp = bit(CutterTrait::kRamps);
constexpr std::uint32_t kDrill = bit(CutterTrait::kDrills);
constexpr std::uint32_t kMark = bit(CutterTrait::kMarks);
constexpr std::uint32_t kCentre = bit(CutterTrait::kToCentre);
constexpr std::uint32_t kAngle = bit(CutterTrait::kPointAngle);
constexpr std::uint32_t kPoint = bit(CutterTrait::kCone) | kAngle;
constexpr std::uint32_t kLess = bit(CutterTrait::kSmallerDoes);
constexpr std::uint32_t kWide = bit(CutterTrait::kWide);
constexpr std::uint32_t kNeck = bit(CutterTrait::kNecked);

using C = CutterClass;
using M = CutterMust;
using T = TypeId;
constexpr std::array kRows{
    CutterClassRow{C::kEndmill, "endmill", "end mill", kEnd | kLay | kRamp | kLess, M::kNothing, T::kEndmill,
                   "flat end mill", "Endmill", C::kEndmill},
    CutterClassRow{C::kBullnoseEndmill, "bullnose_endmill", "bull-nose end mill", kEnd | kLay | kRamp | kLess,
                   M::kCornerRadius, T::kBullnoseEndmill, "bull nose end mill", "Bullnose",
                   C::kBullnoseEndmill},
    CutterClassRow{C::kBallEndmill, "ball_endmill", "ball end mill", kBall | kLay | kRamp | kLess,
                   M::kNothing, T::kBallEndmill, "ball end mill", "Ballend", C::kBallEndmill},
    CutterClassRow{C::kFacemill, "facemill", "face mill", kLay | kLess | kWide, M::kNothing, T::kFacemill,
                   "face mill", "", C::kEndmill},
    CutterClassRow{C::kTwistDrill, "twist_drill", "twist drill",
                   kAxis | kSolid | kSizes | kPoint | kDrill | kCentre, M::kNothing, T::kTwistDrill, "drill",
                   "Drill", C::kTwistDrill},
    CutterClassRow{C::kCenterDrill, "center_drill", "centre drill", kAxis | kSolid | kPoint | kMark | kCentre,
                   M::kNothing, T::kCenterDrill, "center drill", "", C::kTwistDrill},
    CutterClassRow{C::kSpotDrill, "spotdrill", "spot drill", kAxis | kSolid | kPoint | kMark | kCentre,
                   M::kNothing, T::kCenterDrill, "spot drill", "", C::kTwistDrill},
    CutterClassRow{C::kReamer, "reamer", "reamer", kAxis | kSizes, M::kNothing, T::kReamer, "reamer",
                   "Reamer", C::kReamer},
    CutterClassRow{C::kTap, "tap", "tap", kAxis | kSizes | kThread, M::kPitch, T::kTap, "tap right hand",
                   "Tap", C::kTap},
    CutterClassRow{C::kThreadMill, "thread_mill", "thread mill", kThread, M::kPitch, T::kThreadMill,
                   "thread mill", "ThreadMill", C::kThreadMill},
    CutterClassRow{C::kBoringTool, "boring_tool", "boring tool", kAxis | kWide, M::kNothing, T::kBoringTool,
                   "boring bar", "", C::kBoringTool},
    CutterClassRow{C::kCountersink, "countersink", "countersink", kAxis | kPoint | kSink, M::kConeAngle,
                   T::kCountersink, "counter sink", "", C::kChamferMill},
    CutterClassRow{C::kCounterbore, "counterbore", "counterbore", kAxis, M::kNothing, T::kCounterbore,
                   "counter bore", "", C::kEndmill},
    CutterClassRow{C::kChamferMill, "chamfer_mill", "chamfer mill", kPoint | kSink, M::kConeAngle,
                   T::kCountersink, "chamfer mill", "Chamfer", C::kChamferMill},
    CutterClassRow{C::kTSlotMill, "t_slot_mill", "T-slot cutter", kUnder | kSlot | kNeck, M::kNothing,
                   T::kTSlotMill, "slot mill", "", C::kTSlotMill},
    CutterClassRow{C::kDovetailMill, "dovetail_mill", "dovetail cutter", kUnder | kSlot | kNeck, M::kNothing,
                   T::kDovetailMill, "dovetail mill", "Dovetail", C::kDovetailMill},
    CutterClassRow{C::kGunDrill, "gun_drill", "gun drill", kAxis | kSolid | kSizes | kPoint | kDrill | kWide,
                   M::kNothing, T::kTwistDrill, "", "", C::kTwistDrill},
    CutterClassRow{C::kBackCounterbore, "back_counterbore", "back counterbore", kAxis | kUnder, M::kNothing,
                   T::kBacksideCounterbore, "", "", C::kBackCounterbore},
    CutterClassRow{C::kBackCountersink, "back_countersink", "back countersink",
                   kAxis | kUnder | kNeck | kAngle, M::kConeAngle, T::kBacksideCountersink, "", "",
                   C::kBackCountersink},
    CutterClassRow{C::kCornerRoundingMill, "corner_rounding_mill", "corner rounding mill", kLess | kNeck,
                   M::kNothing, T::kUserDefinedTool, "radius mill", "Radius", C::kCornerRoundingMill},
    CutterClassRow{C::kTaperedEndmill, "tapered_endmill", "tapered end mill", kLess, M::kTaper,
                   T::kTaperedEndmill, "tapered mill", "TaperedBallNose", C::kTaperedEndmill},
    CutterClassRow{C::kSideMill, "side_mill", "side mill", kWide, M::kNothing, T::kSideMill, "",
                   "SlittingSaw", C::kTSlotMill},
    CutterClassRow{C::kTouchProbe, "touch_probe", "touch probe", 0, M::kNothing, T::kNone, "probe", "Probe",
                   C::kTouchProbe},
};

struct Called {
  std::string_view text;
  CutterClass value;
};
/// What comments call a cutter. The first that occurs decides, so the more telling come first ("ball probe"
/// is no ball end mill, "tap drill" is a drill, "thread mill" no end mill). A class that is not here is
/// called by its words.
constexpr std::array kCalled{
    Called{"probe", C::kTouchProbe},
    Called{"gun drill", C::kGunDrill},
    Called{"corner round", C::kCornerRoundingMill},
    Called{"tapered", C::kTaperedEndmill},
    Called{"side mill", C::kSideMill},
    Called{"slitting saw", C::kSideMill},
    Called{"back counterbore", C::kBackCounterbore},
    Called{"back countersink", C::kBackCountersink},
    Called{"thread mill", C::kThreadMill},
    Called{"threadmill", C::kThreadMill},
    Called{"t-slot", C::kTSlotMill},
    Called{"tslot", C::kTSlotMill},
    Called{"dovetail", C::kDovetailMill},
    Called{"counterbore", C::kCounterbore},
    Called{"countersink", C::kCountersink},
    Called{"senker", C::kCountersink},
    Called{"chamfer", C::kChamferMill},
    Called{"v-bit", C::kChamferMill},
    Called{"vbit", C::kChamferMill},
    Called{"reamer", C::kReamer},
    Called{"reibahle", C::kReamer},
    Called{"alargador", C::kReamer},
    Called{"boring", C::kBoringTool},
    Called{"spot", C::kSpotDrill},
    Called{"center drill", C::kCenterDrill},
    Called{"centre drill", C::kCenterDrill},
    Called{"centerdrill", C::kCenterDrill},
    Called{"zentrierbohrer", C::kCenterDrill},
    Called{"gewindebohrer", C::kTap},
    Called{"drill", C::kTwistDrill},
    Called{"bohrer", C::kTwistDrill},
    Called{"broca", C::kTwistDrill},
    Called{"face mill", C::kFacemill},
    Called{"facemill", C::kFacemill},
    Called{"shell mill", C::kFacemill},
    Called{"planfr", C::kFacemill},
    Called{"ball", C::kBallEndmill},
    Called{"kugelfr", C::kBallEndmill},
    Called{"bull", C::kBullnoseEndmill},
    Called{"end mill", C::kEndmill},
    Called{"endmill", C::kEndmill},
    Called{"schaftfr", C::kEndmill},
    Called{"fresa", C::kEndmill},
    Called{"tap", C::kTap},
};

constexpr bool in_order() {
  for (std::size_t i = 0; i < kRows.size(); ++i) {
    if (static_cast<std::size_t>(kRows[i].value) != i) return false;
  }
  return kRows.size() == static_cast<std::size_t>(kLastCutterClass) + 1;
}
static_assert(in_order());

constexpr std::array<std::string_view, 2> kSubstrates = {"hss", "carbide"};

}  // namespace

std::span<const CutterClassRow> cutter_classes() { return kRows; }
const CutterClassRow& row_of(CutterClass c) { return kRows.at(static_cast<std::size_t>(c)); }
bool has(CutterClass c, CutterTrait t) { return (row_of(c).traits & bit(t)) != 0; }
std::string_view to_text(CutterClass c) { return row_of(c).name; }
std::string_view words_of(CutterClass c) { return row_of(c).words; }

std::optional<CutterClass> cutter_class_from_text(std::string_view text) {
  const auto it =
      std::find_if(kRows.begin(), kRows.end(), [&](const CutterClassRow& r) { return r.name == text; });
  return it == kRows.end() ? std::nullopt : std::optional(it->value);
}

std::optional<CutterClass> cutter_class_called(std::string_view lower_comment) {
  const auto occurs = [&](std::string_view word) {
    return lower_comment.find(word) != std::string_view::npos;
  };
  const auto has_own_word = [](CutterClass c) {
    return std::any_of(kCalled.begin(), kCalled.end(), [&](const Called& k) { return k.value == c; });
  };
  for (const CutterClassRow& r : kRows)
    if (!has_own_word(r.value) && occurs(r.words)) return r.value;
  for (const Called& k : kCalled)
    if (occurs(k.text)) return k.value;
  return std::nullopt;
}

std::string_view words_of(CutterMust m) {
  constexpr std::array<std::string_view, 5> kWords = {"", "a pitch", "a corner radius",
                                                      "the angle of its cone", "its angle"};
  return kWords.at(static_cast<std::size_t>(m));
}

std::string_view to_text(Substrate s) { return kSubstrates.at(static_cast<std::size_t>(s)); }
std::optional<Substrate> substrate_from_text(std::string_view text) {
  const auto it = std::find(kSubstrates.begin(), kSubstrates.end(), text);
  if (it == kSubstrates.end()) return std::nullopt;
  return static_cast<Substrate>(it - kSubstrates.begin());
}

}  // namespace capstan::model
