#pragma once

#include <optional>
#include <vector>

#include "planner/door/pipeline/work.h"
#include "planner/model/plan/proposal.h"

namespace capstan::pipeline {

/// Of two holes on one axis, as indices of their steps, the first the narrower: it is opened first, and both
/// before either is reamed or bored, for nothing is roughed around a hole that has its size, and no edge is
/// cut on it. A thread comes when its hole has it.
void members_in_order(Work& w, const std::vector<std::size_t>& first, const std::vector<std::size_t>& second);

/// Step `at` of a chain with the hole that the drill chosen before it leaves, where its requirement left open
/// which.
[[nodiscard]] model::ProposedStep as_opened(const std::vector<model::ProposedStep>& chain, std::size_t at,
                                            const std::vector<model::Selection>& chosen);

/// How deep a drill goes with its full diameter, so that it takes all of a conical bottom that it can: its
/// tip no deeper than the cone's, its corner no deeper than the cone there. A narrower drill goes deeper than
/// the hole's wall.
[[nodiscard]] double depth_over_cone(const model::FeatureShape& hole, const model::Cutter& drill);

/// The cutting depth of a proposed step that drills over a conical bottom, with the cutter that it has now;
/// nothing for all others: theirs does not hang on the point of the drill.
[[nodiscard]] std::optional<double> depth_with_its_cutter(const StepDraft& step);

/// After a proposed step has been given another cutter: its depth, and the hole that the step after it in the
/// chain finds, are those of that cutter.
void fit_to_cutter(Work& w, StepDraft& step);

/// Says which holes have an operation that makes a thread although no feature states one: re-opened, they
/// stay plain.
void warn_of_lost_threads(Work& w);

}  // namespace capstan::pipeline
