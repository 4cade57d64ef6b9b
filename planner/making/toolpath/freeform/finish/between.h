#pragma once

#include <utility>
#include <vector>

#include "planner/ground/geometry/region.h"
#include "planner/ground/geometry/vec.h"
#include "planner/making/toolpath/freeform/hatch.h"

namespace capstan::toolpath::freeform {

/// The tip's way in one piece, in the frame of the mesh, along one line of a hatch or a part of it.
using Run = std::vector<geometry::Vec3>;

/// A stretch along u, from lo to hi, and how far apart its two passes lie at most.
struct Gap {
  double lo = 0.0, hi = 0.0, apart_mm = 0.0;
};

/// Adds a gap behind those that begin before it, as one with the last where they touch.
void add_gap(std::vector<Gap>& gaps, const Gap& gap);

/// Where, along u, two neighbouring passes lie farther apart than `most_mm`, square to them and along the
/// surface between them: each in a place where both passes run.
/// Needs  runs that go towards greater u.
/// Source derived: on a plane z = a u + b v two passes dv apart lie dv sqrt(1 + b^2 / (1 + a^2)) apart.
[[nodiscard]] std::vector<Gap> wide_gaps(const std::vector<Run>& below, const std::vector<Run>& above,
                                         const Hatch& lines, double most_mm);

/// The parts of a stretch at v that lie in an area; an empty one stands for the whole plane.
[[nodiscard]] std::vector<std::pair<double, double>> parts_in(const geometry::Region& area,
                                                              const Hatch& lines, double v, const Gap& gap);

/// A stretch between two passes where ridges come out higher than asked, in the frame of the hatch.
struct High {
  double v = 0.0, lo = 0.0, hi = 0.0;
  double dv = 0.0;  ///< from the one pass to the other, seen from above
  double ridge_mm = 0.0;
};

/// The height of the ridge that a ball leaves between passes so far apart along a plane.
[[nodiscard]] double ridge_mm(double ball_mm, double apart_mm);

}  // namespace capstan::toolpath::freeform
