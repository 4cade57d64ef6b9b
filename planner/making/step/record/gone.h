#pragma once

#include <string>

#include "planner/ground/base/job.h"
#include "planner/making/step/plan_so_far.h"

// Steps with nothing to cut.

namespace capstan::step {

/// True if a proposed step removes nothing: a centre mark in air, or roughing of material that another
/// feature's steps removed. A finishing pass after a kept step is not left out: it cuts what bending left.
[[nodiscard]] bool in_air(const PlanSoFar& p, const draft::StepDraft& step, double removed_mm3);

/// True if a step may be left out where the check finds that it cuts nothing: roughing before a finish of its
/// feature, and the step around a boss, no finer than roughing and finishing, whose material kept steps of
/// other features remove. The feature is made without it.
[[nodiscard]] bool may_cut_nothing(const PlanSoFar& p, const draft::StepDraft& step);

/// A proposed step with nothing to cut is taken out of the workplan and of its feature; said as a note. Its
/// feature is then made by the last kept step over its area (final_features). False, and
/// nothing done, when neither that nor another step of the feature is there.
/// `plan` is that of `p`.
[[nodiscard]] bool leave_out(model::Plan& plan, const PlanSoFar& p, const draft::StepDraft& step,
                             const std::string& why, Job& job);

/// Takes a proposed step out of the workplan and of its feature.
void take_out(model::Model& m, const draft::StepDraft& step);

}  // namespace capstan::step
