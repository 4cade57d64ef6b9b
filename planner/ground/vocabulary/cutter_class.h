#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "planner/ground/vocabulary/noun_kind.h"

namespace capstan::model {

/// Classes of cutter the planner tells apart (ISO 14649-111 tool bodies); their rows are in
/// cutter_classes.inc.
enum class CutterClass : std::uint8_t {
#define CAPSTAN_CUTTER_CLASS(value, ...) value,
#include "planner/ground/vocabulary/cutter_classes.inc"
#undef CAPSTAN_CUTTER_CLASS
};
inline constexpr CutterClass kLastCutterClass = static_cast<CutterClass>(-1
#define CAPSTAN_CUTTER_CLASS(value, ...) +1
#include "planner/ground/vocabulary/cutter_classes.inc"
#undef CAPSTAN_CUTTER_CLASS
);

/// What is true of every cutter of a class.
///
///     along_axis    feeds along its axis: drills, reamers, taps, sinks, boring tools
///     end_mill      flat or with a corner radius, upright flank: cuts pockets, slots and outsides
///     opens_solid   its point goes into solid material at the axis: twist, gun, centre and spot drills
///     sizes_hole    its diameter is the hole's: twist and gun drills, reamers, taps
///     threads       makes threads: its pitch must be known
///     undercuts     its head is wider than its neck and works under an overhang
///     slot_form     runs along a slot whose mouth is open already: T-slot and dovetail cutters
///     cone          its tip or flank is a cone of point_angle_rad
///     sinks         a cone that makes chamfers and countersinks by its flank
///     layers        cuts a layer at a time, with end and upright flank: its loads are those of milling
///     ball          its corner radius is half its diameter
///     ramps         goes into solid material slanting, or straight down where it cuts at its centre
///     drills        makes a hole to its full depth; chips leave by its flutes
///     marks         its point marks a place or breaks an edge, and is not its diameter wide there
///     to_centre     cuts at its centre, as every one of its class is made
///     point_angle   point_angle_rad describes it, in tables and comments too
///     smaller_does  a smaller one of the class makes the same shape
///     wide          made with diameters above 100 mm
///     necked        its neck and tip belong to the shape that it makes
enum class CutterTrait : std::uint32_t {
  kAlongAxis = 1U << 0U,
  kEndMill = 1U << 1U,
  kOpensSolid = 1U << 2U,
  kSizesHole = 1U << 3U,
  kThreads = 1U << 4U,
  kUndercuts = 1U << 5U,
  kSlotForm = 1U << 6U,
  kCone = 1U << 7U,
  kSinks = 1U << 8U,
  kLayers = 1U << 9U,
  kBall = 1U << 10U,
  kRamps = 1U << 11U,
  kDrills = 1U << 12U,
  kMarks = 1U << 13U,
  kToCentre = 1U << 14U,
  kPointAngle = 1U << 15U,
  kSmallerDoes = 1U << 16U,
  kWide = 1U << 17U,
  kNecked = 1U << 18U,
};

/// What a cutter must state, because a guess would spoil the thread or the shape: a field of model::Cutter by
/// its name, and its words, "a pitch". Empty: nothing.
struct CutterMust {
  std::string_view field;
  std::string_view words;
};

struct CutterClassRow {
  CutterClass value;
  std::string_view name;   ///< in plans and libraries: "twist_drill"
  std::string_view words;  ///< for people: "twist drill"
  std::uint32_t traits;
  CutterMust must;
  /// Body of ISO 14649-111 that it is written as; kUserDefinedTool: by `words`. kNone: it is no cutting tool.
  TypeId body;
  /// Type of a tool in Fusion's libraries; empty: it has none of its own.
  std::string_view fusion;
  /// Shape type of FreeCAD; empty: it has none.
  std::string_view freecad;
  /// What a format without this class says instead, with a loss; itself: nothing comes near.
  CutterClass stand_in;
};

/// In the order of the enumeration.
[[nodiscard]] std::span<const CutterClassRow> cutter_classes();
[[nodiscard]] const CutterClassRow& row_of(CutterClass c);
[[nodiscard]] bool has(CutterClass c, CutterTrait t);
[[nodiscard]] std::string_view to_text(CutterClass c);   ///< "endmill", "twist_drill", ...
[[nodiscard]] std::string_view words_of(CutterClass c);  ///< "end mill", "twist drill", ...
[[nodiscard]] std::optional<CutterClass> cutter_class_from_text(std::string_view text);
/// The class that a comment in lower case calls a cutter, in English, German or Portuguese.
[[nodiscard]] std::optional<CutterClass> cutter_class_called(std::string_view lower_comment);

enum class Substrate : std::uint8_t { kHss, kCarbide };
[[nodiscard]] std::string_view to_text(Substrate s);
[[nodiscard]] std::optional<Substrate> substrate_from_text(std::string_view text);

}  // namespace capstan::model
