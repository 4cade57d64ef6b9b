#pragma once

#include <optional>
#include <string>

#include "planner/controls/dialect.h"
#include "planner/controls/gcode/moves/face_cycles.h"
#include "planner/controls/gcode/moves/pocket_cycles.h"
#include "planner/controls/gcode/words.h"
#include "planner/model/plan/resources/machine.h"

namespace capstan::controls::siemens {

/// SINUMERIK 840D sl in its own language (G290), main programs `.mpf`: comments behind `;`, numbers with a
/// point only where they need one.
///
/// State    `G17 G40 G90 G94 G710` and `MCALL` alone, which ends a modal call. G710 holds for feeds too; G71
///          leaves them in the unit of the machine's basic system.
///
/// Path     `CYCLE832(tolerance, 1 or 3, 1)`, finishing or roughing, or `G642 CTOL=`, or `G641 ADIS=
///          ADISPOS=` of the same size; `CYCLE832(0,0,1)` and `G60` without a tolerance.
///
/// Tool     `T5 M6` or `T="name" M6`; its length by `D1` in the block of the first move of Z.
///
/// Speed    `S M3` where the spindle starts; where the plan has another speed for a part of a path, S alone
/// in
///          the block of its first move, so that no block without a move stops the tool between two cuts.
///
/// Top      of Z by `G0 SUPA Z D0`: SUPA suppresses all frames of its block and keeps the tool's length,
/// which
///          D0 takes away.
///
/// Arcs     centre from the start by I and J; a helix of more than one turn by `TURN=`, the further turns.
///
/// Holes    `MCALL CYCLE81`, `82`, `85` and `84`, a positioning block, `MCALL`: RTP is where the tool came
///          from, RFP + SDIS where it is fed from, DP absolute. `CYCLE83` where all pecks behind
///          the first are equal; other pecks are explicit moves. `CYCLE86` where the machine's spindle can be
///          oriented and a bar comes out with it stopped. `CYCLE840` where the operation states a
///          compensating chuck. Equal holes of a step stand between one MCALL and its end: `HOLES1` for a
///          row, `HOLES2` for a circle, else a block per place. Modes of the later lists of parameters
///          (_GMODE, _DMODE, _AMODE) are left out: 0, as the shorter lists.
///
/// Stops    `MSG("...")` of 124 characters at most, `M0`, and `MSG()`, which takes the text away.
///
/// Pockets  with `cycles: pocket` POCKET3 and POCKET4, roughing along a helix: RFP + SDIS is where the plan's
///          path is fed from, FAL and FALD what it leaves, MID, FFP1 and FFD what keeps its loads
///          (gcode/moves/pocket_cycles.h); the blank's sizes (_AP1, _AP2, _AD) are left out.
///
/// Faces    with `cycles: pocket` CYCLE71, roughing in strokes back and forth along X or Y (31, 41), the
///          rectangle as wide as the strokes along its edges want, FDP beyond it (gcode/moves/face_cycles.h).
///
/// Not written: SLOT1 (where it puts a slot could not be looked up; slots are POCKET3), CYCLE61, 72,
/// CYCLE800.
///
/// Source   SINUMERIK NC programming 12/2019, 6FC5398-2EP40 (helices, CYCLE832, CTOL); fundamentals 10.2004,
///          6FC5298-7AB00 (G641); 802D sl 06/2006, 6FC5398-3CP10 (G710); function manual W1 11/2006 (tools);
///          ISO Milling 04.07 (SUPA); help texts of the cycles. Pages of these were at hand, not all of
///          them: tests/controls/siemens/golden/README.md says what is from where, and what is remembered.
extern const Dialect kDialect;

/// The words of the machine's control.
[[nodiscard]] gcode::Words words_of(const model::Machine& machine);

/// POCKET3 and POCKET4 (pockets.cpp).
extern const gcode::PocketWords kPockets;
/// CYCLE71 (faces.cpp).
extern const gcode::FaceWords kFaces;

/// Characters of a tool's name at most, and whether it may be one: printable, without quotes.
inline constexpr std::size_t kLongestToolName = 32;
[[nodiscard]] bool is_tool_name(std::string_view name);

}  // namespace capstan::controls::siemens
