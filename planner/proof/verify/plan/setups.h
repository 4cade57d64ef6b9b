#pragma once

#include "planner/proof/verify/findings.h"
#include "planner/proof/verify/sweep/target/target.h"

namespace capstan::verify {

/// How set-ups hold the workpiece: placements that cannot be read, offsets that nobody adds (3); features
/// whose axis leans against the tool's in the set-up of a step (11).
void check_setups(const model::Plan& plan, const PartShapes& part, Findings& findings);

}  // namespace capstan::verify
