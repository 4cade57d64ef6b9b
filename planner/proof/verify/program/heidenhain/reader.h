#pragma once

#include <array>
#include <string_view>

#include "planner/model/plan/resources/machine.h"
#include "planner/proof/verify/program/program.h"
#include "planner/proof/verify/program/readers.h"

namespace capstan::verify::heidenhain {

/// Reads programs of HEIDENHAIN TNC 640 and iTNC 530 in conversational language: BEGIN PGM to END PGM, block
/// numbers, comments, BLK FORM, TOOL CALL and TOOL DEF, L with R0, RL and RR, F, FMAX and M91, incremental
/// IX, IY and IZ, CC with C, CR, CP with IPA, STOP, M0 to M5, M7 to M9, M13, M14, M30, M99, cycles 9, 32 and
/// 247 that act where they stand, and 200 to 203, 205, 207, 251 and 252, called by CYCL CALL or M99 and
/// expanded into moves. What is beyond that (Q parameters, labels, jumps, other cycles, contours with RND and
/// CHF, tilted planes, datum shifts, oversizes) becomes a fault, and reading goes on.
///
/// The tool's length is that of TOOL CALL, which also ends any other. M91 counts from the machine's datum
/// without the length; an increment in its block is a fault. M0 stops the spindle and the coolant, too, STOP
/// does not.
///
/// What is modal in other languages is fixed here: places are absolute where no I stands before the axis, the
/// plane is that of the tool axis Z, the unit that of BEGIN PGM, and no cycle runs without its call.
///
/// Cost    linear in the text. No recursion.
/// Source  TNC 426B (280 472) and TNC 310 (286 140) manuals on M91; TNC 640 (34059x-01) cycle programming on
///         the parameters of cycles; the public post processor mwinterm/fusion_post, iTNC 530, on how blocks
///         are written; order of the moves within the cycles: remembered, as
///         tests/controls/heidenhain/golden/README.md says of each.
[[nodiscard]] Program read_program(std::string_view text, const model::Machine& machine);

/// For messages.
inline constexpr ControlWords kWords{.to_top = "L Z",
                                     .to_top_end = " R0 FMAX M91",
                                     .in_machine = "M91",
                                     .length = "TOOL CALL",
                                     .change = "TOOL CALL",
                                     .length_of = "TOOL CALL ",
                                     .unit = "unit (BEGIN PGM MM)",
                                     .plane = "tool axis (TOOL CALL Z)",
                                     .distance = "absolute places",
                                     .feed_mode = "feed per minute",
                                     .no_radius = "R0",
                                     .no_cycle = "no CYCL CALL",
                                     .exact = "no word of this control states it"};

/// The names of work offsets, rows of the preset table: a copy on purpose.
/// tests/door/service/controls_test.cpp holds it against the writer's.
inline constexpr std::array<std::string_view, 99> kOffsets = {
    "PRESET1",  "PRESET2",  "PRESET3",  "PRESET4",  "PRESET5",  "PRESET6",  "PRESET7",  "PRESET8",
    "PRESET9",  "PRESET10", "PRESET11", "PRESET12", "PRESET13", "PRESET14", "PRESET15", "PRESET16",
    "PRESET17", "PRESET18", "PRESET19", "PRESET20", "PRESET21", "PRESET22", "PRESET23", "PRESET24",
    "PRESET25", "PRESET26", "PRESET27", "PRESET28", "PRESET29", "PRESET30", "PRESET31", "PRESET32",
    "PRESET33", "PRESET34", "PRESET35", "PRESET36", "PRESET37", "PRESET38", "PRESET39", "PRESET40",
    "PRESET41", "PRESET42", "PRESET43", "PRESET44", "PRESET45", "PRESET46", "PRESET47", "PRESET48",
    "PRESET49", "PRESET50", "PRESET51", "PRESET52", "PRESET53", "PRESET54", "PRESET55", "PRESET56",
    "PRESET57", "PRESET58", "PRESET59", "PRESET60", "PRESET61", "PRESET62", "PRESET63", "PRESET64",
    "PRESET65", "PRESET66", "PRESET67", "PRESET68", "PRESET69", "PRESET70", "PRESET71", "PRESET72",
    "PRESET73", "PRESET74", "PRESET75", "PRESET76", "PRESET77", "PRESET78", "PRESET79", "PRESET80",
    "PRESET81", "PRESET82", "PRESET83", "PRESET84", "PRESET85", "PRESET86", "PRESET87", "PRESET88",
    "PRESET89", "PRESET90", "PRESET91", "PRESET92", "PRESET93", "PRESET94", "PRESET95", "PRESET96",
    "PRESET97", "PRESET98", "PRESET99"};

/// Source  HEIDENHAIN TNC 640, conversational programming: BEGIN PGM.
inline constexpr std::array kSigns{
    Sign{.of = Sign::Of::kText,
         .text = "BEGINPGM",
         .what = "BEGIN PGM, the head of a program in conversational language"},
};

}  // namespace capstan::verify::heidenhain
