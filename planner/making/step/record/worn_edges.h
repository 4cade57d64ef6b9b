#pragma once

#include "planner/ground/base/job.h"
#include "planner/model/plan/plan.h"

namespace capstan::casebase {
class CaseBase;
}

namespace capstan::step {

/// Edges of the plan's tools whose end is near by what cases say that they cut (casebase/tune/edges.h), this
/// plan's own cutting added: CASE-EDGE, a warning where an edge is likelier worn out than not before the plan
/// ends, else a note. A tool's edges are those whose tool instance is its id or a sister's. `cases` may be
/// null.
void tell_edges(const model::Plan& plan, const casebase::CaseBase* cases, Job& job);

}  // namespace capstan::step
