#pragma once

#include <functional>
#include <vector>

#include "planner/ground/geometry/vec.h"
#include "planner/making/toolpath/freeform/drop_cutter.h"
#include "planner/making/toolpath/freeform/finish/between.h"
#include "planner/making/toolpath/freeform/rough/level_contour.h"

namespace capstan::toolpath::freeform {

/// Which places of a grid belong to an area of a surface: steep, shallow, rest. A place between grid points
/// belongs to the nearest of them.
struct Mask {
  geometry::Vec2 origin;
  double step_mm = 0.0;
  int nx = 0, ny = 0;
  std::vector<char> on;  ///< iy * nx + ix
  [[nodiscard]] bool at(geometry::Vec2 p) const;
  [[nodiscard]] bool any() const;
  /// Takes a place in, where the grid has it.
  void set(geometry::Vec2 p);
};

/// No place of the grid.
[[nodiscard]] Mask empty_mask(const DropGrid& grid);
/// Places of the mask and those at most so many grid points beside them.
[[nodiscard]] Mask grown(const Mask& mask, int points);
/// Places that are in both.
[[nodiscard]] Mask both(const Mask& a, const Mask& b);
[[nodiscard]] Mask either(const Mask& a, const Mask& b);
[[nodiscard]] Mask inverse(const Mask& mask);

/// Whether the tip may stand at a height of a grid: it is one of the area, and free.
[[nodiscard]] bool is_place(double z);
/// The slope of the tip's places at a grid point that is one: of the steeper sides along x and y. `counts`
/// leaves out neighbours (x, y), which rise by so much; none: all places count.
[[nodiscard]] double tangent_at(const DropGrid& grid, int ix, int iy,
                                const std::function<bool(int x, int y, double rise)>& counts = {});

/// Where the places of the tip of a cutter rise more steeply than an angle, and are no upright step, which
/// is an edge of the surface and no slope. `grid`: those places, 1e300 and NaN where there are none.
[[nodiscard]] Mask steep_of(const DropGrid& grid, const DropCutter& drop, const MillEnd& cutter,
                            double allowance_mm, double angle_rad);

/// The pieces of a run that lie in the mask.
[[nodiscard]] std::vector<Run> within(const Run& run, const Mask& mask);
[[nodiscard]] std::vector<Run> within(const std::vector<Run>& runs, const Mask& mask);

}  // namespace capstan::toolpath::freeform
