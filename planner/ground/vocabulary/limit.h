#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace capstan::model {

/// The limits of a cut: of loads, of machine and cutter, of the required surface. In the order of kLimitRows.
enum class Limit : std::uint8_t {
  kSpindlePower,
  kSpindleTorque,
  kToolDeflection,
  kChipThickness,
  kWallError,
  kSurfaceRoughness,
  kPeakForce,
  kChipThicknessLeast,
  kSpindleSpeedLeast,
  kSpindleSpeedMost,
  kAxisFeed,
  kCuttingLength,
  kLevelDepth,
  kStableDepth,
};
inline constexpr std::size_t kLimitCount = static_cast<std::size_t>(Limit::kStableDepth) + 1;

struct LimitRow {
  Limit value;
  std::string_view name;  ///< in plans and reports
  std::string_view unit;
  bool of_loads;  ///< follows from the loads of a cut and the speed alone
  bool at_rpm;    ///< holds at one speed of the spindle
  bool varies;    ///< changes with speed, width or feed at one depth
  bool eased;     ///< a lower feed keeps it
};

inline constexpr std::array<LimitRow, kLimitCount> kLimitRows = {
    {{Limit::kSpindlePower, "spindle_power", "W", true, true, true, true},
     {Limit::kSpindleTorque, "spindle_torque", "Nm", true, true, true, true},
     {Limit::kToolDeflection, "tool_deflection", "mm", true, false, true, true},
     {Limit::kChipThickness, "chip_thickness", "mm", true, false, true, true},
     {Limit::kWallError, "wall_error", "mm", true, false, true, true},
     {Limit::kSurfaceRoughness, "surface_roughness", "um", true, false, true, true},
     {Limit::kPeakForce, "peak_force", "N", true, false, true, true},
     {Limit::kChipThicknessLeast, "chip_thickness_least", "mm", false, false, true, false},
     {Limit::kSpindleSpeedLeast, "spindle_speed_least", "1/min", false, false, false, false},
     {Limit::kSpindleSpeedMost, "spindle_speed_most", "1/min", false, false, false, false},
     {Limit::kAxisFeed, "axis_feed", "mm/min", false, false, true, true},
     {Limit::kCuttingLength, "cutting_length", "mm", false, false, false, false},
     {Limit::kLevelDepth, "level_depth", "mm", false, false, false, false},
     {Limit::kStableDepth, "stable_depth", "mm", false, false, false, false}}};

[[nodiscard]] constexpr std::size_t index_of(Limit l) { return static_cast<std::size_t>(l); }
[[nodiscard]] constexpr const LimitRow& row_of(Limit l) { return kLimitRows.at(index_of(l)); }

namespace limit_table {
constexpr bool in_order() {
  for (std::size_t i = 0; i < kLimitRows.size(); ++i) {
    if (index_of(kLimitRows[i].value) != i) return false;
  }
  return true;
}
static_assert(in_order());
}  // namespace limit_table

/// The limits that a section of a path is held to by its feed, in the order in which they are reported.
inline constexpr std::array kSectionLimits = {
    Limit::kPeakForce,     Limit::kToolDeflection,   Limit::kSpindleTorque, Limit::kSpindlePower,
    Limit::kChipThickness, Limit::kSurfaceRoughness, Limit::kWallError};

}  // namespace capstan::model
