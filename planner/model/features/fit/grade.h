#pragma once

#include <optional>
#include <string>

namespace capstan::model {

/// Standard tolerance grades by number: IT1 .. IT18 are 1 .. 18, IT0 is 0, IT01 is -1.
inline constexpr int kIt01 = -1, kIt0 = 0, kFinestGrade = kIt01, kCoarsestGrade = 18;

/// The largest size the system speaks of, mm.
inline constexpr double kLargestSize = 3150.0;

/// Table 1 is split at this size: IT01 and IT0, and most letters, end here.
inline constexpr double kLargestCommonSize = 500.0;

/// The standard tolerance of a grade, mm; nothing where the standard has none.
///
/// Domain  0 < nominal <= 3150 mm; IT01 and IT0 to 500 mm only.
/// Source  ISO 286-1:2010, table 1: the values themselves, which are normative (the formulas behind them do
/// not
///         give all of them after rounding).
[[nodiscard]] std::optional<double> tolerance_grade(double nominal_mm, int grade);

/// The grade a tolerance of this width asks for: the coarsest whose standard tolerance is not wider. 7 for a
/// width from IT7 up to just below IT8; 18 for anything wider; nothing when even the finest grade of that
/// size is wider, or for a size outside the table.
[[nodiscard]] std::optional<int> grade_of(double nominal_mm, double width_mm);

/// The grade whose standard tolerance is just this width (to 0.05 micrometres); nothing when none is.
[[nodiscard]] std::optional<int> grade_of_exact(double nominal_mm, double width_mm);

/// "IT7", "IT01".
[[nodiscard]] std::string grade_name(int grade);

/// Micrometres as millimetres: the double nearest to the decimal, to a twentieth of a micrometre.
[[nodiscard]] double from_micrometres(double um);

}  // namespace capstan::model
