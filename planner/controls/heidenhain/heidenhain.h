#pragma once

#include <optional>
#include <string>

#include "planner/controls/dialect.h"
#include "planner/controls/gcode/moves/pocket_cycles.h"
#include "planner/controls/gcode/words.h"
#include "planner/model/plan/plan.h"

namespace capstan::controls::heidenhain {

/// HEIDENHAIN TNC 640 and iTNC 530 in conversational language, programs `.h`: each line is a block with its
/// number from 0, comments behind `;`, axes with their sign, a block that `~` ends goes on in the next line.
///
/// Head     `BEGIN PGM NAME MM`, which is the unit of the program, feeds in mm/min included, and the raw
/// piece
///          of the first set-up as `BLK FORM`. `END PGM NAME MM` behind `M30`.
///
/// Offset   `CYCL DEF 247` with a row of the preset table, 1 to 99 (`PRESET1` in the plan).
///
/// Tool     `TOOL CALL 5 Z S3000`: change, tool axis, length and speed; `TOOL CALL Z S2500` a speed alone;
///          `TOOL DEF 6` makes the next one ready. A speed that the plan changes within a path is such a
///          block, too, at which the tool stops: no word of L or C states a speed.
///
/// Top      of Z by `L Z+0 R0 FMAX M91`: M91 counts from the machine's datum, in its block, without the
/// tool's
///          length.
///
/// Path     `CYCL DEF 32` with the step's tolerance and HSC-MODE, 1 roughing, 0 finishing. There is no word
/// for
///          an exact path: a machine without path_tolerance_mm has no program.
///
/// Arcs     `CC` and `C ... DR`; one that also goes up or down, of any number of turns, `CP IPA IZ DR`.
///
/// Holes    `CYCL DEF 200`, `201`, `202`, `203`, `205` and `207`, called by `CYCL CALL` where the tool is;
/// equal holes of a step
///          are called with one definition. Q203 + Q204 is where it
///          came from, Q203 + Q200 where it is fed from, Q203 + Q201 the bottom. Q202 is the depth: one
///          plunge. Equal pecks, the last one what is left: `203` where chips are broken, `205` where the
///          hole is cleared and the machine's file states which parameters it has. `202` where the machine's
///          spindle can be oriented and the bar comes out stopped.
///
/// Stops    the message as a comment, then `M0`, which stops the spindle and the coolant, too: both are off
///          before it, and stated again before the next cut.
///
/// Pockets  with `cycles: pocket` 251 and 252, roughing along a helix, and 253 for closed slots, in back and
///          forth, called over the middle: Q202, Q207 and
///          Q206 keep the loads of the plan's path (gcode/moves/pocket_cycles.h). A comment of the
///          header says for each tool how large its ANGLE in the tool table may be, for the flattest of its
///          pockets.
///
/// Not written: 208 (its way to the wall is its own), PATTERN DEF, PLANE, RL and RR.
///
/// Source   tests/controls/heidenhain/golden/README.md says what is from where, and what is remembered.
extern const Dialect kDialect;

/// The words of the plan's machine, with the program's head.
[[nodiscard]] gcode::Words words_of(const model::Plan& plan);

/// Cycles 251 to 253, with the way to the pocket's middle and the call (pockets.cpp).
extern const gcode::PocketWords kPockets;

/// The program's name: of the part's file, else CAPSTAN; capitals, digits, - and _.
[[nodiscard]] std::string program_name(const model::Plan& plan);

/// Decimals that the control takes, of places, pitches and angles (TNC 640 ISO programming, 19.3).
inline constexpr int kMostDecimals = 4;

/// The first work offset's name without its number: PRESET1, of CYCL DEF 247.
inline constexpr std::string_view kPreset = "PRESET";

}  // namespace capstan::controls::heidenhain
