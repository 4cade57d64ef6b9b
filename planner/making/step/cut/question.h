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
                                                  const model::FeatureShape& shape,
                                                  const model::Candidate& candidate);

/// How wide a cone cuts at its depth: 2 t tan(SIG / 2), plus its flat tip; 0 when all of the cutter does, or
/// no depth is stated.
[[nodiscard]] double engaged_diameter_mm(model::TypeId operation, const model::Cutter& c,
                                         std::optional<double> depth_mm);
/// The same in a shape: where no depth is stated a countersink goes down until the hole is as wide as asked.
[[nodiscard]] double engaged_diameter_mm(model::TypeId operation, const model::Cutter& c,
                                         std::optional<double> depth_mm, const model::FeatureShape& shape);

/// The narrowest zone that the shape's sizes across state, mm; 0: none states one.
[[nodiscard]] double stated_zone_mm(const model::FeatureShape& shape);
/// The zone of a feature's sizes across, mm: stated, of the workpiece, or by `general` for a size of
/// `width_mm` (nothing: the fine class); 0: none is known.
[[nodiscard]] double zone_across_mm(const model::Model& m, model::AnyRef feature,
                                    const model::FeatureShape& shape, double width_mm,
                                    const std::optional<model::GeneralTolerance>& general);

/// What the tip may bend, mm, where the step leaves an allowance: the bent cutter must not reach the finished
/// wall, and should leave there what the next pass can cut at all, but at least half of it.
[[nodiscard]] double bending_in_allowance_mm(double left_mm, const model::Cutter& c,
                                             const model::WorkMaterial& material);
/// The same of a rough cut that leaves none: what one wall may be off. 0: no zone is known.
[[nodiscard]] double bending_of_last_rough_mm(double zone_mm);
/// What a finish may be off by bending, mm: a share of the zone. 0: no zone is known.
[[nodiscard]] double bending_of_finish_mm(double zone_mm);
/// What the tip of a finish may bend whose wall error is computed and held to this, mm. Most of the tip's
/// deflection is along the wall, or occurs while no tooth touches the wall: it may be as much as one wall may
/// be off at all, so that the wall is within its tolerance even if it were pushed off by all of it.
[[nodiscard]] double tip_beside_wall_mm(double wall_error_mm);

/// Whether the cutter's head cuts under an overhang, held by a neck.
[[nodiscard]] bool cuts_under_overhang(const model::Cutter& c);
/// Under an overhang, where a thin last pass makes the walls: its width, as that of a straight cut with the
/// same contact angle, mm, where the neck is bent by `bent_mm` in the passes before; 0: no such pass.
[[nodiscard]] double last_width_under_overhang_mm(const toolpath::PathJob& job, double bent_mm);
/// What the neck may bend in that pass, mm: as in a finish of this feature, or where an allowance stays on
/// its walls as in roughing. `q` asks for the cut.
[[nodiscard]] double bending_of_last_pass_mm(const PlanSoFar& p, const draft::StepDraft& step,
                                             const toolpath::PathJob& job, const optimise::CutQuestion& q);

/// True if levels leave terraces on the shape's walls: a slot whose section is not square, a hole that
/// narrows downwards.
[[nodiscard]] bool leaves_terraces(const model::FeatureShape& shape);

}  // namespace capstan::step
