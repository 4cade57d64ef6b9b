#pragma once

#include <vector>

#include "planner/model/plan/plan.h"
#include "planner/proof/verify/findings.h"
#include "planner/proof/verify/moves.h"

namespace capstan::verify {

/// Sweeps every tool, its shank and holder against the solids that hold the piece: 9 (rapids, axes taken as
/// not arriving together), 12 (shank and holder), 31 (clamps untouched).
///
/// Accuracy  exact in XY for lines and rapids, 5 um for arcs; a sloping line is cut into pieces. Each
///           part of the tool is taken at all heights that its piece, or its rapid, takes it through.
/// Source    derived.
void check_fixtures(const model::Plan& plan, const std::vector<StepMoves>& steps, Findings& findings);

/// Says once for each cutter what of its shank and holder is not described, so that 12 does not judge it: a
/// warning where something holds the piece, else a note.
void check_bodies(const model::Plan& plan, const std::vector<StepMoves>& steps, Findings& findings);

}  // namespace capstan::verify
