#pragma once

#include "planner/making/toolpath/region/area/level.h"

namespace capstan::toolpath {

/// Narrows a level to the centres from which a cutter takes what the wider cutter of `task.cleared_by` left:
/// corners and passages too narrow for it.
///
///     left = reach of this cutter \ reach of the wider one
///
/// The level's `centres` shrink to those near what is left, its `air` is where the cutter stands free in what
/// is cleared already; `inside` stays, so that ways may lead through there. Feather edges, where the two
/// reaches part by less than kFeather, are passed over by the run-out along the wall, not left.
///
/// Needs   upright walls; the wider cutter went as deep.
/// Returns the area left, mm2; 0: nothing, and the level is not to be cut.
double narrow_to_rest(const PathJob& task, const WorkArea& area, Level& level);
inline constexpr double kFeather = 0.02;  ///< mm

}  // namespace capstan::toolpath
