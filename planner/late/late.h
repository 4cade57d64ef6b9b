#pragma once

#include <chrono>
#include <string>
#include <vector>

#include "planner/base/job.h"
#include "planner/base/result.h"
#include "planner/model/plan.h"
#include "planner/pipeline/pipeline.h"

namespace capstan::late {

/// What late binding may do, and until when.
struct LatePolicy {
  std::chrono::milliseconds deadline{200};
  /// Objective evaluations for the fallback, per problem: few, so that it is there early whatever comes.
  std::uint32_t fallback_budget = 60;
  /// For the improvement, per problem. Both plans are repeatable; the clock decides which of them is given.
  std::uint32_t budget = 2000;
};

/// What came of it. Only a plan without a finding of error severity is ever given.
struct LateOutcome {
  model::Plan plan;
  std::vector<std::string> reopened;           ///< what the machine's state re-opened, one sentence each
  std::vector<model::Finding> findings;        ///< notes and warnings; no errors
  bool improved = false;                       ///< false: the fallback
  double fallback_s = 0.0, machining_s = 0.0;  ///< machining time of the fallback, and of what is given
};

/// Closes at the machine what a plan leaves open, with the tools that are in the magazine
/// (`inputs.library`, Cutter::pocket > 0): first a verified fallback on a small budget, then, while the
/// deadline allows, an improvement, which is taken only when it is verified and faster.
///
/// Time    the deadline guards the improvement; time that verifying took once is kept in reserve. The
/// fallback
///         is always finished: a control waits for it, or stops.
/// Fails   LATE-UNSAFE when not even the fallback passes the check (retract and stop), LATE-OPEN when
///         something stays open (no loaded cutter fits), PIP-… when nothing can be planned.
[[nodiscard]] Result<LateOutcome> bind(model::Plan plan, pipeline::Inputs inputs, const LatePolicy& policy,
                                       Job& job);

}  // namespace capstan::late
