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

constexpr CutterMust states(std::string_view field, std::string_view words) { return {field, words}; }
constexpr CutterMust kNothing{};
constexpr CutterMust kPitch = states("thread_pitch_mm", "a pitch");
constexpr CutterMust kCornerRadius = states("corner_radius_mm", "a corner radius");
constexpr CutterMust kConeAngle = states("point_angle_rad", "the angle of its cone");
constexpr CutterMust kTaper = states("taper_angle_rad", "its angle");

using C = CutterClass;
using T = TypeId;
constexpr std::array kRows{
#define CAPSTAN_CUTTER_CLASS(value, name, words, traits, must, body, fusion, freecad, stand_in) \
  CutterClassRow{C::value, name, words, traits, must, T::body, fusion, freecad, C::stand_in},
#include "planner/ground/vocabulary/cutter_classes.inc"
#undef CAPSTAN_CUTTER_CLASS
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

std::string_view to_text(Substrate s) { return kSubstrates.at(static_cast<std::size_t>(s)); }
std::optional<Substrate> substrate_from_text(std::string_view text) {
  const auto it = std::find(kSubstrates.begin(), kSubstrates.end(), text);
  if (it == kSubstrates.end()) return std::nullopt;
  return static_cast<Substrate>(it - kSubstrates.begin());
}

}  // namespace capstan::model
