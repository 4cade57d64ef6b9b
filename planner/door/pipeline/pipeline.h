#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "planner/ground/base/job.h"
#include "planner/ground/base/result.h"
#include "planner/ground/geometry/kept_outlines.h"
#include "planner/ground/memo/memo.h"
#include "planner/making/given/listed_steps.h"
#include "planner/making/given/tool_material_wish.h"
#include "planner/making/optimise/cut.h"
#include "planner/model/plan/cutter/cutter.h"
#include "planner/model/plan/edit/edit.h"
#include "planner/model/plan/needed_tool.h"
#include "planner/model/plan/order/cut_before.h"
#include "planner/model/plan/plan.h"
#include "planner/model/plan/resources/machine.h"
#include "planner/model/plan/resources/material.h"
#include "planner/physics/mechanics/loads/margin.h"
#include "planner/proof/verify/verify.h"
#include "rules/rules.h"
#include "tooling/library/cutters/holders.h"
#include "tooling/shop/fixtures/fixtures.h"

namespace capstan::casebase {
class CaseBase;
}

namespace capstan::pipeline {

using given::Reopen;

/// The extent to which decisions are bound. The others stay open in the file; the machine binds them.
enum class Bind : std::uint8_t { kNone, kStrategy, kTools, kAll };

using Objective = optimise::Aim;

/// Input of planning from shop and caller. All by value: planning changes none of it.
struct Inputs {
  model::Machine machine;
  std::vector<model::Cutter> library;
  std::vector<model::WorkMaterial> materials;
  rules::RuleBase rules;
  std::shared_ptr<const casebase::CaseBase> cases;  ///< may be null: no precedents
  std::optional<std::string> material_name;         ///< overrides the file's
  std::optional<geometry::Box3> stock;              ///< overrides the file's, workpiece coordinates, mm
  std::optional<double> stock_allowance_mm;         ///< stock: the finished part grown by this
  /// Those two are what the plan itself was made with, taken again. Nobody named them now, so they do not
  /// settle what the plan's file says in two ways.
  bool material_of_plan = false, stock_of_plan = false;
  optimise::Solver solver = optimise::Solver::kNlopt;
  optimise::Backends backends;
  Objective objective = Objective::kTime;
  /// margin of loads against limits; unset: that of the plan that is planned again, or the usual one
  std::optional<mechanics::MarginPolicy> margin;
  /// Objective::kProfit: revenue of a piece less its material, in the currency of Machine::cost_per_hour.
  std::optional<double> revenue;
  bool constant_feeds =
      false;  ///< one feed for the whole path of a step: the largest that all its sections allow
  std::string general_tolerance;  ///< "ISO 2768-m", "ISO 22081 0.2", "+-0.1"; empty: the file's, or none
  std::string
      workholding;  ///< ids or a file, see tooling/shop/fixtures; "auto"; empty or "none": not planned
  std::vector<tooling::Fixture> own_fixtures = {};  ///< of the shop, which `workholding` may name
  int batch = 1;                                    ///< pieces
  double edge_break_mm = 0.0;                 ///< chamfer on edges that the part leaves sharp; 0: none
  std::vector<model::Provenance> provenance;  ///< origin of each input: named or default
  /// What the operator wants, in the order in which it was said. Restrictions hold while operations, tools
  /// and cuts are chosen; values are set into the plan that comes of it, and what depends on them is planned
  /// anew.
  std::vector<model::Edit> edits;
  /// Tools that steps may not have here, for the state of the machine: as prohibitions of the operator while
  /// open tools are chosen, and no edits of the plan.
  std::vector<model::Edit> kept_off = {};
  given::ToolMaterialWish tool_materials;  ///< of tools whose file or list does not state it
  tooling::ShopHolders holders = {};       ///< of tools whose file or list does not state theirs
  /// Results of earlier plannings; changes how long planning takes and nothing else. Null: those of this one
  /// only.
  std::shared_ptr<memo::Memo> memo;
  /// What checks found of steps, in memory only: a step that nothing touched since is not swept again. Null:
  /// every check is whole. The findings are the same.
  std::shared_ptr<memo::Memo> proofs;
  /// Outlines that earlier plannings offset and combined. Null: those of this one only.
  std::shared_ptr<geometry::KeptOutlines> outlines;
};

/// Plannings for most profit, the first for least cost among them; two or three usually do.
inline constexpr int kMostPlannings = 5;

/// Some steps of a plan, by their numbers from 0 in the order in which its workplan has them. Those before
/// are cut, as the plan that is brought has them (its first results); those after are still to come.
struct Window {
  std::size_t first = 0, count = 1;
};

struct Policy {
  Reopen reopen = Reopen::kNothing;
  Bind bind = Bind::kAll;
  /// Late binding: only cutters that are in the magazine (Cutter::pocket > 0) may be used.
  bool only_loaded_cutters = false;
  /// Late binding: only these steps, whose operations are chosen, are bound, against the stock that the steps
  /// before them leave. The plan that comes of it has the results of these steps alone.
  std::optional<Window> window = std::nullopt;
};

/// Closes what is open in a plan: proposes operations, picks cutters, orders the steps, and for each step in
/// order chooses depths, makes the path, measures it against the stock and schedules feed and speed.
///
/// A contradiction of the file on material or raw piece is settled if the inputs name one
/// (model/plan/decision/contradicted.h).
/// Values bound by the file are kept; a change that safety forces is reported. A feature that cannot be
/// planned is in Plan::unplanned with its reason; that is an outcome, not an error. It is made completely or
/// not at all: if a proposed step finds no cutter, no path or no cut within the limits, its chain is given up
/// and the plan is made again with the next one (each chain once), at last without the feature. Features that
/// rest on an unplanned feature are not planned either; Unplanned::needed_by names it.
/// Objective::kProfit makes (revenue - cost) / time largest: the plan is made for least cost first, then
/// again with what a minute earned in it, until that stays within a thousandth or kMostPlannings are made;
/// the best of them is kept (W. Dinkelbach, Management Science 13 (1967) 492-498). A piece that loses money
/// even at least cost is planned so, and PIP-LOSS says it. Determinism  same inputs, any number of threads:
/// same plan. Fails        PIP-… when nothing can be planned at all: no workpiece, no machine, a set-up that
/// is none;
///              PIP-REVENUE for profit without a revenue; PIP-STOPPED when the job was stopped or its
///              deadline came.
[[nodiscard]] Result<model::Plan> bind(model::Plan plan, const Inputs& inputs, const Policy& policy,
                                       Job& job);

/// What there is instead of a plan where the work on it was stopped (PIP-STOPPED).
[[nodiscard]] Diagnostic stopped_planning(const model::Plan& plan);

/// How often a plan that the check condemns is made anew, at most.
inline constexpr int kMostReplannings = 5;

/// A plan, and what the check says of it; it is the last word.
struct Checked {
  model::Plan plan;
  std::vector<model::Finding> findings;  ///< of the plan; those of a program are the caller's to ask for
  int replanned = 0;                     ///< which of the tries this is; 0: the first
  std::chrono::steady_clock::duration checking{};  ///< what checking it took
  bool budget_spent = true;  ///< false: planned with a larger evaluation budget it comes out the same
  std::vector<model::NeededTool> needed = {};  ///< what its unplanned features lack; not proved
  std::shared_ptr<const verify::ReadPart> part = nullptr;  ///< of just this plan, as it was checked
  /// Steps of earlier tries that are made in another way or left out: names, and what the check found of
  /// them.
  std::vector<std::pair<std::string, std::string>> replaced = {};
};

/// A plan and what the check says of it. `proofs`: Inputs::proofs. `before`, where the plan's steps are a
/// window: what was cut before them.
[[nodiscard]] Checked checked(model::Plan plan, Job& job, memo::Memo* proofs = nullptr,
                              const model::CutBefore* before = nullptr);

/// Until when plans are made anew, and which plans may be given at all (nothing: any): what it says of the
/// first one ends `bind_checked`, of a later one only that one is passed over. `tells_needed`: tools that the
/// plan's features lack are proved, told and recorded, which may plan it twice more.
struct Anew {
  std::optional<std::chrono::steady_clock::time_point> until = std::nullopt;
  std::function<Status(const model::Plan&)> acceptable = {};
  bool tells_needed = true;
};

/// `bind`, then the check (`verify::check_plan`). If it finds an error at a proposed step, the step's choice
/// is banned (cutter, chain, at last the feature) and the plan is made again, at most kMostReplannings times;
/// the plan with the fewest errors is returned. Each replanning is noted with its reason (PIP-ANEW) and
/// recorded in the ledger among the rejected alternatives. A plan without errors costs one check. A plan with
/// open decisions is not checked.
///
/// With Inputs::edits the values that they set are set into that plan, and what depends on them is planned
/// anew (given/edits/operator_edits.h); findings name the edits of their step, and a broken edit is one
/// (EDIT-BROKEN). `bind` alone knows only what edits restrict.
///
/// Determinism  as `bind`, unless `Anew::until` is past: then nothing more is made anew, and what is there so
///              far is given, with its findings.
/// Fails        as `bind`; EDIT-… for edits that cannot be; PIP-STOPPED when the job was stopped, or its
/// deadline came, before all was done.
[[nodiscard]] Result<Checked> bind_checked(const model::Plan& plan, const Inputs& inputs,
                                           const Policy& policy, Job& job, const Anew& anew = {});

}  // namespace capstan::pipeline
