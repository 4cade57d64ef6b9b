#pragma once

#include <vector>

#include "planner/proof/verify/program/program_checks.h"

namespace capstan::verify {

/// What a program does with a probe in its spindle: from its call on to where the program stops, ends, goes
/// to another step or calls another tool. At least one of the blocks ends where the probe touches.
struct Probed {
  std::vector<Block> blocks;  ///< the call first
  Block before;               ///< the block before the call; one that moved nothing where there is none
};

/// Takes what is probed out of a program: no step of a plan has these moves. A probe is a cutter of that
/// class, by plan or library, else what the program's header calls one.
[[nodiscard]] std::vector<Probed> take_probed(Program& program, const model::Plan* plan,
                                              const std::vector<model::Cutter>& cutters);

/// What was taken out is held to: 33 it is a touch of the plan each, once, behind a step of its set-up and
/// before the step that the touch precedes, with the machine's feeds and overtravel; 31 it begins and ends at
/// the top of Z, spindle and coolant off, with the work offset, the length of the probe and exact stop; over
/// the start there, straight down, along the axis, back to the start and up, and nothing else; 4 the step
/// behind calls another tool; 6 the probe's length is measured, and stands in the tool table, where there is
/// one; 9 and 31 the way read is clear (way.h). What ends at a touch elsewhere is 33, and without a plan
/// nothing is proven.
void check_probed(const ProgramCase& c, const std::vector<Probed>& probed, const ToolTable& table,
                  Findings& findings);

}  // namespace capstan::verify
