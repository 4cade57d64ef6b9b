#pragma once

#include <optional>
#include <string>

#include "planner/controls/gcode/program.h"
#include "planner/model/plan/plan.h"

namespace capstan::controls::gcode {

/// Comments on set-up `n`: how the piece lies, where zero is on it, what holds it and where. `before` is the
/// set-up before it, from which the piece is turned.
void write_setup(const model::Plan& plan, std::size_t n, std::optional<std::size_t> before, Program& out);

/// What to do between two set-ups: `set-up 2: clamp the workpiece anew, ...`, of at most `longest` characters
/// where the program's comments can say the rest.
[[nodiscard]] std::string clamping_text(const model::Plan& plan, std::size_t n, std::size_t before,
                                        std::size_t longest);

}  // namespace capstan::controls::gcode
