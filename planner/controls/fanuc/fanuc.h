#pragma once

#include "planner/controls/dialect.h"
#include "planner/controls/gcode/words.h"
#include "planner/model/plan/resources/machine.h"

namespace capstan::controls::fanuc {

/// FANUC controls of milling machines, and Haas, which speak the same but for the options of the table
/// ground/vocabulary/control_options.h: `%`, O-number, comments in capitals, decimal points on all lengths
/// and feeds, none on S, T, H, P.
///
/// Path     `G64`, or `G61` without a tolerance; Haas says it with `G187 E`.
///
/// Length   `G43 H` in the block of the first move of Z: alone it would move Z by the offset itself.
///
/// Top      of Z by `G49 G53 Z`, or `G91 G28 Z0.` and `G90 G49`; both take the length offset away as they
/// move.
///
/// Tapping  `M29 S`, `G84` (`G74` for left-hand taps) with the pitch as F in G95, or pitch times speed in
/// G94.
///
/// Holes    `G81`, `G82`, `G85`, `G89` with all words in each block where they make the path's moves, `G86`
///          where the spindle stops at the bottom. Pecks by `G83` and `G73` where the machine's file says
///          where these come back to (options `peck_clearance_mm`, `chip_break_mm`): from R by equal Q; at
///          Haas also by `I`, `J`, `K`, a first peck and equal ones behind it. Else they are explicit moves.
///
/// Stops    a comment, then `M0`.
///
/// Source   FANUC B-63844EN/02, B-63944EN-2/02, B-63833EN-1/02; Haas 96-8000 (G73, page 185; G83, page 191).
extern const Dialect kFanuc;
extern const Dialect kHaas;

/// The words of the machine's control.
[[nodiscard]] gcode::Words words_of(const model::Machine& machine);

/// A comment's text as the control may read it: no `%`, which ends the tape; no `;`, which ends a block;
/// where it has `capitals` only, in these. Inside quotes nothing is lost: small letters stand between < and
/// >, other characters as $ and two hexadecimal digits: `id="finish%20A"` is `ID="<FINISH$20>A"`.
[[nodiscard]] std::string comment_text(std::string_view text, bool capitals);

}  // namespace capstan::controls::fanuc
