#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "planner/ground/geometry/vec.h"
#include "planner/model/plan/plan.h"

namespace capstan::controls::gcode {

/// One touch along an axis of the set-up, in its frame, mm.
struct Touch {
  std::string feature, probe;     ///< letters, digits and _; the probe's number, empty where none is stated
  geometry::Vec3 start, wall;     ///< of the ball's centre at the start; where its surface meets the wall
  int axis = 0, sense = 1;        ///< 0 X, 1 Y, 2 Z; 1 or -1
  double ball = 0.0, stem = 0.0;  ///< radii
};

[[nodiscard]] inline double on(const geometry::Vec3& v, int axis) {
  return axis == 0 ? v.x : axis == 1 ? v.y : v.z;
}

/// Nothing, and why, for a touch that states too little or goes along no axis.
[[nodiscard]] std::optional<Touch> touch_of(const model::Plan& plan, model::AnyRef probing, std::size_t setup,
                                            std::string& why_not);

/// Why it is not proven that nothing is in the way straight down to the start and from there to the wall and
/// so far beyond it; empty: it is. By boxes about the whole raw piece, about what holds it and about the
/// probe (options `probe_radius_mm` and `probe_stylus_mm`, and the ball): a box too many is a stop too many.
[[nodiscard]] std::string in_the_way(const model::Plan& plan, const Touch& t, std::size_t setup,
                                     double beyond_mm);

/// Where the program is: the tool in the spindle, 0 none yet, and the set-up of the step behind it.
struct Standing {
  int tool = 0;
  std::size_t setup = 0;
};

/// Why no touch is made before step `next` (null: behind the last); empty: it may be. Behind a step of the
/// same set-up work offset and height are known.
[[nodiscard]] std::string not_here(const model::StepResult* next, Standing standing);

/// What the machine does of some touches, and why the others stay the operator's.
struct TouchBlocks {
  std::vector<std::string> comments, blocks;
};

}  // namespace capstan::controls::gcode
