#pragma once

#include "planner/controls/dialect.h"
#include "planner/controls/gcode/words.h"
#include "planner/model/plan/resources/machine.h"

namespace capstan::controls::mach3 {

/// Mach3 on mills and routers, programs `.tap`: RS274/NGC as NIST's interpreter has it, of which Mach3's is
/// made.
///
/// Path     `G64` (constant velocity), or `G61` without a tolerance; no word says how far corners are
///          rounded: that is a setting.
///
/// Arcs     centre from the start by I and J, which is a setting unless the program says it: `G91.1` stands
///          at the head and at each step.
///
/// Tool     `T5 M6`: Mach3 stops there and waits for the cycle start, or runs the changer's macro. Its length
///          by `G43 H5`, of Mach3's own tool table, which is no file that is written: the header lists the
///          lengths.
///
/// Waits    `G4 P` and P of cycles in seconds, or milliseconds where the setting is so (option `dwell`).
///
/// Holes    `G81`, `G82`, `G85`, `G89`, and `G86` where the spindle stops at the bottom. Pecks are explicit
///          moves: where G83 is fed again is a setting.
///
/// Top      of Z by `G53 G0 Z`.
///
/// Stops    `(MSG, ...)`, then `M0`. Comments stand between ( and ); `;` is none.
///
/// Not written: taps (the spindle is not held in step), radius compensation, G59 P, block skip.
///
/// Source   Using Mach3Mill, revision 1.84, as others quote it (comments, G4, arcs, M6, G61, G64); NIST
///          RS274/NGC 3 (order of a block, cycles). The manual itself was not at hand.
extern const Dialect kDialect;

/// The words of the machine's control.
[[nodiscard]] gcode::Words words_of(const model::Machine& machine);

}  // namespace capstan::controls::mach3
