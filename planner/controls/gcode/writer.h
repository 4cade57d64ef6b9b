#pragma once

#include <string>
#include <vector>

#include "planner/controls/gcode/words.h"
#include "planner/ground/base/job.h"
#include "planner/ground/base/result.h"
#include "planner/model/plan/decision/condemned.h"
#include "planner/model/plan/plan.h"

namespace capstan::controls::gcode {

/// The plan as one program of RS-274 codes, said in the control's words. LinuxCNC's words, for example, give
///
///     (CAPSTAN STEP id="finish%20pocket" n=3 tool=2 setup=1)
///     G21 G17 G90 G94 G40 G80      units, plane, distances, feed per minute, no compensation, no cycle
///     G64 P0.01                    path tolerance: the step's, else the machine's (exact stop when it has
///     none) G54                          the set-up's work offset T2 M6                        only when the
///     tool changes: retracted, spindle and coolant off G43 H2                       the length offset of the
///     loaded tool S3000 M3 ... G0 X Y ... M8 ... G0 Z
///
/// Each step begins with a marker and the full modal state, so that a start at any marker is safe.
///
/// Frame   the set-up's; the work offset is the operator's to set. Retracts are to the top of Z in machine
///         coordinates.
/// Moves   explicit ones, no canned cycles but tapping; arcs as G2/G3 of at most half a turn with I and J,
///         whose radii agree within the last decimal after rounding; arcs flatter than half the last decimal
///         become lines. Moves without length after rounding are left out. A tapping move and its way back
///         are one.
/// Probing a workpiece_probing of the workplan becomes a stop before the step it precedes: retracted, spindle
///         and coolant off, `M0` with a message that says what to measure, what is expected, and its
///         tolerance. No move of a probe is written, whether the machine has one or not: its approach is not
///         planned and so not checked against the piece and what holds it; the operator measures by hand or
///         with a routine of the machine's own. The message says what to correct: the work offset by a
///         place; by a size the radius or the length of the next step's tool.
/// Start   a path's first point is reached by rapid from straight above it; a path's maker vouches for that.
/// Needs   each step bound: a path, a cutter with a pocket, a set-up.
/// Fails   OUT-EMPTY, OUT-OPEN (no path), OUT-TOOL, OUT-SETUP, OUT-SCHEDULE, OUT-NUMBER (not finite or out of
///         range), OUT-FEED, OUT-ARC (radii of the plan's arc disagree), OUT-TAP. Nothing is written then.
/// Warns   OUT-TOOL-LENGTH for a cutter whose functional length is not known.
/// Source  NIST RS274/NGC 3.5; dwell after a start of the spindle: Spindle::spin_up_s.
/// `condemned` (model::condemned): the reasons why the program must not be run. The header lists them; the
/// marker of each condemned step says `condemned="CODE"`, and behind it the program stops: retracted, spindle
/// and coolant off, a message, `M0`. Reasons of the whole plan stop it before its first step. Whether such a
/// program is written at all is the caller's to decide.
[[nodiscard]] Result<std::string> write(const model::Plan& plan, const Words& words,
                                        const std::vector<model::Condemnation>& condemned, Job& job);

}  // namespace capstan::controls::gcode
