#pragma once

#include <utility>
#include <vector>

#include "planner/ground/geometry/vec.h"
#include "planner/making/toolpath/freeform/hatch.h"

namespace capstan::toolpath::freeform {

/// The tip's way in one piece, in the frame of the mesh, along one line of a hatch or a part of it.
using Run = std::vector<geometry::Vec3>;

/// Where, along u, two neighbouring passes lie farther apart than `most_mm`, square to them and along the
/// surface between them: intervals from lo to hi, each in a place where both passes run.
/// Needs  runs that go towards greater u.
/// Source derived: on a plane z = a u + b v two passes dv apart lie dv sqrt(1 + b^2 / (1 + a^2)) apart.
[[nodiscard]] std::vector<std::pair<double, double>> wide_gaps(const std::vector<Run>& below,
                                                               const std::vector<Run>& above,
                                                               const Hatch& lines, double most_mm);

/// The height of the ridge that a ball leaves between passes so far apart along a plane.
[[nodiscard]] double ridge_mm(double ball_mm, double apart_mm);

}  // namespace capstan::toolpath::freeform
