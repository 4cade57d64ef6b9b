#pragma once

#include <functional>
#include <vector>

#include "planner/ground/geometry/vec.h"

namespace capstan::toolpath::freeform {

/// Lowest tip heights on a square grid along x and y.
/// Shape  z[iy * nx + ix]; NaN outside the area that is of interest.
struct DropGrid {
  geometry::Vec2 origin;
  double step_mm = 0.0;
  int nx = 0, ny = 0;
  std::vector<double> z;
  [[nodiscard]] geometry::Vec2 place(int ix, int iy) const {
    return {origin.x + ix * step_mm, origin.y + iy * step_mm};
  }
  [[nodiscard]] double at(int ix, int iy) const {
    return z[static_cast<std::size_t>(iy) * static_cast<std::size_t>(nx) + static_cast<std::size_t>(ix)];
  }
  /// Whether a grid point near the straight way stands higher than the level; where none does, the way may
  /// still be blocked between them.
  [[nodiscard]] bool blocks(geometry::Vec2 from, geometry::Vec2 to, double level) const;
};

/// The border of what is free at a level (z <= level), free ground on the left, by marching squares. Each
/// point is `border(free, blocked)` of two neighbours on the grid. Closed lines repeat their first point;
/// lines end open where the area ends. In order of the grid.
[[nodiscard]] std::vector<std::vector<geometry::Vec2>> level_contour(
    const DropGrid& grid, double level,
    const std::function<geometry::Vec2(geometry::Vec2 free, geometry::Vec2 blocked)>& border);

using Lines = std::vector<std::vector<geometry::Vec2>>;
/// The line that is begun soonest from here; a closed one is turned to begin there.
/// Needs  a line, none of them empty.
[[nodiscard]] Lines::iterator nearest(Lines& lines, geometry::Vec2 here);

/// Refines a border with free ground on its left: adds points where the border leaves the chord between two
/// by more than `within_mm`, and removes points that lie within a tenth of that of the chord over them.
[[nodiscard]] std::vector<geometry::Vec2> refined(
    const std::vector<geometry::Vec2>& line, double within_mm,
    const std::function<bool(geometry::Vec2)>& is_free,
    const std::function<geometry::Vec2(geometry::Vec2 free, geometry::Vec2 blocked)>& border);

}  // namespace capstan::toolpath::freeform
