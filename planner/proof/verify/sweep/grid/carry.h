#pragma once

#include "planner/ground/geometry/placement.h"
#include "planner/proof/verify/sweep/grid/grid.h"

namespace capstan::verify {

/// Takes from `to` what is no longer there in `from`: what one clamping left is what the next begins with.
///
/// Frame     `to_frame`, `from_frame`: where the workpiece lies in each set-up.
/// Accuracy  tool axes alike or opposite: heights exact, sides within a cell. At an angle: heights within a
///           hundredth of a cell where both grids see the surface; a hollow that neither axis sees stays
///           full.
void carry(Grid& to, const geometry::Placement& to_frame, const Grid& from,
           const geometry::Placement& from_frame);

}  // namespace capstan::verify
