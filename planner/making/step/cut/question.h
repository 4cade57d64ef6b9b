#pragma once

#include <optional>

#include "planner/making/optimise/cut.h"
#include "planner/making/step/plan_so_far.h"
#include "planner/making/toolpath/path_job.h"
#include "planner/model/plan/proposal.h"

// Builds the optimiser's question for a step from its nouns and geometry.

namespace capstan::step {

/// The question for depth, width, speed and feed of a step.
[[nodiscard]] optimise::CutQuestion question_of(const PlanSoFar& p, const draft::StepDraft& step,
                                                const model::Candidate* candidate,
                                                const toolpath::PathJob& job);

/// The same for a proposed hole-making step, before any noun exists: can this cutter do it at all?
[[nodiscard]] optimise::CutQuestion hole_question(const model::Plan& plan, double margin_deviations,
                                                  const model::ProposedStep& step,
                                                  const model::Candidate& candidate);

/// Whether the step mills: then feeds follow the sections.
[[nodiscard]] inline bool mills(const optimise::CutQuestion& q) {
  return q.kind == optimise::CutKind::kRough || q.kind == optimise::CutKind::kFinish;
}

/// How wide a cone cuts at its depth: 2 t tan(SIG / 2), plus its flat tip; 0 when all of the cutter does.
[[nodiscard]] double engaged_diameter_mm(model::TypeId operation, const model::Cutter& c,
                                         std::optional<double> depth_mm);

/// True if levels leave terraces on the shape's walls: a slot whose section is not square, a hole that narrows
/// downwards.
[[nodiscard]] bool leaves_terraces(const model::FeatureShape& shape);

}  // namespace capstan::step
