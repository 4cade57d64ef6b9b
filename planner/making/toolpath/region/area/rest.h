#pragma once

#include "planner/making/toolpath/region/area/level.h"

namespace capstan::toolpath {

/// Narrows a level to the centres from which a cutter takes what the wider cutter of `task.cleared_by` left:
/// corners and passages too narrow for it.
///
///     left = reach of this cutter \ reach of the wider one
///
/// Shrinks the level's `centres` to those near the rest, which becomes its `rest`; `air` becomes the centres
/// at which the cutter is free in the area cleared already. `inside` does not change, so that links may pass
/// there. Feather edges, where the two reaches differ by less than kFeather, count as no rest: the run-out
/// along the wall covers them.
///
/// Needs   upright walls; the wider cutter went as deep.
/// Returns the area left, mm2; 0: nothing, and the level is not to be cut.
double narrow_to_rest(const PathJob& task, const WorkArea& area, Level& level);
inline constexpr double kFeather = 0.02;  ///< mm

}  // namespace capstan::toolpath
