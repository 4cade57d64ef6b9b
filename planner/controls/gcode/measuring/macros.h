#pragma once

#include <vector>

#include "planner/controls/gcode/measuring/touch.h"
#include "planner/controls/gcode/words.h"

namespace capstan::controls::gcode {

/// The blocks of the machine's macro (option `probe_macro`) for these workpiece_probings before step `next`
/// (null: behind the last), their places filled in. The macro takes the probe itself, goes over the start at
/// the top of Z, straight down to it, touches along the axis, and comes back the same way. It is written
/// behind a step of the same set-up, where that way is clear of all of the raw piece, of which nothing may be
/// cut yet, and of what holds it (`in_the_way`). Nothing where the machine states no macro.
[[nodiscard]] TouchBlocks macro_calls(const model::Plan& plan, const std::vector<model::AnyRef>& touches,
                                      const model::StepResult* next, Standing standing, const Words& words);

}  // namespace capstan::controls::gcode
