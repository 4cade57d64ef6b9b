#pragma once

#include "planner/model/plan/plan.h"
#include "planner/proof/verify/findings.h"
#include "planner/proof/verify/sweep/target/target.h"

namespace capstan::verify {

/// What the planner reads features as, which is what the other checks judge by, against the own reading of
/// the file's text (reading.h): 38. An error where a step cuts what is read in two ways, a warning where none
/// does; a note for what is cut and not read by both.
void check_meaning(const model::Plan& plan, const PartShapes& part, Findings& findings);

}  // namespace capstan::verify
