#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "planner/door/pipeline/pipeline.h"
#include "planner/door/pipeline/tries.h"
#include "planner/ground/geometry/placement.h"
#include "planner/ground/geometry/region.h"
#include "planner/ground/vocabulary/operation.h"
#include "planner/making/draft/draft.h"
#include "planner/making/draft/recorded.h"
#include "planner/making/piece/demands.h"
#include "planner/making/piece/piece.h"
#include "planner/model/features/requirements.h"
#include "planner/model/features/shape.h"
#include "planner/model/nouns/all.h"
#include "planner/model/plan/plan.h"
#include "planner/model/plan/proposal.h"

// What the stages hand to each other; only planner/door/pipeline/*.cpp include this.

namespace capstan::pipeline {

using draft::Member;
using draft::SetupDraft;
using draft::StepDraft;
using model::AnyRef;
using model::Ref;

struct Work {
  model::Plan plan;
  const Inputs& inputs;
  const Policy& policy;
  Job& job;
  Tries& tries;
  std::vector<SetupDraft> setups;
  std::vector<StepDraft> steps;           ///< in order of execution once sequenced
  std::vector<std::string> used_cutters;  ///< ids, each once: a further tool change is not asked for lightly
  draft::Recorded recorded;
  mechanics::MarginPolicy margin = mechanics::kUsualMargin;  ///< of loads against their limits
  piece::Demands demands = {};
  piece::Shapes shapes = {};                      ///< empty until the requirements are taken
  std::map<AnyRef, std::string> unreadable = {};  ///< features and steps whose file states something wrongly
  double earning_per_min = 0.0;                   ///< Objective::kProfit: what a minute earns above its cost
  std::set<AnyRef> left_out = {};                 ///< steps that were proposed and cut nothing
  bool again = false;  ///< something failed and `tries` says what: the plan is to be made again

  [[nodiscard]] piece::Piece piece() const { return {plan, shapes, inputs.stock_allowance_mm.value_or(0.0)}; }
};

// The stages, in the order bind() runs them.
Status resolve_workpiece(Work& w);      ///< material and raw piece
Status list_given(Work& w);             ///< set-ups and workingsteps of the file, what is re-opened marked
Status take_requirements(Work& w);      ///< general tolerance, what is asked of each feature
Status propose_missing(Work& w);        ///< rules and tooling for features that have no bound operations
Status leave_what_rests(Work& w);       ///< what rests on features that are not planned is not planned either
Status select_open_tools(Work& w);      ///< cutters for given operations
Status order_steps(Work& w);            ///< set-ups, order, pockets
Status hold_workpieces(Work& w);        ///< fixtures and clamps of each set-up, where that is wanted
Status carry_tools(Work& w);            ///< which tool carries out a rapid movement
Status raise_security_planes(Work& w);  ///< above the material and every feature that is cut
Status make_paths(Work& w);             ///< depths, paths, sections, feeds, step by step
Status join_paths(Work& w);             ///< given paths are reached from the security plane, and left to it

// Shared pieces.

/// Names, at each feature that is not planned, those that rest on it.
void name_what_rests(Work& w);

/// The cutters that may be used: the library, or what of it is loaded.
[[nodiscard]] std::vector<model::Cutter> usable(const Work& w);

/// The nouns of a proposed step, bound in the ledger; gives the new workingstep.
[[nodiscard]] Ref<model::MachiningWorkingstep> add_nouns(Work& w, const model::ProposedStep& step,
                                                         const model::Candidate& tool,
                                                         const model::FeatureShape& shape,
                                                         std::vector<model::Rejected> rejected_chains,
                                                         std::vector<model::Rejected> rejected_tools);
/// Puts what is to be measured before the steps that want it, once the order is known: a workpiece_probing
/// per touch, start and direction in workpiece coordinates, the distance expected from the start until the
/// ball touches (its radius taken off, and what later steps still take off).
///
/// Measured is the datum that the position refers to, where that is a hole, a pocket or an outside made
/// before in the same set-up, else the feature itself: of a hole, a pocket or an outside opposite walls in x
/// and in y, of a slot across, of a face its level. Where no start is known to be free and no wall known to
/// be there, nothing is proposed: a chain that leans on the measurement for its size is banned (by hand where
/// the probe's ball does not come); for a position PIP-PROBE says why.
void add_probings(Work& w);
/// The noun of a cutter, made once per plan.
[[nodiscard]] Ref<model::MachiningTool> tool_noun(Work& w, const model::Cutter& cutter);

}  // namespace capstan::pipeline
