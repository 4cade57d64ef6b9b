#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "planner/ground/base/job.h"
#include "planner/making/draft/draft.h"
#include "planner/making/optimise/cut.h"
#include "planner/making/step/cut/precedents.h"
#include "planner/model/plan/cutter_path.h"
#include "planner/model/plan/plan.h"

// Writes choices into the nouns and their reasons into the ledger.

namespace capstan::step {

/// Speed and feed as the nouns state them.
struct GivenTechnology {
  std::optional<double> rpm;  ///< positive clockwise
  std::optional<double> feed_mm_min;
};
[[nodiscard]] GivenTechnology given_technology(const model::Model& m, model::AnyRef operation,
                                               const model::Cutter& cutter);

/// The technology of the operation, its own: one that came with the file may serve other operations too, and
/// is copied, with who decided its values.
[[nodiscard]] model::Ref<model::MillingTechnology> own_technology(model::Plan& plan, model::AnyRef operation);

/// Reverses a stated spindle speed whose direction is not the cutter's, for this operation only, and reports
/// it.
void turn_with_the_cutter(model::Plan& plan, const draft::StepDraft& step, Job& job);

/// Drops stated values that could not be kept and reports `word`; does nothing if `word` is empty.
void let_go(const model::Model& m, draft::StepDraft& step, const std::string& word, Job& job);

/// Writes what was chosen into the nouns, and why into the ledger. `steps` are those of the plan; `cases` is
/// why speed, feed and depth start from cases, where they do.
void record_cut(model::Plan& plan, const std::vector<draft::StepDraft>& steps, const draft::StepDraft& step,
                const optimise::CutAnswer& answer, bool depth_open, bool width_open,
                const std::optional<FromCases>& cases);
/// Puts the computed path at the operation's its_toolpath, as derived.
void record_path(model::Plan& plan, const std::vector<draft::StepDraft>& steps, const draft::StepDraft& step,
                 const std::shared_ptr<const model::CutterPath>& path, const std::string& deviation);
/// Puts a path at the operation's its_toolpath. Nothing where the step has no operation.
void state_path(model::Model& m, const draft::StepDraft& step,
                const std::shared_ptr<const model::CutterPath>& path);

}  // namespace capstan::step
