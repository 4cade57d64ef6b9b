#pragma once

#include <string>

#include "planner/ground/base/job.h"
#include "planner/making/step/plan_so_far.h"

// Steps with nothing to cut.

namespace capstan::step {

/// Whether a step that rules proposed takes nothing off what stands: a mark in air, roughing of what another
/// feature's steps took away. A finishing pass after a step that was kept takes what bending left.
[[nodiscard]] bool in_air(const PlanSoFar& p, const draft::StepDraft& step, double removed_mm3);

/// Whether a step is to cut around a boss, no finer than a roughing and a finishing pass make it, and steps
/// of other features that are kept take all of that away: the boss stands without it.
[[nodiscard]] bool cut_around(const PlanSoFar& p, const draft::StepDraft& step);

/// A proposed step with nothing to cut is taken out of the workplan and of its feature; said as a note. Its
/// feature is then made by the last kept step over its area (final_features). False, and
/// nothing done, when neither that nor another step of the feature is there.
/// `plan` is that of `p`.
[[nodiscard]] bool leave_out(model::Plan& plan, const PlanSoFar& p, const draft::StepDraft& step,
                             const std::string& why, Job& job);

}  // namespace capstan::step
