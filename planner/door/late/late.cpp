#include "planner/door/late/late.h"

#include <algorithm>
#include <functional>
#include <memory>
#include <utility>

#include "planner/door/late/kept.h"
#include "planner/door/late/record.h"
#include "planner/door/pipeline/program_check.h"
#include "planner/ground/base/number.h"
#include "planner/ground/base/said_before.h"
#include "planner/ground/base/stopping.h"
#include "planner/making/given/magazine.h"
#include "planner/model/nouns/all.h"
#include "planner/model/nouns/arena/walk.h"
#include "planner/model/plan/corner_rest.h"
#include "planner/model/plan/decision/by_planning.h"

// A plan that is bound to its end and still holds is given as it is. Else a fallback first, whatever it
// takes; then an improvement on the rest of the time. Each answer passes the same four questions: is anything
// open, is every cutter in the magazine, may it be decided here, does the check condemn it. Where an
// operation finds no loaded cutter, and planning chose all operations, they are chosen once more from what is
// loaded: another chain may do without.

namespace capstan::late {
namespace {

constexpr double kSameRadiusMm = 1e-6;

using TimePoint = std::chrono::steady_clock::time_point;
using Duration = std::chrono::steady_clock::duration;

double machining_s(const model::Plan& plan) {
  double t = 0.0;
  for (const auto& s : plan.steps) t += s.cutting_s + s.rapid_s;
  return t;
}

pipeline::Policy policy_of(pipeline::Reopen reopen) {
  pipeline::Policy p;
  p.only_loaded_cutters = true;
  p.reopen = reopen;
  return p;
}

/// Whether planning chose all operations and paths of the plan, and nobody pinned a value: then it may choose
/// them once more.
bool planning_chose_all(const model::Plan& plan) {
  const auto chosen = [&](model::AnyRef object, const char* attribute) {
    return model::by_planning(plan.ledger.find(object, attribute));
  };
  for (const auto& [key, decision] : plan.ledger.entries()) {
    if (decision.pinned) return false;
  }
  const std::vector<model::AnyRef> roots = {plan.project};
  for (const model::AnyRef r : model::reachable(plan.model, roots)) {
    const auto* step = plan.model.get<model::MachiningWorkingstep>(r);
    if (step == nullptr) continue;
    const auto* op = plan.model.get<model::MachiningOperation>(step->its_operation);
    if (op == nullptr || !chosen(r, "its_operation")) return false;
    if (op->its_toolpath.set() && !chosen(step->its_operation, "its_toolpath")) return false;
  }
  return true;
}

std::string ms(Duration d) {
  return std::to_string(std::chrono::duration_cast<std::chrono::milliseconds>(d).count()) + " ms";
}

/// No answer may use a cutter that is not in the table, however it came into the plan.
Status only_loaded(const model::Plan& plan, const std::vector<model::Cutter>& magazine) {
  for (const model::StepResult& step : plan.steps) {
    const model::Cutter* cutter = model::find_cutter(plan, step.cutter_id);
    const model::Cutter* there = cutter == nullptr ? nullptr : given::loaded_like(magazine, *cutter);
    const std::string unmeasured = cutter == nullptr ? "" : model::offset_fault(*cutter);
    if (there != nullptr && there->pocket == cutter->pocket && unmeasured.empty()) continue;
    std::string why = "is not in the tool table";
    if (!unmeasured.empty())
      why = "has no length that can be used: " + unmeasured;
    else if (there != nullptr)
      why = "is T" + std::to_string(there->pocket) + " in the tool table and T" +
            std::to_string(cutter->pocket) + " in the plan";
    return fail(
        {.code = "LATE-TOOL",
         .message = "the tool '" + step.cutter_id + "' of step '" + model::step_id(plan, step) + "' " + why,
         .file = plan.file_name,
         .path = model::step_id(plan, step),
         .hint = "load it, or plan the step anew without its toolpath"});
  }
  return {};
}

Status nothing_open(const model::Plan& plan) {
  if (plan.unplanned.empty()) return {};
  return fail({.code = "LATE-OPEN",
               .message = "planning leaves " + counted(plan.unplanned.size(), "thing", "things") +
                          " open, first: " + plan.unplanned.front().reason,
               .file = plan.file_name,
               .hint = "load what is missing, or plan anew"});
}

/// Nobody at the machine agrees to rest material that was not agreed to when the part was planned.
Status no_more_rest(const model::Plan& brought, const model::Plan& made) {
  for (const model::CornerRest& rest : model::corner_rests(made)) {
    const auto agreed = model::corner_rest_of(brought, rest.feature);
    if (agreed && rest.radius_mm <= agreed->radius_mm + kSameRadiusMm) continue;
    return fail(
        {.code = "LATE-REST",
         .message = "with the loaded tools the inside corners of '" + rest.feature +
                    "' would keep a radius of " + trimmed(rest.radius_mm, 3) + " mm in place of " +
                    trimmed(agreed ? agreed->radius_mm : rest.stated_mm, 3) + " mm",
         .file = made.file_name,
         .path = rest.feature,
         .hint = "load a mill for these corners, or plan the part anew where the rest can be agreed to"});
  }
  return {};
}

/// Says that the deadline is past, if it is.
void tell_late(LateOutcome& out, const LatePolicy& policy, TimePoint began, Job& job) {
  const Duration passed = job.now() - began;
  out.late = policy.deadline && passed > *policy.deadline;
  if (out.late)
    job.warn("LATE-DEADLINE",
             "the deadline of " + ms(*policy.deadline) + " is past: a checked plan took " + ms(passed));
}

/// What comes of a plan that is checked, with its program; a fault where it is condemned. `checking` is what
/// both checks took.
Result<LateOutcome> judged(pipeline::Checked made, const pipeline::Inputs& inputs, const LatePolicy& policy,
                           Duration& checking, Job& job) {
  LateOutcome out;
  const auto check_start = job.now();
  out.findings = pipeline::findings_of(made, job, &out.program, inputs.proofs.get());
  poll();  // a check that was stopped proves nothing, whatever findings are allowed
  checking = made.checking + (job.now() - check_start);
  out.condemned = model::condemned(made.plan, out.findings);
  if (!out.condemned.empty() && (!policy.allow_findings || model::never_written(out.condemned))) {
    return fail(
        {.code = "LATE-UNSAFE",
         .message = "the plan does not pass the check: " + model::text_of(made.plan, out.condemned.front()),
         .file = made.plan.file_name,
         .path = out.condemned.front().step,
         .hint = "retract and stop; nothing may be cut from this plan"});
  }
  out.of_plan = std::move(made.findings);
  out.plan = std::move(made.plan);
  out.fallback_s = out.machining_s = machining_s(out.plan);
  return out;
}

/// The plan as it was brought, checked with the tools as they are; nothing where it is not bound to its end,
/// or does not hold any more. What is not given says nothing.
std::optional<LateOutcome> still_holds(const model::Plan& plan, const pipeline::Inputs& inputs,
                                       const std::function<Status(const model::Plan&)>& acceptable,
                                       const LatePolicy& policy, Duration& checking, Job& job) {
  const std::vector<Diagnostic> said = job.diagnostics();
  auto as_brought = as_it_is(plan, inputs, job);
  if (as_brought && acceptable(*as_brought)) {
    LatePolicy strict = policy;
    strict.allow_findings = false;
    auto out = judged(pipeline::checked(*std::move(as_brought), job, inputs.proofs.get()), inputs, strict,
                      checking, job);
    if (out) {
      out->kept = true;
      return *std::move(out);
    }
  }
  (void)job.take_diagnostics();
  for (const Diagnostic& d : said) job.report(d);
  return std::nullopt;
}

/// The fallback: everything, on a small budget, and checked. Steps that the check condemns are planned again
/// while half of the time is left. `checking` is what one check takes. A stop leaves it.
Result<LateOutcome> fallback(const model::Plan& plan, const pipeline::Inputs& inputs,
                             const std::function<Status(const model::Plan&)>& acceptable,
                             const LatePolicy& policy, pipeline::Reopen reopen, TimePoint began,
                             Duration& checking, Job& job) {
  std::optional<TimePoint> half;
  if (policy.deadline) half = began + *policy.deadline / 2;
  const std::uint32_t budget = std::exchange(job.evaluation_budget, policy.fallback_budget);
  auto made = pipeline::bind_checked(plan, inputs, policy_of(reopen), job, {half, acceptable});
  job.evaluation_budget = budget;
  if (!made) return tl::unexpected(made.error());
  return judged(*std::move(made), inputs, policy, checking, job);
}

/// Plans again with the whole budget; takes the plan into `out` if it is whole, checked, in time and faster.
void improve(LateOutcome& out, model::Plan plan, const pipeline::Inputs& inputs,
             const std::function<Status(const model::Plan&)>& acceptable, const LatePolicy& policy,
             pipeline::Reopen reopen, TimePoint began, Job& trial, Job& job) {
  auto better = pipeline::bind(std::move(plan), inputs, policy_of(reopen), trial);
  if (!better || !acceptable(*better)) return;
  const double t = machining_s(*better);
  const bool faster = t < out.fallback_s || !out.condemned.empty();
  if (!faster) return;
  pipeline::Checked checked = pipeline::checked(*std::move(better), trial, inputs.proofs.get());
  pipeline::CheckedProgram program;
  auto findings = pipeline::findings_of(checked, trial, &program, inputs.proofs.get());
  if (!model::condemned(checked.plan, findings).empty()) return;
  if (policy.deadline && job.now() > began + *policy.deadline) return;
  for (auto& d : trial.take_diagnostics()) job.report(std::move(d));
  out.plan = std::move(checked.plan);
  out.of_plan = std::move(checked.findings);
  out.findings = std::move(findings);
  out.program = std::move(program);
  out.condemned.clear();
  out.improved = true;
  out.machining_s = t;
}

/// What is told of an answer, and recorded in it.
void finish(LateOutcome& out, const model::Plan& brought, const pipeline::Inputs& inputs,
            const std::vector<std::string>& reopened, const LatePolicy& policy, TimePoint began, Job& job) {
  out.reopened = reopened;
  out.changes = changes(brought, out.plan);
  out.words = words_of(out.changes, out.reopened, brought, out.plan);
  record(out.plan, brought, inputs, out.reopened, policy.time);
  tell_late(out, policy, began, job);
}

}  // namespace

Result<LateOutcome> bind(model::Plan plan, pipeline::Inputs inputs, const LatePolicy& policy, Job& job) {
  const TimePoint began = policy.began.value_or(job.now());
  const std::vector<model::Cutter> magazine = inputs.library;
  // The improvement repeats most of the fallback.
  if (!inputs.memo) inputs.memo = std::make_shared<memo::Memo>();
  if (!inputs.proofs) inputs.proofs = std::make_shared<memo::Memo>();
  const model::Plan brought = plan;
  auto reopened = given::match_loaded(plan, inputs.library, job);
  if (!reopened) return tl::unexpected(reopened.error());
  const auto acceptable = [&](const model::Plan& made) -> Status {
    if (auto ok = nothing_open(made); !ok) return ok;
    if (auto ok = only_loaded(made, magazine); !ok) return ok;
    if (auto ok = no_more_rest(brought, made); !ok) return ok;
    return within_policy(brought, made, policy.may);
  };
  Duration checking{};
  auto reopen = pipeline::Reopen::kNothing;
  const auto fallen_back = [&] {
    return stoppable(
        job, [&] { return fallback(plan, inputs, acceptable, policy, reopen, began, checking, job); },
        [&]() -> Result<LateOutcome> { return tl::unexpected(pipeline::stopped_planning(plan)); });
  };
  const SaidBefore before(job);
  const auto as_brought = [&]() -> std::optional<LateOutcome> {
    if (!reopened->empty()) return std::nullopt;
    return stoppable(
        job, [&] { return still_holds(plan, inputs, acceptable, policy, checking, job); },
        [] { return std::optional<LateOutcome>(); });
  };
  if (auto holds = as_brought()) {
    finish(*holds, brought, inputs, *reopened, policy, began, job);
    return *std::move(holds);
  }
  auto out = fallen_back();
  const bool nothing_fits = !out && (out.error().code == "LATE-OPEN" || out.error().code == "LATE-UNSAFE");
  if (nothing_fits && !reopened->empty() && planning_chose_all(plan)) {
    auto said = job.take_diagnostics();
    reopen = pipeline::Reopen::kOperations;
    auto anew = fallen_back();
    if (anew) {
      reopened->push_back("with the loaded tools alone the plan's operations cannot be made (" +
                          out.error().message + "); all of them were chosen anew");
      out = std::move(anew);
    } else {
      (void)job.take_diagnostics();
      for (Diagnostic& d : said) job.report(std::move(d));
      // It can be made, but not by what may be decided here.
      if (anew.error().code == "LATE-POLICY" || anew.error().code == "LATE-PINNED") out = std::move(anew);
    }
  }
  if (!out) return out;

  // The improvement: only in the time left, with twice the time of one check in reserve.
  std::optional<TimePoint> until;
  if (policy.deadline) until = began + *policy.deadline - 2 * checking;
  const bool more =
      !job.stop_requested() && policy.budget > policy.fallback_budget && !(until && job.now() >= *until);
  if (more) {
    Job trial;
    trial.threads = job.threads;
    trial.evaluation_budget = policy.budget;
    trial.set_clock(job.clock());
    trial.set_progress([&](std::string_view stage, double fraction) { job.progress(stage, fraction); });
    if (until) trial.set_deadline(*until);
    // Who stops the call stops the improvement; the fallback is what was checked by then.
    const auto nothing_more = [] {};
    stoppable(
        job,
        [&] {
          stoppable(
              trial,
              [&] { improve(*out, std::move(plan), inputs, acceptable, policy, reopen, began, trial, job); },
              nothing_more);
        },
        nothing_more);
  }
  finish(*out, brought, inputs, *reopened, policy, began, job);
  return out;
}

}  // namespace capstan::late
