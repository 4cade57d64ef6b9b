#pragma once

#include <map>

#include "planner/model/nouns/arena/model.h"

namespace capstan::verify::volumes {

/// A size and the deviations that the file allows it, mm, read apart from the planner.
struct Limits {
  double nominal_mm = 0.0;
  double lower_mm = 0.0, upper_mm = 0.0;  ///< added to nominal; lower <= upper
  bool given = false;                     ///< whether deviations are stated
  [[nodiscard]] double width() const { return upper_mm - lower_mm; }
};

/// The deviations of a plus_minus_value or a limits_and_fits about a size. Not given: nothing is stated, or
/// what is stated can be read in no way, or in two.
///
/// Source  ISO 14649-10: a limit of a plus_minus_value is what is added to, or subtracted from, the size; a
///         negative lower limit that leaves no width is the deviation itself. ISO 286-1 for classes; only its
///         tables are shared with the planner.
[[nodiscard]] Limits deviations_of(const model::Model& m, double nominal_mm, model::AnyRef tolerance);
/// The same of a toleranced length with its nominal size; 0 where it states none.
[[nodiscard]] Limits limits_of(const model::Model& m, model::AnyRef toleranced_length);

/// The narrowest zone of location (position, concentricity, coaxiality, symmetry, a toleranced distance) that
/// is stated of each feature, or of a feature that it is made of, mm.
[[nodiscard]] std::map<model::AnyRef, double> location_zones(const model::Model& m);

}  // namespace capstan::verify::volumes
