#pragma once

#include <cmath>

#include "planner/ground/geometry/vec.h"
#include "planner/model/plan/cutter_path.h"

// A path as it is wherever it lies: its place subtracted and the rest rounded, so that equal paths at other
// places give the same bytes. What is found of a path in its own frame holds for all of them.

namespace capstan::model {

/// The grid of an own frame, mm: a power of two, so that its points and their differences are exact. Each
/// coordinate moves by half of it at most, 4.7e-10 mm; across the axis the ends of an arc by all of it, for
/// their centre is rounded, too: 1.3e-9 mm in all. A coordinate of a metre carries some 1e-13 mm of rounding:
/// of 10,000 of them two fall on another point of the grid than in an equal path elsewhere, which costs time
/// and no more.
inline constexpr double kOwnGrid = 0x1p-30;

/// The point of the grid nearest to it; symmetric about 0.
[[nodiscard]] inline double on_own_grid(double mm) {
  // A multiplication by a power of two is exact; the last sum makes -0 a 0.
  return std::nearbyint(mm * (1.0 / kOwnGrid)) * kOwnGrid + 0.0;
}
[[nodiscard]] inline geometry::Vec2 on_own_grid(geometry::Vec2 p) {
  return {on_own_grid(p.x), on_own_grid(p.y)};
}

/// Where a path's own frame begins: the centre of its first arc, so that the turns of a helix have one radius
/// there; its start where it has no arc.
[[nodiscard]] geometry::Vec2 own_origin(const CutterPath& path);

/// The path less `origin` across the axis, on the grid, heights too. The ends of an arc are rounded as seen
/// from its centre. Points at one place stay at one place, and an arc that ends where it began a whole turn:
/// so does one of more than a half turn whose ends are up to 16 grids apart, 1.5e-8 mm, and its end moves by
/// as much.
[[nodiscard]] CutterPath in_own_frame(const CutterPath& path, geometry::Vec2 origin);

}  // namespace capstan::model
