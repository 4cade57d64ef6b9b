#pragma once

#include <optional>

#include "planner/door/pipeline/paths/cuts.h"
#include "planner/door/pipeline/paths/progress.h"

// Steps that bring their path; only planner/door/pipeline/*.cpp include this.

namespace capstan::pipeline {

struct GivenPath {
  model::StepResult result;
  optimise::FeedQuestion feeds;
};

/// A given path is moves at feed; without a compensation chuck that breaks the tap, so that the thread is
/// planned as a synchronised cycle instead. Said, unless the path is such a cycle.
[[nodiscard]] bool rigid_tap(const Work& w, const StepDraft& step);

/// The step with the path, feeds and cross sections that its toolpaths say.
///
/// Sections that the file states are what loads, and feeds where these are open, are computed from; no
/// simulation is needed for it. Where the path can be measured, both are compared: PIP-SECTIONS names a
/// contradiction, and where ours is the larger, ours is used. Without stated sections the measured ones are.
/// Empty   when the toolpaths hold no move.
/// Fails   when they cannot be followed, or come near what holds the piece; for the caller to tell.
[[nodiscard]] Result<std::optional<GivenPath>> given_path(Work& w, StepDraft& step, Stocks& stocks,
                                                          const Progress& progress, Cuts& cuts);

/// Measures a path and takes what it cuts from the stock. Says why not.
[[nodiscard]] std::optional<engagement::Measurement> measured(Work& w, const StepDraft& step,
                                                              const model::CutterPath& path, Stocks& stocks);

/// Says PIP-RAPID where rapids of a path that is kept cut material.
void tell_rapids(Work& w, const StepDraft& step, double removed_mm3);

/// Whether the step mills: then feeds follow the sections.
[[nodiscard]] inline bool mills(const optimise::CutQuestion& q) {
  return q.kind == optimise::CutKind::kRough || q.kind == optimise::CutKind::kFinish;
}

}  // namespace capstan::pipeline
