#include "planner/ground/vocabulary/cutter_class.h"

#include <algorithm>
#include <array>

namespace capstan::model {
namespace {

constexpr std::uint16_t bit(CutterTrait t) { return static_cast<std::uint16_t>(t); }

constexpr std::uint16_t kAxis = bit(CutterTrait::kAlongAxis);
constexpr std::uint16_t kEnd = bit(CutterTrait::kEndMill);
constexpr std::uint16_t kSolid = bit(CutterTrait::kOpensSolid);
constexpr std::uint16_t kSizes = bit(CutterTrait::kSizesHole);
constexpr std::uint16_t kThread = bit(CutterTrait::kThreads);
constexpr std::uint16_t kUnder = bit(CutterTrait::kUndercuts);
constexpr std::uint16_t kSlot = bit(CutterTrait::kSlotForm);
constexpr std::uint16_t kCone = bit(CutterTrait::kCone);
constexpr std::uint16_t kSink = bit(CutterTrait::kSinks);

using C = CutterClass;
constexpr std::array<CutterClassRow, 23> kRows{{
    {C::kEndmill, "endmill", "end mill", kEnd, "flat end mill", "Endmill"},
    {C::kBullnoseEndmill, "bullnose_endmill", "bull-nose end mill", kEnd, "bull nose end mill", "Bullnose"},
    {C::kBallEndmill, "ball_endmill", "ball end mill", 0, "ball end mill", "Ballend"},
    {C::kFacemill, "facemill", "face mill", 0, "face mill", ""},
    {C::kTwistDrill, "twist_drill", "twist drill", kAxis | kSolid | kSizes | kCone, "drill", "Drill"},
    {C::kCenterDrill, "center_drill", "centre drill", kAxis | kSolid | kCone, "center drill", ""},
    {C::kSpotDrill, "spotdrill", "spot drill", kAxis | kSolid | kCone, "spot drill", ""},
    {C::kReamer, "reamer", "reamer", kAxis | kSizes, "reamer", "Reamer"},
    {C::kTap, "tap", "tap", kAxis | kSizes | kThread, "tap right hand", "Tap"},
    {C::kThreadMill, "thread_mill", "thread mill", kThread, "thread mill", "ThreadMill"},
    {C::kBoringTool, "boring_tool", "boring tool", kAxis, "boring bar", ""},
    {C::kCountersink, "countersink", "countersink", kAxis | kCone | kSink, "counter sink", ""},
    {C::kCounterbore, "counterbore", "counterbore", kAxis, "counter bore", ""},
    {C::kChamferMill, "chamfer_mill", "chamfer mill", kCone | kSink, "chamfer mill", "Chamfer"},
    {C::kTSlotMill, "t_slot_mill", "T-slot cutter", kUnder | kSlot, "slot mill", ""},
    {C::kDovetailMill, "dovetail_mill", "dovetail cutter", kUnder | kSlot, "dovetail mill", "Dovetail"},
    {C::kGunDrill, "gun_drill", "gun drill", kAxis | kSolid | kSizes | kCone, "", ""},
    {C::kBackCounterbore, "back_counterbore", "back counterbore", kAxis | kUnder, "", ""},
    {C::kBackCountersink, "back_countersink", "back countersink", kAxis | kUnder, "", ""},
    {C::kCornerRoundingMill, "corner_rounding_mill", "corner rounding mill", 0, "radius mill", "Radius"},
    {C::kTaperedEndmill, "tapered_endmill", "tapered end mill", 0, "tapered mill", "TaperedBallNose"},
    {C::kSideMill, "side_mill", "side mill", 0, "", "SlittingSaw"},
    {C::kTouchProbe, "touch_probe", "touch probe", 0, "probe", "Probe"},
}};

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

std::string_view to_text(Substrate s) { return kSubstrates.at(static_cast<std::size_t>(s)); }
std::optional<Substrate> substrate_from_text(std::string_view text) {
  const auto it = std::find(kSubstrates.begin(), kSubstrates.end(), text);
  if (it == kSubstrates.end()) return std::nullopt;
  return static_cast<Substrate>(it - kSubstrates.begin());
}

}  // namespace capstan::model
