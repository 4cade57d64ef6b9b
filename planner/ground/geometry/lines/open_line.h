#pragma once

#include <vector>

#include "planner/ground/geometry/vec.h"

namespace capstan::geometry {

/// Distance from p to the nearest point of an open line of straight pieces, mm; 1e300 for fewer than two
/// points. Needs   neighbours that differ.
[[nodiscard]] double distance_to_line(const std::vector<Vec2>& line, Vec2 p);

}  // namespace capstan::geometry
