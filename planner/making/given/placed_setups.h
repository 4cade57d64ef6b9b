#pragma once

#include <string>
#include <vector>

#include "planner/ground/base/job.h"
#include "planner/ground/base/result.h"
#include "planner/making/draft/draft.h"
#include "planner/model/plan/plan.h"

namespace capstan::given {

/// Where workpiece, raw piece and security plane of a set-up are in its program
/// (model/features/setup_place.h), as its nouns state them. Tells what is assumed where they state nothing
/// (PIP-SETUP), that the set-up is turned on the table (PIP-SETUP-TURNED), and that the control is to shift
/// or turn the workpiece, which no program does (PIP-SETUP-OFFSET).
/// Fails  as model::placement for a placement that is none.
[[nodiscard]] Status place_setup(const model::Plan& plan, draft::SetupDraft& setup, Job& job);

/// Why a step that the file states cannot be cut in its set-up by a tool along Z: the axis of its feature, or
/// of its toolpath, leans there. Names the angle and the placement that leans it, and what to do; empty: it
/// can.
[[nodiscard]] std::string leans_in_setup(const model::Plan& plan, const draft::SetupDraft& setup,
                                         const draft::StepDraft& step);

/// Warns of set-ups of the file that lean the workpiece, so that features got set-ups that planning made
/// (PIP-SETUP-LEANS).
void tell_leaning_setups(const model::Plan& plan, const std::vector<draft::SetupDraft>& setups,
                         const std::vector<draft::StepDraft>& steps, Job& job);

}  // namespace capstan::given
