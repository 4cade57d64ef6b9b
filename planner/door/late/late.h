#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <vector>

#include "planner/door/late/branches.h"
#include "planner/door/late/changes.h"
#include "planner/door/late/next.h"
#include "planner/door/late/tools/tool_state.h"
#include "planner/door/pipeline/pipeline.h"
#include "planner/door/pipeline/program_check.h"
#include "planner/ground/base/job.h"
#include "planner/ground/base/result.h"
#include "planner/model/plan/decision/condemned.h"
#include "planner/model/plan/plan.h"

namespace capstan::late {

/// Limits of late binding: time and budget.
struct LatePolicy {
  /// Counted from `began`. Unset: no deadline; the improvement takes the time that it needs.
  std::optional<std::chrono::milliseconds> deadline = std::chrono::milliseconds(200);
  /// When the caller began to wait; nothing: with the call of `bind`.
  std::optional<std::chrono::steady_clock::time_point> began = std::nullopt;
  /// Objective evaluations for the fallback, per problem: few, so that it is there early whatever comes.
  std::uint32_t fallback_budget = 60;
  /// For the improvement, per problem. Both plans are repeatable; the clock decides which of them is given.
  std::uint32_t budget = 2000;
  /// Only these workingsteps are bound; nothing: all of the plan.
  std::optional<Next> next = std::nullopt;
  /// What was measured at the machine, for if and while statements.
  Measured measured = {};
  /// What the control tells of its tools beside the tool table.
  std::vector<ToolState> tools = {};
  /// The workingstep, counted from 1, that was next when their lives were told: what the plan's steps from
  /// there on cut before those that are bound now is used up. 0: it is now.
  std::size_t tools_told_at = 0;
  /// At the deadline a fallback that is not checked to its end is given up (LATE-NONE), and the call ends.
  /// Else it is finished, and the outcome is late.
  bool stop_at_deadline = false;
  /// Give also a plan that the check condemns; `LateOutcome::condemned` then says why. Never in a control.
  bool allow_findings = false;
  /// What may be decided at the machine; another plan is refused (LATE-POLICY).
  Decisions may = Decisions::all();
  /// When this is, as the caller tells it: for the record. Empty: no time is recorded.
  std::string time = {};
};

/// Result of late binding. It never contains a condemned plan, unless the policy allows it.
struct LateOutcome {
  model::Plan plan;
  /// Of a plan of which some workingsteps were bound: these alone. The program is theirs, and ends after
  /// them.
  std::optional<model::Plan> part = std::nullopt;
  std::size_t first = 0;                 ///< number of the first of them, from 1; 0: all were bound
  std::vector<std::string> reopened;     ///< which ways were taken, and what the machine's state re-opened
  std::vector<Change> changes;           ///< against the plan that was brought, in the order of steps
  std::string words;                     ///< the same for a screen (words_of)
  std::vector<model::Finding> findings;  ///< notes and warnings; no errors
  std::vector<model::Finding> of_plan;   ///< those of them that are of the plan, not of its program
  pipeline::CheckedProgram program;      ///< that of the plan, with its own findings
  std::vector<model::Condemnation> condemned;  ///< empty, unless the policy allows findings
  bool kept = false;                           ///< the plan that was brought stands: nothing was bound
  bool improved = false;                       ///< false: the fallback
  bool late = false;                           ///< the deadline was past when the plan was there
  double fallback_s = 0.0, machining_s = 0.0;  ///< machining time of the fallback, and of what was bound
};

/// Says that the deadline is past, if it is: of an answer that is given after what the caller still looks at.
void tell_late(LateOutcome& out, const LatePolicy& policy, std::chrono::steady_clock::time_point began,
               Job& job);

/// Binds at the machine the decisions that a plan leaves open, with the tools in the magazine
/// (`inputs.library`, Cutter::pocket > 0). Where all of the plan is bound, and still holds with the tools as
/// they are measured, it is checked and given as it is. Else it makes a checked fallback on a small budget;
/// then, while the deadline allows, an improvement, which is used only if it passes the check and is faster.
///
/// Of the next workingsteps (`policy.next`) alone the same, against the stock that the steps before leave:
/// nothing else is planned, swept or written. Operations that are open are planned first, once, for the whole
/// part.
///
/// If and while statements whose conditions were measured, and alternatives of a selective, are decided first
/// (branches.h).
///
/// Tools      those that are broken or without life are not used, and wear is in what they measure
///            (take_tool_states). Where the life of one ends within the plan, others take its steps
///            (relieve).
/// Decisions  what is decided here is held against `policy.may`; what the operator pinned keeps its value.
/// Record  each binding is a row of provenance (`late binding`): time, machine, tools, what was re-opened.
///
/// Time    the clock is the job's (Job::now). The deadline limits the improvement; the time of one check is
/// kept in reserve. If the deadline stops a check, the improvement is dropped. The fallback is
/// finished, late if need be, unless `stop_at_deadline`. A result after the deadline is marked `late`.
/// Progress  the improvement's stages are reported to the job, too.
/// Fails   LATE-NEXT for workingsteps that are not there; LATE-NONE when the deadline came before a checked
/// step;
///         LATE-UNSAFE when the fallback is condemned (retract and stop), LATE-OPEN when something stays open
///         (no loaded cutter fits), LATE-TOOL when a step uses a cutter that is not in the magazine,
///         LATE-LIFE when a step takes more than the life that its tool has left, and no other does it,
///         LATE-TOOL-STATE for states that cannot be,
///         LATE-POLICY for a decision that may not be taken here, LATE-PINNED where a pinned value would
///         change, PIP-... when nothing can be planned.
[[nodiscard]] Result<LateOutcome> bind(const model::Plan& plan, pipeline::Inputs inputs,
                                       const LatePolicy& policy, Job& job);

/// What there is instead of a workingstep where a call is given up at its deadline (LATE-NONE); nothing where
/// the deadline `stops` no call, or has not come.
[[nodiscard]] std::optional<Diagnostic> none_in_time(bool stops,
                                                     std::optional<std::chrono::milliseconds> deadline,
                                                     std::chrono::steady_clock::time_point began,
                                                     const std::string& file, const Job& job);

}  // namespace capstan::late
