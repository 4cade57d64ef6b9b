#pragma once

#include <optional>
#include <vector>

#include "planner/door/pipeline/work.h"
#include "planner/ground/geometry/mesh_corners.h"
#include "planner/making/optimise/cut.h"
#include "planner/making/optimise/feeds.h"
#include "planner/making/toolpath/path_job.h"
#include "planner/physics/engagement/engagement.h"
#include "planner/physics/stock/height_map.h"

// What making one step needs; only planner/door/pipeline/*.cpp include this.

namespace capstan::pipeline {

/// The values a path is made from, as the nouns of the step's operation say them. Heights of material and
/// what earlier steps left are the caller's to fill.
[[nodiscard]] toolpath::PathJob job_of(const Work& w, const StepDraft& step,
                                       const model::FeatureShape& shape);

/// How far the path of a step, and the control that follows it, may leave what is wanted, mm; 0: the
/// control's own. For milling: of a step that leaves material a quarter of that, of a finishing one a tenth
/// of the tightest tolerance. Default, unsourced.
struct Deviation {
  double mm = 0.0;
  std::string why;
};
[[nodiscard]] Deviation deviation_of(const Work& w, const StepDraft& step, const toolpath::PathJob& job);

/// What the nouns say of speed and feed.
struct GivenTechnology {
  std::optional<double> rpm;  ///< positive clockwise
  std::optional<double> feed_mm_min;
};
[[nodiscard]] GivenTechnology given_technology(const model::Model& m, AnyRef operation,
                                               const model::Cutter& cutter);

/// A stated speed whose direction is not the cutter's is turned round, for this operation only; it is said.
void turn_with_the_cutter(Work& w, const StepDraft& step);

/// What was stated and could not stay goes, with a word; nothing where the word is empty.
void let_go(Work& w, StepDraft& step, const std::string& word);

/// The question for depth, width, speed and feed of a step.
[[nodiscard]] optimise::CutQuestion question_of(const Work& w, const StepDraft& step,
                                                const model::Candidate* candidate,
                                                const toolpath::PathJob& job);

/// The same for a proposed hole-making step, before any noun exists: can this cutter do it at all?
[[nodiscard]] optimise::CutQuestion hole_question(const Work& w, const model::ProposedStep& step,
                                                  const model::Candidate& candidate);

/// Gives a freeform feature the extent of the plan's mesh; leaves others alone.
void shape_from_mesh(const Work& w, const StepDraft& step, toolpath::PathJob& job);
/// The path of a freeform operation over the plan's mesh.
/// What a freeform step leaves on its surface, square to it; 0 for other steps.
[[nodiscard]] double freeform_allowance(const Work& w, const StepDraft& step);
[[nodiscard]] Result<toolpath::GeneratedPath> freeform_path(Work& w, const StepDraft& step,
                                                            const toolpath::PathJob& job,
                                                            const optimise::CutAnswer& cut,
                                                            const stock::HeightMap& map);

/// Lets the nearest case in the base, if there is one, say where speed and feed start from; never above
/// kCaseReach times the table's values. Gives the reason, or nothing.
[[nodiscard]] std::optional<model::Reason> start_from_case(const Work& w, const StepDraft& step,
                                                           const model::FeatureShape& shape,
                                                           optimise::CutQuestion& q);

/// Writes what was chosen into the nouns, and why into the ledger.
void record_cut(Work& w, StepDraft& step, const optimise::CutAnswer& answer, bool depth_open, bool width_open,
                const std::optional<model::Reason>& precedent);
/// Puts the computed path at the operation's its_toolpath, as derived.
void record_path(Work& w, const StepDraft& step, const std::shared_ptr<const model::CutterPath>& path,
                 const std::string& deviation);

/// Whether the operation brings a path that is to be executed: not one that an earlier planning computed,
/// which is computed again.
[[nodiscard]] bool has_given_path(const Work& w, const StepDraft& step);

}  // namespace capstan::pipeline
