#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "planner/ground/base/result.h"
#include "planner/model/features/fit/fit.h"

namespace capstan::model {

/// What a drawing says of everything that states no tolerance itself.
struct GeneralTolerance {
  char size_class = 0;               ///< ISO 2768-1: 'f', 'm', 'c', 'v'; 0: none
  char geometry_class = 0;           ///< ISO 2768-2: 'H', 'K', 'L'; 0: none
  std::optional<double> size_mm;     ///< by value: every linear size +- this
  std::optional<double> profile_mm;  ///< by value: ISO 22081, width of the profile zone of every surface
  std::string text;                  ///< as a person would write it: "ISO 2768-mK"
  friend bool operator==(const GeneralTolerance&, const GeneralTolerance&) = default;
};

/// Reads "ISO 2768-m", "ISO 2768-mK", "ISO 22081 0.2", "ISO 22081 +-0.1", "+-0.1" (also with the sign ±, with
/// a blank or a comma as decimal sign, with ":1989" behind the number, or "DIN ISO").
///
/// Domain  a value is above 0 and at most 10 mm.
/// Fails   MDL-GENERAL for anything else, naming what is understood.
[[nodiscard]] Result<GeneralTolerance> parse_general(std::string_view text);

/// The deviation, +-mm, of a linear size. Nothing where no general tolerance is stated: below 0.5 mm and
/// above 4000 mm (2000 mm for f, up to 3 mm for v) in ISO 2768-1.
///
/// A profile zone of ISO 22081 lets each surface lie half its width out; a size between two is taken as no
/// wider than that, the cautious reading.
/// Source  ISO 2768-1:1989, table 1.
[[nodiscard]] std::optional<double> general_size(const GeneralTolerance& g, double nominal_mm);

/// General geometric tolerances, width of the zone in mm. Nothing without a class of ISO 2768-2; the profile
/// zone of ISO 22081 is the same for all.
/// Source  ISO 2768-2:1989, tables 1 and 2.
[[nodiscard]] std::optional<double> general_flatness(const GeneralTolerance& g, double length_mm);
[[nodiscard]] std::optional<double> general_perpendicularity(const GeneralTolerance& g, double shorter_mm);

}  // namespace capstan::model
