#pragma once

#include <optional>
#include <vector>

#include "planner/ground/base/job.h"
#include "planner/ground/geometry/vec.h"
#include "planner/proof/verify/findings.h"
#include "planner/proof/verify/moves.h"
#include "planner/proof/verify/program/program_checks.h"

namespace capstan::verify {

/// The raw piece of a program's first set-up, as its header says: `set-up 1: the raw piece reaches from X0 Y0
/// Z-30 to X120 Y80 Z1`.
struct ToldRaw {
  long setup = 0;
  geometry::Box3 box;  ///< in its work offset, mm
};

/// Nothing where the header does not say it, or where the piece was cut before.
[[nodiscard]] std::optional<ToldRaw> told_raw(const Program& program);

/// Without a plan: rapids through what still stands of that raw piece in the first set-up (9, 10), warned and
/// unproved, for another program may have cut there before. Tools take away all that their diameter passes
/// over, and hit by what any of their kind has, a ball end of a mill, a pin of the others, for the header
/// says no more of their form: nothing is blamed that is sound. What later set-ups do is not looked at, nor
/// what comes behind a tool of unknown diameter.
void check_told_raw(const ProgramCase& c, const ToldRaw& raw, const std::vector<StepMoves>& steps,
                    Findings& findings);

}  // namespace capstan::verify
