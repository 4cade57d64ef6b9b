#pragma once

#include "casebase/tune/from_case.h"
#include "planner/ground/base/result.h"
#include "planner/model/plan/plan.h"

namespace capstan::service {

/// A step of a plan as tuning sees it: its question, what is expected of it, and the planner's own limits.
///
/// Held     peak force against the holding, power and torque of the spindle, bending of tip and wall,
///          roughness asked, the largest chip of the cutter, speeds of spindle and cutter, feeds of the axes,
///          chatter where the machine states modes; by the largest load of the planned path.
/// Not held the start values of speed and feed, which are what tuning is for (a feed is, where nobody says
///          the largest of the cutter), and an edge's life, which tuning watches as wear.
///
/// /// Fails   CASE-STEP as casebase::case_of.
[[nodiscard]] Result<casebase::tune::PlannedStep> planned_step(const model::Plan& plan,
                                                               const model::StepResult& step);

}  // namespace capstan::service
