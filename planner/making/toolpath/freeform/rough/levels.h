#pragma once

#include <vector>

#include "planner/making/toolpath/freeform/drop_cutter.h"
#include "planner/making/toolpath/freeform/freeform.h"
#include "planner/making/toolpath/freeform/rough/level_contour.h"

namespace capstan::toolpath::freeform {

inline constexpr double kNothing = 1e-3;  ///< material thinner than this is not worth a pass, mm

/// Heights of the tip in roughing.
struct Levels {
  /// In the order in which they are cut: the lowest of a group first, from above no deeper than the task's
  /// axial depth, then what stands above it, from below.
  std::vector<double> z_mm;
  std::vector<double> floors_mm;  ///< those of them that end on a level floor
};
/// Down to the lowest place of the grid, `margin_mm` above the allowance on each floor that is known. Where
/// the task bounds the terraces, each place that the tip may go down to has a level no farther above it than
/// that, measured square to the surface, with as few levels as that takes. Else each foot of a wall has one
/// no more than 1 mm above it, which is left to a ball: what it stands on may be no level floor.
/// Shape  `reach` holds the lowest heights of the tip; what is higher than the material counts as blocked.
[[nodiscard]] Levels levels_of(const FreeformJob& task, const DropGrid& reach, double lowest_mm,
                               double margin_mm, const std::vector<double>& feet_mm = {});
/// Lowest heights of the tip beside upright walls, from below: those from `lowest_mm` up to below `top_mm`.
[[nodiscard]] std::vector<double> feet_of_walls(const DropGrid& reach, const DropCutter& drop,
                                                const MillEnd& cutter, double allowance_mm, double lowest_mm,
                                                double top_mm);

}  // namespace capstan::toolpath::freeform
