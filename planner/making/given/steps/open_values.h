#pragma once

#include "planner/making/draft/draft.h"
#include "planner/making/given/listed_steps.h"
#include "planner/model/plan/plan.h"

// What is open of a step that a file gives.

namespace capstan::given {

/// Marks in `step` whether tool, feed and speed are to be chosen; re-opens in `plan` what depends on a tool
/// that is. A path of the file fixes its cutter; pinned values stay.
void mark_open(model::Plan& plan, Reopen reopen, draft::StepDraft& step);

}  // namespace capstan::given
