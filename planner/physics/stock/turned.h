#pragma once

#include "planner/ground/geometry/placement.h"
#include "planner/physics/stock/height_map.h"

namespace capstan::stock {

/// Takes from `to` what another clamping has cut away, never too much: seen along the same axis, cells sink
/// to the highest of the cells of `from` that lie over them; seen from the other side, only what is cut
/// through goes (a map reaches from its top down to the floor, so that a hollow below stays full); seen from
/// beside, only the layers above the highest material of `from` in that direction go.
///
/// Frame  `to_frame`, `from_frame`: where the workpiece lies in each set-up.
void take_over(HeightMap& to, const geometry::Placement& to_frame, const HeightMap& from,
               const geometry::Placement& from_frame);

}  // namespace capstan::stock
