#pragma once

#include <vector>

#include "planner/making/toolpath/freeform/freeform.h"

namespace capstan::toolpath::freeform {

inline constexpr double kNothing = 1e-3;  ///< material thinner than this is not worth a pass, mm

/// Heights of the tip in roughing, from above, and those of them that end on a level floor.
struct Levels {
  std::vector<double> z_mm;
  std::vector<double> floors_mm;
};
/// Down to `lowest_mm`, no deeper than the task's axial depth each; where floors are known, a level ends
/// `margin_mm` above the allowance on each, and the levels between two are equal.
[[nodiscard]] Levels levels_of(const FreeformJob& task, double lowest_mm, double margin_mm);

}  // namespace capstan::toolpath::freeform
