#pragma once

#include <vector>

#include "planner/ground/memo/memo.h"
#include "planner/model/plan/plan.h"
#include "planner/proof/verify/findings.h"

namespace capstan::verify {

struct PlannersReading;

/// What the planner reads features as, which its paths are made by, against the own reading of the file's
/// text (volumes/reading.h): 38. An error where a step cuts what is read in two ways, a warning where none
/// does; a note for what is cut and not read by both.
/// `cut_only`: of features that the plan's steps cut. `known` (may be null) remembers which readings agree.
void check_meaning(const model::Plan& plan, Findings& findings, bool cut_only = false,
                   memo::Memo* known = nullptr);
/// The same of readings that are given (compare.h): those of the planner, or with a fault in them.
void check_meaning(const model::Plan& plan, const std::vector<PlannersReading>& planner, Findings& findings,
                   memo::Memo* known = nullptr);

}  // namespace capstan::verify
