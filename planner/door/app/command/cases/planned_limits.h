#pragma once

#include "casebase/tune/from_case.h"
#include "planner/ground/base/result.h"
#include "planner/model/plan/plan.h"

namespace capstan::app {

/// A step of a plan as tuning sees it: its question, what is expected of it, and the planner's own limits as
/// `optimise` counts them for a straight cut of the step's depth and width. Planning itself takes a tuned
/// value as a start, and holds the limits along the whole path again.
///
/// Fails   CASE-STEP as casebase::case_of.
[[nodiscard]] Result<casebase::tune::PlannedStep> planned_step(const model::Plan& plan,
                                                               const model::StepResult& step);

}  // namespace capstan::app
