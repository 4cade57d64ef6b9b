#pragma once

#include "planner/ground/base/job.h"
#include "planner/model/plan/plan.h"

namespace capstan::casebase {
class CaseBase;
}

namespace capstan::step {

/// How many cases of the base say nothing of this plan, whatever they say: those of another machine, of
/// another material, or of a class of tools that it does not use, each counted for the first of these
/// (CASE-OTHER, a note). Nothing where there are none; `cases` may be null.
void tell_other_classes(const model::Plan& plan, const casebase::CaseBase* cases, Job& job);

}  // namespace capstan::step
