#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "planner/base/job.h"
#include "planner/base/result.h"
#include "planner/model/cutter.h"
#include "planner/model/machine.h"
#include "planner/model/material.h"
#include "planner/model/plan.h"
#include "planner/optimise/solver/solver.h"
#include "rules/rules.h"

namespace capstan::casebase {
class CaseBase;
}

namespace capstan::pipeline {

/// What is re-opened before planning, although the file binds it. Each includes those below it.
enum class Reopen : std::uint8_t { kNothing, kTechnology, kTools, kOperations, kAll };

/// How far decisions are bound. What is left open is written open, for the machine to close.
enum class Bind : std::uint8_t { kNone, kStrategy, kTools, kAll };

enum class Objective : std::uint8_t { kTime, kCost, kProfit };

/// What the shop and the caller bring. All by value: planning changes none of it.
struct Inputs {
  model::Machine machine;
  std::vector<model::Cutter> library;
  std::vector<model::WorkMaterial> materials;
  rules::RuleBase rules;
  std::shared_ptr<const casebase::CaseBase> cases;  ///< may be null: no precedents
  std::optional<std::string> material_name;         ///< overrides the file's
  std::optional<geometry::Box3> stock;              ///< overrides the file's, workpiece coordinates, mm
  std::optional<double> stock_allowance_mm;         ///< stock: the finished part grown by this
  optimise::Solver solver = optimise::Solver::kNlopt;
  optimise::Backends backends;
  Objective objective = Objective::kTime;
  std::string general_tolerance;  ///< "ISO 2768-m", "ISO 22081 0.2", "+-0.1"; empty: the file's, or none
  std::string workholding;        ///< ids or a file, see tooling/holding; "auto"; empty or "none": not planned
  int batch = 1;                  ///< pieces
  double edge_break_mm = 0.0;     ///< edges that the part leaves sharp are chamfered by this; 0: left
  std::vector<model::Provenance> provenance;  ///< what was named, what is a default
};

struct Policy {
  Reopen reopen = Reopen::kNothing;
  Bind bind = Bind::kAll;
  /// Late binding: only cutters that are in the magazine (Cutter::pocket > 0) may be used.
  bool only_loaded_cutters = false;
};

/// Closes what is open in a plan: proposes operations, picks cutters, orders the steps, and for each step in
/// order chooses depths, makes the path, measures it against the stock and schedules feed and speed.
///
/// What the file binds is kept; a change that safety forces is reported. A feature that cannot be planned is
/// in Plan::unplanned with its reason; that is an outcome, not an error.
/// Determinism  same inputs, any number of threads: same plan.
/// Fails        PIP-… when nothing can be planned at all: no workpiece, no machine, a set-up that is none.
[[nodiscard]] Result<model::Plan> bind(model::Plan plan, const Inputs& inputs, const Policy& policy,
                                       Job& job);

}  // namespace capstan::pipeline
