#pragma once

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "planner/door/pipeline/pipeline.h"
#include "planner/door/pipeline/tries.h"
#include "planner/making/draft/draft.h"
#include "planner/making/draft/recorded.h"
#include "planner/making/piece/demands.h"
#include "planner/making/piece/piece.h"
#include "planner/making/piece/workpiece.h"
#include "planner/making/propose/propose.h"
#include "planner/making/step/plan_so_far.h"
#include "planner/making/workholding/hold.h"

// The stages of one try, in the order `bind` runs them. Each reads what it is given and gives what it found.
// A stage that takes the plan as constant writes nothing into it; the others write nouns, ledger and what is
// not planned. What else a plan holds, `bind_once` alone writes. Only planner/door/pipeline/*.cpp include
// this.

namespace capstan::pipeline {

using model::AnyRef;
using model::Ref;
using propose::Drafts;

/// Input of a try; constant during the try.
struct Asked {
  const Inputs& inputs;
  const Policy& policy;
  const draft::Bans& bans;
  const draft::Recorded& recorded;
  const std::map<AnyRef, std::string>&
      unreadable;  ///< features and steps whose file states something wrongly
  mechanics::MarginPolicy margin = mechanics::kUsualMargin;  ///< of loads against their limits
  propose::Thrift thrift = propose::Thrift::kNone;
};

/// The demands on the features, and their shapes in the raw piece.
struct Required {
  piece::Demands demands;
  piece::Shapes shapes;
};

/// Excess of the raw piece over the finished part, mm.
[[nodiscard]] double grown_mm(const Inputs& inputs);

/// The operator's edits; null where there are none.
[[nodiscard]] const std::vector<model::Edit>* edits_of(const Inputs& inputs);

/// What is cut, and how carefully.
struct Resolved {
  model::WorkMaterial material;
  model::Stock raw;
  piece::Margin margin;
};
/// Material, raw piece and margin.
[[nodiscard]] Result<Resolved> resolve_workpiece(const model::Plan& plan, const Inputs& inputs, Job& job);
/// General tolerance and the demands on each feature.
[[nodiscard]] Result<Required> take_requirements(const model::Plan& plan, const Asked& asked, Job& job);
/// Proposes operations and cutters for features without bound operations.
[[nodiscard]] std::pair<Drafts, Learned> propose_missing(model::Plan& plan, Drafts drafts,
                                                         const Required& required, const Asked& asked,
                                                         Job& job);
/// Cutters for given operations; then fewer of all cutters.
[[nodiscard]] Drafts select_open_tools(model::Plan& plan, Drafts drafts, const Required& required,
                                       const Asked& asked, Job& job);
/// Features that rest on unplanned features become unplanned, too.
[[nodiscard]] Learned leave_what_rests(const model::Plan& plan, const Drafts& drafts);
/// The plan's unplanned features; each names the features that rest on it.
[[nodiscard]] std::vector<model::Unplanned> with_what_rests(const model::Plan& plan,
                                                            const std::vector<draft::SetupDraft>& setups);
/// Set-ups, order, and what is measured between the steps.
[[nodiscard]] Result<std::pair<Drafts, Learned>> order_steps(model::Plan& plan, Drafts drafts,
                                                             const Required& required, const Asked& asked,
                                                             Job& job);
/// Fixtures and clamps of each set-up, where that is wanted.
[[nodiscard]] Result<workholding::Held> hold_workpieces(const model::Plan& plan, const Drafts& drafts,
                                                        const Asked& asked, Job& job);
/// Depths, paths, sections, feeds, step by step, with the retries of one step: the next cutter, a thinner
/// cut. `steps` are those of `p`, and `plan` is its plan; of the first `cut` of them only what they removed
/// counts.
[[nodiscard]] Result<Learned> make_paths(model::Plan& plan, std::vector<draft::StepDraft>& steps,
                                         const step::PlanSoFar& p, const std::vector<std::string>& used,
                                         std::size_t cut, Tries& tries, const optimise::Options& options,
                                         Job& job);

/// The solver that the caller wants.
[[nodiscard]] optimise::Options options_of(const Inputs& inputs);

}  // namespace capstan::pipeline
