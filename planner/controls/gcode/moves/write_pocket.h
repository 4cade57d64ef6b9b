#pragma once

#include <cstddef>
#include <string_view>

#include "planner/controls/gcode/program.h"
#include "planner/controls/gcode/words.h"
#include "planner/model/plan/plan.h"

namespace capstan::controls::gcode {

/// Writes step `n` as a pocket cycle of the control, with a comment on its path and time, the tool at the
/// path's start, where the machine asks for that, or the edit of its `cycles` (model::cycles_by_step; empty:
/// none). False: nothing but a comment that says why there is none, where the step roughs a pocket.
bool write_pocket(const model::Plan& plan, std::size_t n, std::string_view cycles, const Words& words,
                  Program& out);

}  // namespace capstan::controls::gcode
