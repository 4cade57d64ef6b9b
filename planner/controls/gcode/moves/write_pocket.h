#pragma once

#include "planner/controls/gcode/moves/face_cycles.h"
#include "planner/controls/gcode/moves/pocket_cycles.h"
#include "planner/controls/gcode/program.h"
#include "planner/controls/gcode/words.h"

namespace capstan::controls::gcode {

/// Writes a step's pocket that is asked for as a cycle of the control (`asked_pockets`), with comments on its
/// path, time and tool, the tool at the path's start. False: nothing but a comment that says why there is
/// none, where the step roughs a pocket.
bool write_pocket(const PocketOfStep& pocket, const Words& words, Program& out);

/// The same of a step's face (`asked_faces`), with a comment on what must be free around it.
bool write_face(const FaceOfStep& face, const Words& words, Program& out);

}  // namespace capstan::controls::gcode
