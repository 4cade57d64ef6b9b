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

// The stages of one try, in the order `bind` runs them. A stage gives its result and changes nothing of its
// caller's. One that decides about nouns takes the plan as a value and gives it back with nouns, decisions
// and unplanned features added; the others take it as constant, and `bind_once` puts their results into the
// plan. Only planner/door/pipeline/*.cpp include this.

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
  mechanics::MarginPolicy margin = mechanics::usual_margin();  ///< of loads against their limits
  propose::Thrift thrift = propose::Thrift::kNone;
  const step::SmallestCutters& smallest;  ///< of each set-up in the last try
  memo::Memo* memo = nullptr;             ///< results of earlier plannings; null: none
  double earning_per_min = 0.0;           ///< Objective::kProfit: earning of a machine minute above its cost
};

/// A plan with the drafts of its steps, as a stage leaves them, and what the next try has to know.
struct Drafted {
  model::Plan plan;
  Drafts drafts;
  Learned learned = {};
};

/// The demands on the features, and their shapes in the raw piece.
struct Required {
  piece::Demands demands;
  piece::Shapes shapes;
};

/// What bars tools: the edits, and the tools that steps are kept off.
[[nodiscard]] std::vector<model::Edit> restrictions_of(const Inputs& inputs);

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
/// The material that the work is of, by the caller's name, else by the part's (piece::material_of).
[[nodiscard]] Result<model::WorkMaterial> material_of(const model::Plan& plan, const Inputs& inputs,
                                                      Job& job);
/// Start values of cutters that a plan brought, which an own card gave it then, become those of the card.
[[nodiscard]] Status take_start_values(const model::WorkMaterial& card, std::vector<model::Cutter>& cutters);
/// Material, raw piece and margin.
[[nodiscard]] Result<Resolved> resolve_workpiece(const model::Plan& plan, const Inputs& inputs, Job& job);
/// General tolerance and the demands on each feature.
[[nodiscard]] Result<Required> take_requirements(const model::Plan& plan, const Asked& asked,
                                                 piece::StatedShapes stated, Job& job);
/// Proposes operations and cutters for features without bound operations.
[[nodiscard]] Drafted propose_missing(model::Plan plan, Drafts drafts, const Required& required,
                                      const Asked& asked, Job& job);
/// Cutters for given operations; then fewer of all cutters.
[[nodiscard]] Drafted select_open_tools(model::Plan plan, Drafts drafts, const Required& required,
                                        const Asked& asked, Job& job);
/// Features that rest on unplanned features become unplanned, too.
[[nodiscard]] Learned leave_what_rests(const model::Plan& plan, const Drafts& drafts);
/// The plan's unplanned features; each names the features that rest on it.
[[nodiscard]] std::vector<model::Unplanned> with_what_rests(const model::Plan& plan,
                                                            const std::vector<draft::SetupDraft>& setups);
/// Set-ups, order, and what is measured between the steps.
[[nodiscard]] Result<Drafted> order_steps(model::Plan plan, Drafts drafts, const Required& required,
                                          const Asked& asked, Job& job);
/// Fixtures and clamps of each set-up, where that is wanted.
[[nodiscard]] Result<workholding::Held> hold_workpieces(const model::Plan& plan, const Drafts& drafts,
                                                        const Asked& asked, Job& job);
/// A plan with its paths, and the optimiser's answers that hold in every try.
struct Made {
  Drafted drafted;
  step::KnownCuts cuts;
};
/// Depths, paths, sections, feeds, step by step, with the retries of one step: the next cutter, a thinner
/// cut. Of the steps before a window only what they removed counts. `cuts`: of earlier tries.
[[nodiscard]] Result<Made> make_paths(model::Plan plan, Drafts drafts, const Required& required,
                                      const Asked& asked, step::KnownCuts cuts, Job& job);
/// The plan with the results of its set-ups, tools and features; what the policy does not want bound is open.
/// Fails  PIP-OFFSETS for more set-ups than the control has work offsets.
[[nodiscard]] Result<model::Plan> close_plan(model::Plan plan, const Drafts& drafts, const Required& required,
                                             const Asked& asked, Job& job);

/// The caller's choices for every step.
[[nodiscard]] step::Wishes wishes_of(const Asked& asked);
/// How many of the drafts a window counts as cut: those that have a result.
[[nodiscard]] std::size_t cut_before(const Asked& asked, const Drafts& drafts);
/// The solver that the caller wants.
[[nodiscard]] optimise::Options options_of(const Inputs& inputs);

}  // namespace capstan::pipeline
