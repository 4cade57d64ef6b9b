#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

namespace capstan::model {

/// Classes of cutter the planner tells apart (ISO 14649-111 tool bodies). The order is the table's.
enum class CutterClass : std::uint8_t {
  kEndmill,
  kBullnoseEndmill,
  kBallEndmill,
  kFacemill,
  kTwistDrill,
  kCenterDrill,
  kSpotDrill,
  kReamer,
  kTap,
  kThreadMill,
  kBoringTool,
  kCountersink,
  kCounterbore,
  kChamferMill,
  kTSlotMill,
  kDovetailMill,
  kGunDrill,
  kBackCounterbore,
  kBackCountersink,
  kCornerRoundingMill,  ///< a concave quarter round of corner_radius_mm; its tip has tip_diameter_mm
  kTaperedEndmill,      ///< a cone of taper_angle_rad over a flat, bull or ball tip of cutting_diameter_mm
  kSideMill,            ///< a disc of cutting_width_mm: side mills, slitting saws, woodruff cutters
  kTouchProbe,          ///< no cutter: measures; cutting_diameter_mm is that of its ball
};
inline constexpr CutterClass kLastCutterClass = CutterClass::kTouchProbe;

/// What is true of every cutter of a class. How a class cuts:
///
///     along_axis   feeds along its axis: drills, reamers, taps, sinks, boring tools
///     end_mill     flat or with a corner radius, upright flank: cuts pockets, slots and outsides
///     opens_solid  its point goes into solid material at the axis: twist, gun, centre and spot drills
///     sizes_hole   its diameter is the hole's: twist and gun drills, reamers, taps
///     threads      makes threads: its pitch must be known
///     undercuts    its head is wider than what stands above it and works under an overhang
///     slot_form    runs along a slot whose mouth is open already: T-slot and dovetail cutters
///     cone         its tip or flank is a cone of point_angle_rad
///     sinks        a cone that makes chamfers and countersinks by its flank
enum class CutterTrait : std::uint16_t {
  kAlongAxis = 1U << 0U,
  kEndMill = 1U << 1U,
  kOpensSolid = 1U << 2U,
  kSizesHole = 1U << 3U,
  kThreads = 1U << 4U,
  kUndercuts = 1U << 5U,
  kSlotForm = 1U << 6U,
  kCone = 1U << 7U,
  kSinks = 1U << 8U,
};

struct CutterClassRow {
  CutterClass value;
  std::string_view name;   ///< in plans and libraries: "twist_drill"
  std::string_view words;  ///< for people: "twist drill"
  std::uint16_t traits;
  /// Type of a tool in Fusion's libraries; empty: it has none of its own.
  std::string_view fusion;
  /// Shape type of FreeCAD; empty: it has none.
  std::string_view freecad;
};

/// In the order of the enumeration.
[[nodiscard]] std::span<const CutterClassRow> cutter_classes();
[[nodiscard]] const CutterClassRow& row_of(CutterClass c);
[[nodiscard]] bool has(CutterClass c, CutterTrait t);
[[nodiscard]] std::string_view to_text(CutterClass c);   ///< "endmill", "twist_drill", ...
[[nodiscard]] std::string_view words_of(CutterClass c);  ///< "end mill", "twist drill", ...
[[nodiscard]] std::optional<CutterClass> cutter_class_from_text(std::string_view text);

enum class Substrate : std::uint8_t { kHss, kCarbide };
[[nodiscard]] std::string_view to_text(Substrate s);
[[nodiscard]] std::optional<Substrate> substrate_from_text(std::string_view text);

}  // namespace capstan::model
