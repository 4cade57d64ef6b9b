#pragma once

#include <array>
#include <string>
#include <string_view>

#include "planner/model/plan/resources/machine.h"
#include "planner/proof/verify/program/program.h"
#include "planner/proof/verify/program/readers.h"

namespace capstan::verify::fanuc {

/// Reads programs of FANUC's milling controls, and of Haas's where the machine's dialect is "haas": %, O, N,
/// comments, G0-G4, G5.1, G17, G20, G21, G28, G40-G43, G49, G53-G59, G54.1 P, G61, G64, G73, G74, G80-G86,
/// G89-G91, G94, G95, G98, G99, M0-M9, M29, M30, and at Haas G154 P and G187. Cycles are expanded into moves,
/// kCycleBlockCap of them at most. A FANUC's M98 P runs a subprogram of the same text (subprograms.h). What
/// is beyond that (variables, other calls, other planes, G76, G87, G88) becomes a fault, and reading goes on.
/// What one machine does otherwise than another (the time that P counts, rigid tapping, d of G83 and G73) and
/// what it does not take (codes, helices, radii, quadrants, long blocks) is by its file, with the defaults of
/// options.h.
///
/// A length without a decimal point is a fault: it counts least increments on one machine and millimetres on
/// the next (parameter 3401).
///
/// Cost    linear in the text. No recursion.
/// Source  FANUC B-63844EN/02 (Series 0i-MODEL B), B-63944EN-2/02 (30i, canned cycles), Haas 96-8000.
[[nodiscard]] Program read_program(std::string_view text, const model::Machine& machine);

/// A marker or header line as LinuxCNC's programs write it: small letters between < and >, characters as $
/// and two hexadecimal digits, names in small letters. Any other comment comes back as it is.
[[nodiscard]] std::string plain_comment(std::string_view text);

/// What is taken where the machine's file says nothing.
inline constexpr std::string_view kFanucOptions =
    "tap=m29 dwell=milliseconds extended_offsets=0 arcs=half largest_radius_mm=99999.999 helices=yes "
    "prove_out=m1 line_length=200 peck_clearance_mm= chip_break_mm= codes= shop_codes= through_coolant=";
inline constexpr std::string_view kHaasOptions =
    "tap=g84 dwell=seconds extended_offsets=99 arcs=half largest_radius_mm=15404.000 helices=yes "
    "prove_out=m1 line_length=200 peck_clearance_mm= codes= shop_codes= through_coolant=M88/M89";

/// Both begin with a number; what only one of them reads tells them apart.
/// Source  FANUC 30i user's manual B-63944; Haas mill operator's manual 96-8210.
inline constexpr std::array kFanucSigns{
    Sign{.of = Sign::Of::kProgramNumber, .what = "a program number"},
    Sign{.text = "G54.1", .what = "an extended work offset", .other = "P"},
    Sign{.text = "M29", .what = "rigid tapping", .other = "S"},
    Sign{.text = "G5.1", .what = "look-ahead", .other = "Q"},
    Sign{.text = "G05.1", .what = "look-ahead", .other = "Q"},
};
inline constexpr std::array kHaasSigns{
    Sign{.of = Sign::Of::kProgramNumber, .what = "a program number"},
    Sign{.text = "G54.1", .what = "an extended work offset", .other = "P"},
    Sign{.text = "M29", .what = "rigid tapping", .other = "S"},
    Sign{.text = "G187", .what = "smoothness"},
    Sign{.text = "G154", .what = "an extended work offset", .other = "P"},
};

/// The names of work offsets, a copy on purpose: tests/door/service/controls_test.cpp holds it against the
/// writer's.
inline constexpr std::array<std::string_view, 54> kFanucOffsets = {
    "G54",      "G55",      "G56",      "G57",      "G58",      "G59",      "G54.1P1",  "G54.1P2",
    "G54.1P3",  "G54.1P4",  "G54.1P5",  "G54.1P6",  "G54.1P7",  "G54.1P8",  "G54.1P9",  "G54.1P10",
    "G54.1P11", "G54.1P12", "G54.1P13", "G54.1P14", "G54.1P15", "G54.1P16", "G54.1P17", "G54.1P18",
    "G54.1P19", "G54.1P20", "G54.1P21", "G54.1P22", "G54.1P23", "G54.1P24", "G54.1P25", "G54.1P26",
    "G54.1P27", "G54.1P28", "G54.1P29", "G54.1P30", "G54.1P31", "G54.1P32", "G54.1P33", "G54.1P34",
    "G54.1P35", "G54.1P36", "G54.1P37", "G54.1P38", "G54.1P39", "G54.1P40", "G54.1P41", "G54.1P42",
    "G54.1P43", "G54.1P44", "G54.1P45", "G54.1P46", "G54.1P47", "G54.1P48"};
inline constexpr std::array<std::string_view, 105> kHaasOffsets = {
    "G54",     "G55",     "G56",     "G57",     "G58",     "G59",     "G154P1",  "G154P2",  "G154P3",
    "G154P4",  "G154P5",  "G154P6",  "G154P7",  "G154P8",  "G154P9",  "G154P10", "G154P11", "G154P12",
    "G154P13", "G154P14", "G154P15", "G154P16", "G154P17", "G154P18", "G154P19", "G154P20", "G154P21",
    "G154P22", "G154P23", "G154P24", "G154P25", "G154P26", "G154P27", "G154P28", "G154P29", "G154P30",
    "G154P31", "G154P32", "G154P33", "G154P34", "G154P35", "G154P36", "G154P37", "G154P38", "G154P39",
    "G154P40", "G154P41", "G154P42", "G154P43", "G154P44", "G154P45", "G154P46", "G154P47", "G154P48",
    "G154P49", "G154P50", "G154P51", "G154P52", "G154P53", "G154P54", "G154P55", "G154P56", "G154P57",
    "G154P58", "G154P59", "G154P60", "G154P61", "G154P62", "G154P63", "G154P64", "G154P65", "G154P66",
    "G154P67", "G154P68", "G154P69", "G154P70", "G154P71", "G154P72", "G154P73", "G154P74", "G154P75",
    "G154P76", "G154P77", "G154P78", "G154P79", "G154P80", "G154P81", "G154P82", "G154P83", "G154P84",
    "G154P85", "G154P86", "G154P87", "G154P88", "G154P89", "G154P90", "G154P91", "G154P92", "G154P93",
    "G154P94", "G154P95", "G154P96", "G154P97", "G154P98", "G154P99"};

}  // namespace capstan::verify::fanuc
