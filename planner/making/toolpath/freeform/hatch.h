#pragma once

#include <vector>

#include "planner/ground/geometry/region.h"

namespace capstan::toolpath::freeform {

/// A straight piece inside an area, in the turned frame of its hatch: from (lo, v) to (hi, v).
struct Stripe {
  int line = 0;  ///< number of its line, from 0
  double v = 0.0, lo = 0.0, hi = 0.0;
};

/// Parallel lines at most `stepover_mm` apart over an area, evenly spread from side to side.
struct Hatch {
  geometry::Vec2 u_axis, v_axis;
  double spacing_mm = 0.0;
  std::vector<Stripe> stripes;  ///< by line, then by lo
  [[nodiscard]] geometry::Vec2 place(double u, double v) const { return u * u_axis + v * v_axis; }
};
[[nodiscard]] Hatch hatch(const geometry::Region& area, double angle_rad, double stepover_mm);

}  // namespace capstan::toolpath::freeform
