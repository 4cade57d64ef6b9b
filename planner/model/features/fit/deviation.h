#pragma once

#include <optional>
#include <string_view>
#include <vector>

namespace capstan::model {

/// The letters of ISO 286 as lower case text in the order of the standard: "a" .. "zc"; the same for holes in
/// upper case.
[[nodiscard]] const std::vector<std::string_view>& fit_letters();

/// Where a shaft's tolerance interval hangs, micrometres: es for a .. h, ei for j .. zc; nothing where the
/// standard has none. Not for js, which is symmetrical.
///
/// Needs   a letter of fit_letters, lower case.
/// Domain  the table ends at 500 mm for a, b, c, j, v .. zc, at 50 mm for cd, ef, fg; t begins above 24, v
/// above
///         14, y above 18 mm; a and b only above 1 mm; j only IT5 to IT8 (IT8: to 3 mm).
/// Source  ISO 286-1:2010, tables 4 and 5.
[[nodiscard]] std::optional<double> shaft_deviation_um(double nominal_mm, std::string_view letter, int grade);

/// The same of a hole: EI for A .. H, ES for J .. ZC, with the value delta that K, M, N to IT8 and P .. ZC to
/// IT7 are raised by.
///
/// Needs   a letter of fit_letters, lower case, as for shafts.
/// Domain  as for shafts; J only IT6 to IT8; K above IT8 only to 3 mm, N above IT8 only above 1 mm; K .. ZC
/// from
///         IT3 to 500 mm, for delta is not stated for finer grades.
/// Source  ISO 286-1:2010, tables 2 and 3; its special case M6 from 250 to 315 mm.
[[nodiscard]] std::optional<double> hole_deviation_um(double nominal_mm, std::string_view letter, int grade);

/// Between which sizes a letter has a deviation at all, mm: above `over_mm`, up to and including `upto_mm`.
struct SizeSpan {
  double over_mm = 0.0, upto_mm = 0.0;
};
[[nodiscard]] SizeSpan sizes_of(std::string_view letter);

}  // namespace capstan::model
