#pragma once

#include <vector>

#include "planner/ground/geometry/vec.h"
#include "planner/physics/stock/planar/trail.h"

namespace capstan::stock {

/// What of a stock stands between two corners, in an own frame (model/plan/path/own_frame.h): where two
/// stocks hold the same but for their place, their parts are equal to the bit.
///
/// Frame  the own frame: x and y less an origin, on the grid; heights on the grid.
/// Units  mm.
struct PlanarPart {
  geometry::Box3 box;          ///< the piece, which ends at the part's sides
  double bar_radius_mm = 0.0;  ///< 0: a block; of a bar whose side runs through the part the box is around it
  std::vector<Trail> trails;   ///< that may reach into the part, in the order in which they were cut
};

/// The trail less `origin` across the axis, on the grid; arcs keep their radius as seen from their centre.
[[nodiscard]] Trail in_own_frame(Trail trail, geometry::Vec2 origin);

}  // namespace capstan::stock
