#pragma once

#include <optional>

#include "planner/making/optimise/feeds.h"
#include "planner/making/step/cut/cuts.h"
#include "planner/making/step/path/progress.h"
#include "planner/physics/engagement/engagement.h"

// Steps that bring their path.

namespace capstan::step {

struct GivenPath {
  model::StepResult result;
  optimise::FeedQuestion feeds;
};

/// A given path is moves at feed; without a compensation chuck that breaks the tap, so that the thread is
/// planned as a synchronised cycle instead. Said, unless the path is such a cycle.
[[nodiscard]] bool rigid_tap(const model::Plan& plan, const draft::StepDraft& step, Job& job);

/// The step with the path, feeds and cross sections that its toolpaths say.
///
/// Sections that the file states are what loads, and feeds where these are open, are computed from; no
/// simulation is needed for it. Where the path can be measured, both are compared: PIP-SECTIONS names a
/// contradiction, and where ours is the larger, ours is used. Without stated sections the measured ones are.
/// What is chosen goes into the nouns of `plan`, which is that of `p`.
/// Empty   when the toolpaths hold no move.
/// Fails   when they cannot be followed, or come near what holds the piece; for the caller to tell.
[[nodiscard]] Result<std::optional<GivenPath>> given_path(model::Plan& plan, const PlanSoFar& p,
                                                          draft::StepDraft& step, Stocks& stocks,
                                                          const Progress& progress, Cuts& cuts, Job& job);

/// Measures a path and takes what it cuts from the stock. Says why not.
[[nodiscard]] std::optional<engagement::Measurement> measured(const model::Model& m,
                                                              const draft::StepDraft& step,
                                                              const model::CutterPath& path, Stocks& stocks,
                                                              Job& job);

/// Says PIP-RAPID where rapids of a path that is kept cut material by planning's account: a note, for the
/// check judges every rapid by itself.
void tell_rapids(const model::Model& m, const draft::StepDraft& step, double removed_mm3, Job& job);

}  // namespace capstan::step
