#pragma once

#include "planner/making/step/plan_so_far.h"
#include "planner/making/toolpath/path_job.h"

namespace capstan::step {

/// The values a path is made from, as the nouns of the step's operation say them. Heights of material and
/// what earlier steps left are the caller's to fill.
[[nodiscard]] toolpath::PathJob job_of(const PlanSoFar& p, const draft::StepDraft& step,
                                       const model::FeatureShape& shape);

/// Whether the operation brings a path that is to be executed: not one that an earlier planning computed,
/// which is computed again.
[[nodiscard]] bool has_given_path(const model::Plan& plan, const draft::StepDraft& step);

}  // namespace capstan::step
