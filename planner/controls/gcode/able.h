#pragma once

#include <string>
#include <string_view>

#include "planner/controls/gcode/words.h"
#include "planner/ground/base/result.h"
#include "planner/model/plan/plan.h"

namespace capstan::controls::gcode {

/// Whether the control of this machine takes the moves of every step.
/// Fails  OUT-CONTROL, which names each step that it does not take, with the move and why.
[[nodiscard]] Status able(const model::Plan& plan, const Words& words);

/// Whether the machine has every code of the program; `codes`: those that it has, empty: all.
/// Fails  OUT-CODE, which names each step with a code that it lacks.
[[nodiscard]] Status codes_known(std::string_view program, const std::string& codes);

}  // namespace capstan::controls::gcode
