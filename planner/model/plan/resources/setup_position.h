#pragma once

#include <cstddef>
#include <string>

#include "planner/ground/geometry/placement.h"
#include "planner/model/plan/plan.h"

// How a workpiece lies in its set-ups, in the words of whoever clamps it: seen from the front of the machine,
// X to the right, Y to the back, Z up.

namespace capstan::model {

/// The workpiece's frame in that of the set-up's program (features/setup_place.h); the program's own where
/// the set-up's nouns place no workpiece.
[[nodiscard]] geometry::Placement placed_in(const Plan& plan, std::size_t setup);

/// "+Z" of the workpiece for a direction of the set-up; "(0.6, 0, 0.8)" when it lies between its axes.
[[nodiscard]] std::string axis_text(const geometry::Placement& workpiece, geometry::Vec3 direction);

/// From the set-up before to this one: "not turned", "turned over, 180 deg about its X axis", "turned 90 deg
/// about its -Y axis". The axis is the workpiece's own, the sense that of a right-hand screw along it.
[[nodiscard]] std::string turn_text(const geometry::Placement& before, const geometry::Placement& now);

/// Whether every side of a box of the workpiece's axes faces an axis of the program.
[[nodiscard]] bool faces_axes(const geometry::Placement& workpiece);

/// Where the set-up's zero is on the raw piece as it lies there: "X0 at its left side, Y0 12.5 mm behind its
/// front, Z0 at its top". Empty when the piece lies askew, for then no side of it faces an axis.
[[nodiscard]] std::string zero_text(const geometry::Box3& raw, const geometry::Placement& workpiece,
                                    int decimals);

}  // namespace capstan::model
