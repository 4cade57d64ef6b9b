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
#include "planner/making/propose/propose.h"
#include "planner/making/step/plan_so_far.h"

// The stages of one try, in the order `bind` runs them. Each reads what it is given and gives what it found;
// of the plan it writes nouns, ledger and what is not planned. Only planner/door/pipeline/*.cpp include this.

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
};

/// The demands on the features, and their shapes in the raw piece.
struct Required {
  piece::Demands demands;
  piece::Shapes shapes;
};

/// Excess of the raw piece over the finished part, mm.
[[nodiscard]] double grown_mm(const Inputs& inputs);

/// Puts material, machine and raw piece into the plan; returns the margin.
[[nodiscard]] Result<mechanics::MarginPolicy> resolve_workpiece(model::Plan& plan, const Inputs& inputs,
                                                                Job& job);
/// General tolerance and the demands on each feature.
[[nodiscard]] Result<Required> take_requirements(model::Plan& plan, const Asked& asked, Job& job);
/// Proposes operations and cutters for features without bound operations.
[[nodiscard]] std::pair<Drafts, Learned> propose_missing(model::Plan& plan, Drafts drafts,
                                                         const Required& required, const Asked& asked,
                                                         Job& job);
/// Cutters for given operations; then fewer of all cutters.
[[nodiscard]] Drafts select_open_tools(model::Plan& plan, Drafts drafts, const Required& required,
                                       const Asked& asked, Job& job);
/// Features that rest on unplanned features become unplanned, too.
[[nodiscard]] Learned leave_what_rests(const model::Plan& plan, const Drafts& drafts);
/// Names, at each unplanned feature, the features that rest on it.
void name_what_rests(model::Plan& plan, const std::vector<draft::SetupDraft>& setups);
/// Set-ups, order, and what is measured between the steps.
[[nodiscard]] Result<std::pair<Drafts, Learned>> order_steps(model::Plan& plan, Drafts drafts,
                                                             const Required& required, Job& job);
/// Fixtures and clamps of each set-up, where that is wanted.
[[nodiscard]] Result<Drafts> hold_workpieces(model::Plan& plan, Drafts drafts, const Asked& asked, Job& job);
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
