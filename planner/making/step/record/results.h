#pragma once

#include <optional>
#include <string>
#include <vector>

#include "planner/ground/base/job.h"
#include "planner/making/draft/draft.h"
#include "planner/making/draft/recorded.h"
#include "planner/making/optimise/feeds.h"
#include "planner/making/toolpath/path_job.h"

// Result of a step: time, limits, excess.

namespace capstan::step {

/// Appends another path to this one, over the security plane.
void append(toolpath::GeneratedPath& to, const toolpath::GeneratedPath& from);
/// Time of a path on the plan's machine, s; nothing if it cannot be computed.
[[nodiscard]] std::optional<double> seconds_of(const model::Machine& machine, const model::CutterPath& path,
                                               const model::FeedSchedule& schedule);
/// The part of a step's result that is known before the step has a path.
[[nodiscard]] model::StepResult result_of(const model::Model& m, const draft::StepDraft& step);
/// The limits of an answer; `saves_s` is the part of the cutting time that a tenth more of each saves, until
/// `keep` knows that time.
[[nodiscard]] std::vector<model::ActiveConstraint> active_of(const optimise::CutAnswer& answer);
/// Whether the feed is one that planning bound before: then it is the most, and each move has its own.
[[nodiscard]] bool feed_was_planned(const model::Plan& plan, const draft::StepDraft& step);
/// The same of the speed.
[[nodiscard]] bool speed_was_planned(const model::Plan& plan, const draft::StepDraft& step);
/// By which share of itself a limit may be exceeded at one place of a path before the step counts as
/// exceeding it. Sections come from cells (the height map's are a twentieth of the cutter wide and more), so
/// that a width or depth of cut, and with it force, torque and power, is uncertain by about so much. Default,
/// unsourced. What is above it is kept as StepResult::exceeded, and model::condemned condemns the step.
inline constexpr double kTolerableExcess = 0.1;
/// Keeps the limit that feeds exceed by more than kTolerableExcess, and warns PIP-EXCESS.
void keep_excess(const model::Model& m, const draft::StepDraft& step, const optimise::FeedAnswer& feeds,
                 model::StepResult& result, Job& job);
/// Puts the step into the plan, with its time and the seconds that its limits cost. Says PIP-SLOW of hours.
/// Where all that its limits rest on is as the plan recorded it, the recorded limits stay.
void keep(model::Plan& plan, const draft::Recorded& recorded, const draft::StepDraft& step,
          model::StepResult result, const optimise::FeedQuestion& asked, Job& job);
/// The step stays without a path: said, and kept as unplanned.
void no_path(model::Plan& plan, const draft::StepDraft& step, const std::string& why, Job& job);

}  // namespace capstan::step
