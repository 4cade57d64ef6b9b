#pragma once

#include "planner/ground/geometry/placement.h"
#include "planner/ground/geometry/region.h"

namespace capstan::geometry {

/// An area in the frame of another height, seen from above; turned over, its loops run the other way round.
[[nodiscard]] Region moved(const Region& r, const Placement& to);

}  // namespace capstan::geometry
