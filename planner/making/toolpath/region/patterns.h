#pragma once

#include "planner/making/toolpath/region/area/level.h"

namespace capstan::toolpath {

/// Rings parallel to the walls (contour_parallel), joined by short steps, or melted into one spiral where
/// each ring has a single neighbour (contour_spiral).
struct ContourOptions {
  bool spiral = false;
  bool outside_in = false;
  bool lead_arcs = false;  ///< the wall ring is met and left on tangent arcs
  bool wall_only = false;  ///< nothing but the wall ring, in what is cleared already inside it
};
Status cut_contours(LevelCutter& cutter, const Level& level, const ContourOptions& options);

/// Straight passes over the centres, to and fro or one way, then (with `walls`) once along the walls.
struct RasterOptions {
  geometry::Vec2 direction{1.0, 0.0};  ///< unit, set-up frame
  bool one_way = false;
  bool step_left = true;  ///< the next pass lies on the left of the first
  bool walls = true;
  bool walls_first = false;
  const geometry::Region* wall_of = nullptr;  ///< when set, only loops that touch this boundary are walls
};
Status cut_raster(LevelCutter& cutter, const Level& level, const RasterOptions& options);

/// Whether the cutter runs in the sense of the region's loops (walls on the right).
[[nodiscard]] bool walls_on_right(const PathJob& task);

/// How far a closed wall is followed past its beginning, over the cutter's diameter: where an arc leaves the
/// wall at the very point where another met it, the bending of the first teeth stays as a line on the wall.
/// Default, unsourced.
inline constexpr double kPastBeginning = 0.1;

/// Along a closed track from where the cutter is or near it, on tangent arcs where they fit.
/// Returns false when it had to come straight.
bool cut_with_leads(LevelCutter& cutter, const Level& level, Track track);

}  // namespace capstan::toolpath
