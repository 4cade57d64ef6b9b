#pragma once

#include "planner/ground/base/job.h"
#include "planner/making/draft/draft.h"
#include "planner/model/plan/plan.h"

// What safety changes of the values that a file gives, each reported; the security planes are in
// listed_steps.h.

namespace capstan::given {

/// Changes of an operation what would damage tool or part, or what the machine lacks (PIP-CHANGED): a reamer
/// withdrawn without turning, a retract at no feed, coolant that the machine does not have.
void change_for_safety(model::Plan& plan, const draft::StepDraft& step, Job& job);

}  // namespace capstan::given
