#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "planner/ground/base/job.h"
#include "planner/ground/base/result.h"
#include "planner/ground/memo/memo.h"
#include "planner/making/optimise/feeds.h"
#include "planner/making/step/cut/cuts.h"
#include "planner/making/step/cut/precedents.h"
#include "planner/making/step/path/progress.h"
#include "planner/making/step/path/stocks.h"
#include "planner/making/step/path/strategy_choice.h"
#include "planner/making/step/plan_so_far.h"
#include "planner/making/toolpath/path_job.h"

// One try at a step with one cutter.

namespace capstan::step {

/// A path with the cut that it was made for.
struct PathWithCut {
  toolpath::GeneratedPath path;
  optimise::CutQuestion question;
  optimise::CutAnswer answer;
  bool depth_open = false, width_open = false;
  std::optional<FromCases> cases;          ///< what near cases said of it; unset: there is no case base
  std::string let_go;                      ///< of stated speed and feed, and why; empty: nothing
  std::optional<model::StepLoads> under;   ///< of the middle pass under an overhang, which is not measured
  std::vector<model::Rejected> thicker;    ///< depths or widths that exceeded a limit along the path
};

/// The same, measured against the stock, with its feeds.
struct MeasuredCut {
  PathWithCut made;
  std::shared_ptr<model::CutterPath> path;
  model::StepResult result;
  optimise::FeedQuestion asked;
  optimise::FeedAnswer feeds;
  std::optional<double> removed_mm3;  ///< unset where nothing was measured
  double rapid_removed_mm3 = 0.0;
  std::optional<StrategyChoice> strategy;  ///< set where rings and constant engagement were compared
};

/// What tries at steps share. Refers to what the caller keeps.
struct Means {
  Stocks& stocks;
  const Progress& progress;
  Cuts& cuts;
  Job& job;
  memo::Memo* memo = nullptr;  ///< null: every result is made
};

/// Chooses the cut and makes the path of a step with the cutter that it has; `candidate` is that cutter with
/// its start values, null for one of the file. `share`: of the depth, or of the width where the depth is not
/// open, that keeps the limits off the path.
/// Fails  PIP-INFEASIBLE where no cut keeps the limits, PIP-HOLDING, and as paths do.
[[nodiscard]] Result<PathWithCut> path_with_cut(const PlanSoFar& p, const draft::StepDraft& step,
                                                const model::Candidate* candidate, double share,
                                                const Means& means);

/// The cut that constant engagement would be asked for, without a path.
struct ConstantCut {
  optimise::CutQuestion question;
  optimise::CutAnswer answer;
  bool walled = false;  ///< it is entered between walls
};
/// Nothing where the step may not have it or no such cut keeps the limits.
[[nodiscard]] std::optional<ConstantCut> constant_cut(const PlanSoFar& p, draft::StepDraft step,
                                                      const model::Candidate* candidate, const Means& means);

/// Whether the step may have rings from the wall inwards beside those outwards.
[[nodiscard]] bool rings_inwards(const PlanSoFar& p, const draft::StepDraft& step, const Means& means);

/// Measures a path against the stock, which is cut by it, and schedules its feeds. `plan` is that of `p`.
[[nodiscard]] MeasuredCut measured_cut(model::Plan& plan, const PlanSoFar& p, const draft::StepDraft& step,
                                       PathWithCut made, const Means& means);

}  // namespace capstan::step
