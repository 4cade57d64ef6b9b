#pragma once

#include <array>
#include <string_view>

#include "planner/model/plan/resources/machine.h"
#include "planner/proof/verify/program/program.h"
#include "planner/proof/verify/program/readers.h"

namespace capstan::verify::siemens {

/// Reads main programs of SINUMERIK 840D sl in its own language: comments behind ;, N, block skip, G0 to G4,
/// G17, G40 to G42, G53, G153 and SUPA, G54 to G57 and G505 to G599, G60, G64, G641, G642, G70, G71, G700,
/// G710, G90, G91, G94, G95, I, J, CR=, TURN=, ADIS=, ADISPOS=, CTOL=, SPOS=, T by number and by name, D0 and
/// D1, M0 to M9, M19, M30, MSG, CYCLE832, and CYCLE81, 82, 83, 84, 85, 86, 89 and 840, called once or modally
/// by MCALL, there at the places of HOLES1 and HOLES2 too, and POCKET3 and POCKET4 roughing along a helix,
/// whose path is the control's and the moves one that covers it; expanded into moves, kCycleBlockCap of them
/// at most. What is beyond that (R parameters and other variables, expressions, jumps, subprograms, frames,
/// other planes, modes of the cycles' later parameters) becomes a fault, and reading goes on.
///
/// The tool's length is that of D1, stated behind each change: whether M6 takes D1 by itself is machine data
/// (MD20270). SUPA leaves the length on; only with D0 does Z say where the axis goes. G53 and G153 leave
/// shifts on, which are not known: a move with them is a fault.
///
/// A tool called by its name is that of the header's line with that id.
///
/// Cost    linear in the text. No recursion.
/// Source  as planner/controls/siemens/siemens.h has it; steps of CYCLE83 near the bottom, the limit on
///         coming back and lengths of MSG: default, unsourced.
[[nodiscard]] Program read_program(std::string_view text, const model::Machine& machine);

/// For messages.
inline constexpr ControlWords kWords{.to_top = "G0 SUPA Z",
                                     .to_top_end = " D0",
                                     .in_machine = "SUPA",
                                     .length = "D1",
                                     .length_of = "T",
                                     .length_of_end = " D1",
                                     .unit = "unit (G700/G710)",
                                     .feed_mode = "feed mode (G94/G95)",
                                     .no_cycle = "MCALL",
                                     .exact = "G60"};

/// Source  SINUMERIK 840D sl, programming manual: CYCLE832, MCALL, SUPA.
inline constexpr std::array kSigns{
    Sign{.text = "CYCLE832", .what = "a tolerance"},
    Sign{.text = "MCALL", .what = "a modal call"},
    Sign{.text = "SUPA", .what = "a place in machine coordinates"},
};

/// The names of work offsets, a copy on purpose: tests/door/service/controls_test.cpp holds it against the
/// writer's.
inline constexpr std::array<std::string_view, 99> kOffsets = {
    "G54",  "G55",  "G56",  "G57",  "G505", "G506", "G507", "G508", "G509", "G510", "G511", "G512", "G513",
    "G514", "G515", "G516", "G517", "G518", "G519", "G520", "G521", "G522", "G523", "G524", "G525", "G526",
    "G527", "G528", "G529", "G530", "G531", "G532", "G533", "G534", "G535", "G536", "G537", "G538", "G539",
    "G540", "G541", "G542", "G543", "G544", "G545", "G546", "G547", "G548", "G549", "G550", "G551", "G552",
    "G553", "G554", "G555", "G556", "G557", "G558", "G559", "G560", "G561", "G562", "G563", "G564", "G565",
    "G566", "G567", "G568", "G569", "G570", "G571", "G572", "G573", "G574", "G575", "G576", "G577", "G578",
    "G579", "G580", "G581", "G582", "G583", "G584", "G585", "G586", "G587", "G588", "G589", "G590", "G591",
    "G592", "G593", "G594", "G595", "G596", "G597", "G598", "G599"};

}  // namespace capstan::verify::siemens
