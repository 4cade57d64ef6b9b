#pragma once

#include <optional>
#include <vector>

#include "planner/making/draft/draft.h"

// The hole that a drill makes: how deep the drill goes, and the diameter that the next tool starts from.

namespace capstan::step {

/// Diameter of the hole that a step starts from, mm. `stated_mm` is that of the chain; the drill before may
/// be wider if its requirement left its size open.
[[nodiscard]] double opened_by(double stated_mm, const model::ProposedStep& before,
                               const model::Cutter& drill);

/// How deep a drill goes with its full diameter, so that it takes all of a conical bottom that it can: its
/// tip no deeper than the cone's, its corner no deeper than the cone there. A narrower drill goes deeper than
/// the hole's wall.
[[nodiscard]] double depth_over_cone(const model::FeatureShape& hole, const model::Cutter& drill);

/// The cutting depth of a proposed step that drills over a conical bottom, with the cutter that it has now;
/// nothing for all others: theirs does not hang on the point of the drill.
[[nodiscard]] std::optional<double> depth_with_its_cutter(const draft::StepDraft& step);

/// After a proposed step has been given another cutter: its depth, and the hole that the step after it in the
/// chain finds, are those of that cutter, in drafts and nouns. `step` is one of `steps`.
void fit_to_cutter(model::Model& m, std::vector<draft::StepDraft>& steps, draft::StepDraft& step);

/// Whether another hole, on the same axis and narrower, goes on below this one's bottom.
[[nodiscard]] bool goes_on_below(const model::FeatureShape& hole, const model::FeatureShape& other);

}  // namespace capstan::step
