#pragma once

#include <vector>

#include "planner/ground/base/job.h"
#include "planner/ground/memo/memo.h"
#include "planner/model/plan/order/cut_before.h"
#include "planner/model/plan/plan.h"
#include "planner/proof/verify/findings.h"
#include "planner/proof/verify/moves.h"

namespace capstan::verify {

struct PartShapes;
struct ReadPart;
using model::CutBefore;

/// How wide a set-up's cells are, mm: on a face of this area, with this cutter as the smallest.
[[nodiscard]] double cell_for(double area_mm2, double smallest_mm);

/// Cuts the raw piece with every move, in order, and says what must not happen: rapids through material (9,
/// 10), gouges (11), contact beyond the flutes (13), plunges and ramps (14), a stopped spindle in the
/// material (15), torque and power (17), chips (18), depth and width (20), holders in the way (12), fixtures
/// touched and the piece let go (31), steps that cut nothing (35), what stays of planned features (36).
/// Set-ups begin with what others left. `part`: read_part of the plan, keyed
/// where `known` is given.
///
/// Cost  linear in the area that the cutter sweeps, in cells. Gives false if a stop ended it before a step:
/// then the finding `kStopped` says which. `speed_shares`, where asked for, gets one number for each step
/// that was swept (StepChecks::speed_share); 1 for the others. `known`, where given, has what earlier checks
/// found of steps (known/known_steps.h). `before`: what is cut first, of which nothing is said.
bool check_removal(const model::Plan& plan, const ReadPart& part, const std::vector<StepMoves>& steps,
                   Findings& findings, Job& job, std::vector<double>* speed_shares = nullptr,
                   memo::Memo* known = nullptr, const CutBefore* before = nullptr);

}  // namespace capstan::verify
