#pragma once

#include <string>

#include "planner/door/pipeline/work.h"

// Steps with nothing to cut; only planner/door/pipeline/*.cpp include this.

namespace capstan::pipeline {

/// Whether a step that rules proposed takes nothing off what stands: a mark in air, roughing of what another
/// feature's steps took away. A finishing pass after a step that was kept takes what bending left.
[[nodiscard]] bool in_air(const Work& w, const StepWork& step, double removed_mm3);

/// A proposed step with nothing to cut is taken out of the workplan and of its feature; said as a note. Its
/// feature is then made by the last kept step over its area (final_features). False, and
/// nothing done, when neither that nor another step of the feature is there.
[[nodiscard]] bool leave_out(Work& w, const StepWork& step, const std::string& why);

}  // namespace capstan::pipeline
