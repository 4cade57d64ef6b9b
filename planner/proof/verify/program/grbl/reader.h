#pragma once

#include <array>
#include <cstddef>
#include <string_view>

#include "planner/model/plan/resources/machine.h"
#include "planner/proof/verify/program/program.h"
#include "planner/proof/verify/program/readers.h"

namespace capstan::verify::grbl {

/// Characters of a block without blanks and comments. Source: grbl/protocol.h, LINE_BUFFER_SIZE 80, one for
/// its end.
inline constexpr std::size_t kLongestBlock = 79;

/// Reads programs as Grbl 1.1 does: comments, N, G0-G4, G17, G20, G21, G38.2, G40, G43.1, G49, G53, G54-G59,
/// G61, G80, G90, G91, G91.1, G93, G94, M0, M2-M9, M30, T, S, F. M6 is carried out by who sends the program,
/// or, where the machine's file says so (tool_change: m0), T and M0 are a change. What Grbl refuses, and what
/// it has and this reader does not follow (G10, G28, G30, G38.3 to G38.5, G92, other planes), becomes a
/// fault, and reading goes on.
///
/// Length   with `tool_length: touch_off` that of the tool acts from its change on, in the work offset that
/// was
///          stated before: Z of that one is set with the tool (G10 L20 P0). In another there is none until
///          the tool is changed again, for itself or for another. With `g43.1` it acts from a block `G43.1
///          Z`, whose number is the length that the program's header has of the tool.
/// Path     exact: it keeps within every tolerance.
///
/// Cost     linear in the text. No recursion.
/// Source   gnea/grbl 1.1h: grbl/gcode.c (order of a block, groups, refusals), grbl/protocol.c (comments,
///          length, /), grbl/serial.c (commands out of the input); README.md.
[[nodiscard]] Program read_program(std::string_view text, const model::Machine& machine);

/// For messages.
inline constexpr ControlWords kWords{
    .length = "G43.1, or the work offset and then the change with its touch-off",
    .length_of = "G43.1 Z of T",
    .unit = "unit (G20/G21)",
    .feed_mode = "feed mode (G93/G94)"};

/// A copy on purpose: tests/door/service/controls_test.cpp holds it against the writer's.
inline constexpr std::array<std::string_view, 6> kOffsets = {"G54", "G55", "G56", "G57", "G58", "G59"};

}  // namespace capstan::verify::grbl
