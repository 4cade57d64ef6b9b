#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace capstan::tooling {

/// In what a hardness is stated, or a tensile strength that says as much.
enum class Scale : std::uint8_t {
  kBrinell,
  kVickers,
  kRockwellA,
  kRockwellB,
  kRockwellC,
  kStrength,  ///< N/mm2
  kOther      ///< no conversion of it is here: Shore, Knoop, other Rockwell scales, a yield strength
};

/// A unit as texts write it, folded to capitals.
struct ScaleUnit {
  std::string_view word;
  Scale scale;
  double lo, hi;             ///< outside, a number beside it is something else
  bool must;                 ///< it always states a hardness: without a number it is one that cannot be read
  double factor = 1.0;       ///< to the scale's own unit
  std::string_view as = {};  ///< what a message calls it, where not `word`
};

/// Longer ones first where one begins with another.
inline constexpr std::array kScaleUnits = {
    ScaleUnit{"ROCKWELL HARDNESS C", Scale::kRockwellC, 5, 80, true, 1.0, "HRC"},
    ScaleUnit{"ROCKWELL HARDNESS B", Scale::kRockwellB, 10, 130, true, 1.0, "HRB"},
    ScaleUnit{"ROCKWELL HARDNESS A", Scale::kRockwellA, 40, 95, true, 1.0, "HRA"},
    ScaleUnit{"ROCKWELL C", Scale::kRockwellC, 5, 80, true, 1.0, "HRC"},
    ScaleUnit{"ROCKWELL-C", Scale::kRockwellC, 5, 80, true, 1.0, "HRC"},
    ScaleUnit{"ROCKWELLC", Scale::kRockwellC, 5, 80, true, 1.0, "HRC"},
    ScaleUnit{"ROCKWELL B", Scale::kRockwellB, 10, 130, true, 1.0, "HRB"},
    ScaleUnit{"ROCKWELL-B", Scale::kRockwellB, 10, 130, true, 1.0, "HRB"},
    ScaleUnit{"ROCKWELLB", Scale::kRockwellB, 10, 130, true, 1.0, "HRB"},
    ScaleUnit{"ROCKWELL A", Scale::kRockwellA, 40, 95, true, 1.0, "HRA"},
    ScaleUnit{"ROCKWELL-A", Scale::kRockwellA, 40, 95, true, 1.0, "HRA"},
    ScaleUnit{"ROCKWELLA", Scale::kRockwellA, 40, 95, true, 1.0, "HRA"},
    ScaleUnit{"ROCKWELL", Scale::kRockwellC, 5, 80, false, 1.0, "HRC"},  // the hardest that it may mean
    ScaleUnit{"HRC", Scale::kRockwellC, 5, 80, true},
    ScaleUnit{"HRB", Scale::kRockwellB, 10, 130, true},
    ScaleUnit{"HRBW", Scale::kRockwellB, 10, 130, true, 1.0, "HRB"},
    ScaleUnit{"HRA", Scale::kRockwellA, 40, 95, true},
    ScaleUnit{"RC", Scale::kRockwellC, 5, 80, false, 1.0, "HRC"},
    ScaleUnit{"RB", Scale::kRockwellB, 40, 130, false, 1.0, "HRB"},
    ScaleUnit{"BRINELL", Scale::kBrinell, 50, 1000, false, 1.0, "HB"},
    ScaleUnit{"HBW", Scale::kBrinell, 50, 1000, true},
    ScaleUnit{"HBS", Scale::kBrinell, 50, 1000, true},
    ScaleUnit{"BHN", Scale::kBrinell, 50, 1000, true},
    ScaleUnit{"HBN", Scale::kBrinell, 50, 1000, true},
    ScaleUnit{"HB", Scale::kBrinell, 50, 1000, true},
    ScaleUnit{"VICKERS", Scale::kVickers, 50, 2000, false, 1.0, "HV"},
    ScaleUnit{"HV", Scale::kVickers, 50, 2000, true},
    ScaleUnit{"N/MM2", Scale::kStrength, 200, 3000, false, 1.0, "N/mm2"},
    ScaleUnit{"N/MM^2", Scale::kStrength, 200, 3000, false, 1.0, "N/mm2"},
    ScaleUnit{"N/MM**2", Scale::kStrength, 200, 3000, false, 1.0, "N/mm2"},
    ScaleUnit{"MPA", Scale::kStrength, 200, 3000, false, 1.0, "MPa"},
    ScaleUnit{"GPA", Scale::kStrength, 0.2, 3, false, 1000.0, "GPa"},
    ScaleUnit{"PA", Scale::kStrength, 2e8, 3e9, false, 1e-6, "Pa"},
    ScaleUnit{"KSI", Scale::kStrength, 29, 435, false, 6.894757, "ksi"},
    ScaleUnit{"PSI", Scale::kStrength, 29'000, 435'000, false, 0.006894757, "psi"},
    ScaleUnit{"KP/MM2", Scale::kStrength, 20, 306, false, 9.80665, "kp/mm2"},
    ScaleUnit{"KG/MM2", Scale::kStrength, 20, 306, false, 9.80665, "kp/mm2"},
    ScaleUnit{"KGF/MM2", Scale::kStrength, 20, 306, false, 9.80665, "kp/mm2"},
    ScaleUnit{"RM", Scale::kStrength, 200, 3000, false, 1.0, "N/mm2"},
    ScaleUnit{"UTS", Scale::kStrength, 200, 3000, false, 1.0, "N/mm2"},
    ScaleUnit{"HR15N", Scale::kOther, 10, 130, false},
    ScaleUnit{"HR30N", Scale::kOther, 10, 130, false},
    ScaleUnit{"HR45N", Scale::kOther, 10, 130, false},
    ScaleUnit{"HR15T", Scale::kOther, 10, 130, false},
    ScaleUnit{"HR30T", Scale::kOther, 10, 130, false},
    ScaleUnit{"HRD", Scale::kOther, 10, 130, false},
    ScaleUnit{"HRE", Scale::kOther, 10, 130, false},
    ScaleUnit{"HRF", Scale::kOther, 10, 130, false},
    ScaleUnit{"HRM", Scale::kOther, 10, 130, false},
    ScaleUnit{"HRR", Scale::kOther, 10, 130, false},
    ScaleUnit{"HK", Scale::kOther, 50, 2000, false},
    ScaleUnit{"KNOOP", Scale::kOther, 50, 2000, false},
    ScaleUnit{"SHORE", Scale::kOther, 10, 120, false, 1.0, "Shore"},
    ScaleUnit{"HS", Scale::kOther, 20, 110, false},
    ScaleUnit{"HLD", Scale::kOther, 100, 1000, false},
    ScaleUnit{"LEEB", Scale::kOther, 100, 1000, false}};

/// Brinell hardness of a value, never softer than it is: below its table the table's least, beyond it
/// infinite, so that no card is as hard. 0 for a scale without a conversion.
///
/// Source    HRC: ASTM A370 as at yidecasting.com; Miki Pulley's table (mikipulley.co.jp, tech20) has the
/// same
///           values. HRA: the same rows at
///           encoremetals.com/resources/technical-data/hardness-conversions.html. HRB: ASTM E140 as at
///           chicagotube.com (hardness-conversion-chart), below 85 at ficientdesign.com
///           (hardness-tensile-strength-brinell-rockwell-scale). N/mm2: ISO 18265 table A.1, formerly DIN
///           50150, to 1520 as at 51tongren.cn/en/technical.asp?plt=4. Straight between points. HV: a Brinell
///           number is never above the Vickers number, which is taken.
/// Uncertainty  conversions are approximate by nature; they hold for steel.
[[nodiscard]] double brinell_of(Scale scale, double value);

/// Whether the conversion is one for materials of this group of ISO 513. Rockwell C and A are taken for all:
/// they only ever make a piece harder than its card, or refuse it. HRB and strength hold for steel that is
/// not austenitic.
[[nodiscard]] bool converts(Scale scale, std::string_view iso_group);

}  // namespace capstan::tooling
