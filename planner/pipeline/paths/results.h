#pragma once

#include <string>
#include <vector>

#include "planner/optimise/feeds.h"
#include "planner/pipeline/work.h"

// What a step came to; only planner/pipeline/*.cpp include this.

namespace capstan::pipeline {

/// The name that messages call a step by.
[[nodiscard]] std::string name_of(const Work& w, const StepWork& step);
/// What is known of a step before it has a path.
[[nodiscard]] model::StepResult result_of(const Work& w, const StepWork& step);
/// The limits of an answer; `saves_s` is the part of the cutting time that a tenth more of each saves, until
/// `keep` knows that time.
[[nodiscard]] std::vector<model::ActiveConstraint> active_of(const optimise::CutAnswer& answer);
/// Puts the step into the plan, with its time and the seconds that its limits cost. Says PIP-SLOW of hours.
void keep(Work& w, const StepWork& step, model::StepResult result, const optimise::FeedQuestion& asked);
/// A proposed step with nothing to cut is taken out of the workplan and of its feature; said as a note. Its
/// feature is made by `made_by` (final_features). False, and nothing done, when neither that nor a step of
/// its own is there.
[[nodiscard]] bool leave_out(Work& w, const StepWork& step, Ref<model::Executable> made_by,
                             const std::string& why);
/// The step stays without a path: said, and kept as unplanned.
void no_path(Work& w, const StepWork& step, const std::string& why);

}  // namespace capstan::pipeline
