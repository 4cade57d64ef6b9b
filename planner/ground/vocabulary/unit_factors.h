#pragma once

#include <numbers>

namespace capstan {

inline constexpr double kMmPerInch = 25.4;  ///< exact: international yard and pound agreement, 1959
inline constexpr double kMetresPerFoot = 0.3048;
inline constexpr double kRadPerDegree = std::numbers::pi / 180.0;
inline constexpr double kRadPerTurn = 2.0 * std::numbers::pi;

}  // namespace capstan
