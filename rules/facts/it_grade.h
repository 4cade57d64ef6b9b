#pragma once

namespace capstan::rules {

/// Standard tolerance IT1 .. IT18, mm, for a nominal size; 0 if the standard has none.
///
/// Domain  0 < nominal <= 3150 mm.
/// Source  planner/model/features/fit/grade.h.
[[nodiscard]] double standard_tolerance_mm(int grade, double nominal_mm);

/// The coarsest grade whose tolerance fits into `width_mm`: 7 for a width from IT7 up to just below IT8.
/// 0 when even IT1 is wider, 18 for anything wider than IT18.
[[nodiscard]] int grade_of_width(double nominal_mm, double width_mm);

}  // namespace capstan::rules
