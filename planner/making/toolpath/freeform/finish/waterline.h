#pragma once

#include <vector>

#include "planner/ground/base/job.h"
#include "planner/making/toolpath/freeform/finish/mask.h"
#include "planner/making/toolpath/freeform/rough/reach.h"

namespace capstan::toolpath::freeform {

/// Ways of the tip at constant heights along what is steep, from above: with the surface on the right, which
/// is climb for a clockwise spindle. Closed ones end where they begin.
struct Level {
  double z_mm = 0.0;
  std::vector<Run> runs;
};

/// What was found of them.
struct Waterlines {
  std::vector<Level> levels;
  Mask left_out;             ///< about where a way was left out because it could not be proved clear
  double left_out_mm = 0.0;  ///< length of those
};

/// Levels so close that the ways lie at most `apart_mm` apart along the surface where it is least steep;
/// pieces of them in `where`. `grid` is that of `reach`.
///
/// No gouge   every way is probed as those of the rough (Reach::is_free); what cannot be proved is left out.
[[nodiscard]] Waterlines waterlines(const Reach& reach, const DropGrid& grid, const Mask& where,
                                    double apart_mm, Job& job);

}  // namespace capstan::toolpath::freeform
