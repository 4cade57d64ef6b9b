#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "planner/controls/gcode/words.h"
#include "planner/model/plan/plan.h"

namespace capstan::controls::gcode {

/// What the machine's macro (option `probe_macro`) does of some touches, and why the others stay the
/// operator's.
struct MacroCalls {
  std::vector<std::string> comments, blocks;
};

/// Where the program is: the tool in the spindle, 0 none yet, and the set-up of the step behind it.
struct Standing {
  int tool = 0;
  std::size_t setup = 0;
};

/// The blocks of `probe_macro` for these workpiece_probings before step `next` (null: behind the last), their
/// places filled in. The macro takes the probe itself, goes over the start at the top of Z, straight down to
/// it, touches along the axis, and comes back the same way. It is written behind a step of the same set-up
/// and before one that calls a tool, where that way is clear of all of the raw piece, of which nothing may be
/// cut yet, and of what holds it, by boxes about them and about the probe (options `probe_radius_mm` and
/// `probe_stylus_mm`, and the ball): a box too many is a stop too many. Nothing where the machine states no
/// macro.
[[nodiscard]] MacroCalls macro_calls(const model::Plan& plan, const std::vector<model::AnyRef>& touches,
                                     const model::StepResult* next, Standing standing, const Words& words);

}  // namespace capstan::controls::gcode
