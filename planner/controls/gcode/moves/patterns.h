#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "planner/ground/geometry/vec.h"

namespace capstan::controls::gcode {

/// Holes at equal distances on a straight line, in the order in which they are made. Units  mm, degrees.
struct Row {
  geometry::Vec2 first;
  double angle_deg = 0.0;  ///< of the way along it, from +X; above -180, to 180
  double step_mm = 0.0;
};

/// Holes at equal angles on a circle, counter-clockwise. Units  mm, degrees.
struct Ring {
  geometry::Vec2 centre;
  double radius_mm = 0.0;
  double first_deg = 0.0;  ///< of the first hole, from +X; above -180, to 180
  double step_deg = 0.0;   ///< above 0
};

/// Decimals of a pattern's numbers: a millionth of a degree is 0.01 micrometres at 500 mm.
inline constexpr int kPatternDecimals = 6;

/// The row that has these places, three or more; nothing where one of them would be rounded, at `decimals`,
/// to another place than the plan's is. Its numbers are rounded to kPatternDecimals.
[[nodiscard]] std::optional<Row> row_of(std::span<const geometry::Vec2> places, int decimals);

/// The same of a circle: four or more places, or three that divide it evenly (through any three goes one).
[[nodiscard]] std::optional<Ring> ring_of(std::span<const geometry::Vec2> places, int decimals);

/// A block per place behind the first: `begin`, and X and Y where they change.
[[nodiscard]] std::string place_blocks(std::span<const geometry::Vec2> places, int decimals,
                                       std::string_view begin,
                                       const std::function<std::string(double, int)>& number);

}  // namespace capstan::controls::gcode
