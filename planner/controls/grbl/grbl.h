#pragma once

#include "planner/controls/dialect.h"
#include "planner/controls/gcode/words.h"
#include "planner/model/plan/plan.h"

namespace capstan::controls::grbl {

/// Grbl 1.1 on routers, programs `.gcode`: a subset of RS274/NGC without cycles, tool table, G43 H and G64.
/// What a machine's file may state: options `tool_change`, `tool_length`, `mist`
/// (ground/vocabulary/control_options.h).
///
/// Tools    `T5 M6`, which the program that sends the blocks carries out, or a macro; Grbl itself answers
///          error 20 and runs nothing. With `tool_change: m0` it is `T5` and a stop. Behind either the tool
///          goes to the top of Z again, for a touch-off leaves it anywhere.
///
/// Length   `tool_length: touch_off`: who changes the tool sets the zero of Z with it, and no block states a
///          length. `g43.1`: each step states `G43.1 Z` with the tool's length, as measured, as a number.
///
/// Path     exact: corners are slowed down for ($11), never rounded. `G61` says so.
///
/// Comments have no `!`, `?`, `~` and nothing beyond ASCII: Grbl takes these out of its input wherever they
/// stand, as feed hold, question, start and overrides.
///
/// Not written: tapping, radius compensation, M1 (ignored), block skip (ignored), M7 where it is not compiled
/// in.
///
/// Source   gnea/grbl 1.1h: grbl/gcode.c, grbl/protocol.c, grbl/serial.c, doc/markdown/commands.md,
///          README.md.
extern const Dialect kDialect;

/// The words of the plan's machine.
[[nodiscard]] gcode::Words words_of(const model::Plan& plan);

}  // namespace capstan::controls::grbl
