#pragma once

#include <vector>

#include "planner/ground/geometry/vec.h"

namespace capstan::verify {

/// Distance of two outlines, mm; a point or a segment is an outline, too. 0 where they meet.
[[nodiscard]] double apart(const std::vector<geometry::Vec2>& a, const std::vector<geometry::Vec2>& b);

}  // namespace capstan::verify
