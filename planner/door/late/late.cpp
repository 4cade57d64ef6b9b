#include "planner/door/late/late.h"

#include <algorithm>
#include <functional>
#include <memory>
#include <set>
#include <utility>

#include "planner/door/late/answers.h"
#include "planner/door/late/kept/kept.h"
#include "planner/door/late/kept/other_material.h"
#include "planner/door/late/record.h"
#include "planner/door/late/tools/tool_life.h"
#include "planner/door/late/unbound.h"
#include "planner/door/pipeline/program_check.h"
#include "planner/door/pipeline/stages.h"
#include "planner/door/pipeline/trial.h"
#include "planner/ground/base/earlier_diagnostics.h"
#include "planner/ground/base/number.h"
#include "planner/ground/base/stopping.h"
#include "planner/making/given/listed_steps.h"
#include "planner/making/given/magazine.h"
#include "planner/model/plan/decision/fresh_edits.h"

// A plan that is bound to its end and still holds is given as it is. Else a fallback first, whatever it
// takes; then an improvement on the rest of the time, where the small budget of the fallback ended a search:
// else a larger one comes to the same plan. Each answer passes the same four questions: is anything open, is
// every cutter in the magazine, may it be decided here, does the check condemn it. Where an operation finds
// no loaded cutter, and planning chose all operations, they are chosen once more from what is loaded: another
// chain may do without. Where the life of a tool is told and ends within an answer, other tools take the
// steps that are left over, and it is bound once more.

namespace capstan::late {
namespace {

constexpr std::string_view kStoppedPlanning = "PIP-STOPPED";  ///< of pipeline::stopped_planning

using TimePoint = std::chrono::steady_clock::time_point;
using Duration = std::chrono::steady_clock::duration;

double machining_s(const model::Plan& plan) {
  double t = 0.0;
  for (const auto& s : plan.steps) t += s.cutting_s + s.rapid_s;
  return t;
}

/// How often an answer is bound once more for the lives of its tools. Default, unsourced.
constexpr int kMostRelieved = 4;

/// What all that one call binds has in common.
struct Call {
  const LatePolicy& policy;
  TimePoint began;
  const ToldTools& told;
  /// Where an answer may be bound once more: the plan that the first began with, which all are held against.
  std::optional<model::Plan>* brought = nullptr;
};

/// What one call binds: a plan, in a shop, for some of its steps or all.
struct Case {
  const model::Plan& plan;  ///< with what the machine's state re-opened
  const pipeline::Inputs& inputs;
  const std::optional<model::WorkMaterial>& material;  ///< the work's, now
  const LatePolicy& policy;
  std::optional<pipeline::Window> window;
  std::function<Status(const model::Plan&)> acceptable;
  TimePoint began;

  [[nodiscard]] pipeline::Policy how(pipeline::Reopen reopen) const {
    pipeline::Policy p;
    p.only_loaded_cutters = true;
    p.reopen = reopen;
    p.window = window;
    return p;
  }
  [[nodiscard]] std::optional<model::CutBefore> cut_before() const {
    if (!window) return std::nullopt;
    return model::CutBefore{plan, window->first};
  }
};

std::string ms(Duration d) {
  return std::to_string(std::chrono::duration_cast<std::chrono::milliseconds>(d).count()) + " ms";
}

}  // namespace

void tell_late(LateOutcome& out, const LatePolicy& policy, TimePoint began, Job& job) {
  if (out.late) return;
  const Duration passed = job.now() - began;
  out.late = policy.deadline && passed > *policy.deadline;
  if (out.late)
    job.warn("LATE-DEADLINE",
             "the deadline of " + ms(*policy.deadline) + " is past: a checked plan took " + ms(passed));
}

namespace {

/// What the improvement goes by.
struct Spent {
  Duration checking{};     ///< what both checks took
  bool same_plan = false;  ///< a larger budget comes to the fallback again
};

/// What comes of a plan that is checked, with its program; a fault where it is condemned. `checking` is what
/// both checks took.
Result<LateOutcome> judged(pipeline::Checked made, const Case& c, bool allow_findings, Duration& checking,
                           Job& job) {
  LateOutcome out;
  const auto check_start = job.now();
  const auto before = c.cut_before();
  out.findings =
      pipeline::findings_of(made, job, &out.program, c.inputs.proofs.get(), before ? &*before : nullptr);
  poll();  // a check that was stopped proves nothing, whatever findings are allowed
  checking = made.checking + (job.now() - check_start);
  out.condemned = model::condemned(made.plan, out.findings);
  if (!out.condemned.empty() && (!allow_findings || model::never_written(out.condemned))) {
    const model::Condemnation& told = model::foremost(out.condemned);
    return fail({.code = "LATE-UNSAFE",
                 .message = "the plan does not pass the check: " + model::text_of(made.plan, told),
                 .file = made.plan.file_name,
                 .path = told.step,
                 .hint = "retract and stop; nothing may be cut from this plan"});
  }
  out.of_plan = std::move(made.findings);
  out.plan = std::move(made.plan);
  out.fallback_s = out.machining_s = machining_s(out.plan);
  return out;
}

/// The plan as it was brought, checked with the tools as they are; nothing where it is not bound to its end,
/// or does not hold any more. What is not given says nothing.
std::optional<LateOutcome> still_holds(const Case& c, Duration& checking, Job& job) {
  const std::vector<Diagnostic> said = job.diagnostics();
  auto as_brought = as_it_is(c.plan, c.inputs, c.material, c.window, job);
  poll();
  if (as_brought && c.acceptable(*as_brought)) {
    const auto before = c.cut_before();
    auto out = judged(
        pipeline::checked(*std::move(as_brought), job, c.inputs.proofs.get(), before ? &*before : nullptr), c,
        false, checking, job);
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
/// while half of the time is left. A stop leaves it.
Result<LateOutcome> fallback(const Case& c, pipeline::Reopen reopen, Spent& spent, Job& job) {
  std::optional<TimePoint> half;
  if (c.policy.deadline) half = c.began + *c.policy.deadline / 2;
  const std::uint32_t budget = std::exchange(job.evaluation_budget, c.policy.fallback_budget);
  auto made = pipeline::bind_checked(c.plan, c.inputs, c.how(reopen), job, {half, c.acceptable});
  job.evaluation_budget = budget;
  if (!made) return tl::unexpected(made.error());
  spent.same_plan = !made->budget_spent;
  return judged(*std::move(made), c, c.policy.allow_findings, spent.checking, job);
}

/// Plans again with the whole budget; takes the plan into `out` if it is whole, checked, in time and faster.
void improve(LateOutcome& out, const Case& c, pipeline::Reopen reopen, Job& trial, Job& job) {
  auto better = pipeline::bind(c.plan, c.inputs, c.how(reopen), trial);
  if (!better || !c.acceptable(*better)) return;
  const double t = machining_s(*better);
  const bool faster = t < out.fallback_s || !out.condemned.empty();
  if (!faster) return;
  const auto cut = c.cut_before();
  const model::CutBefore* before = cut ? &*cut : nullptr;
  pipeline::Checked checked = pipeline::checked(*std::move(better), trial, c.inputs.proofs.get(), before);
  pipeline::CheckedProgram program;
  auto findings = pipeline::findings_of(checked, trial, &program, c.inputs.proofs.get(), before);
  if (!model::condemned(checked.plan, findings).empty()) return;
  if (c.policy.deadline && job.now() > c.began + *c.policy.deadline) return;
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
void finish(LateOutcome& out, const model::Plan& brought, const Case& c,
            const std::vector<std::string>& reopened, const ToldTools& told, Job& job) {
  const SharedStopScope to_its_end(nullptr);  // it is checked: who stops the call now is given it
  out.reopened = reopened;
  const bool part = c.window.has_value();
  out.changes = changes(brought, out.plan, part);
  // Times of a part are not held against those of a whole.
  static const model::Plan kNone;
  out.words = words_of(out.changes, out.reopened, part ? kNone : brought, out.plan);
  if (part) {
    out.first = c.window->first + 1;
    model::Plan whole = joined(c.plan, out.plan, *c.window);
    out.part = std::exchange(out.plan, std::move(whole));
  }
  record(out.plan, brought, c.inputs, {out.reopened, told.rows, c.policy.time});
  tell_late(out, c.policy, c.began, job);
}

/// The operations of a plan, chosen for the whole part with the tools that are loaded: those that are open,
/// or all.
Result<model::Plan> with_operations(const model::Plan& plan, const pipeline::Inputs& inputs,
                                    const LatePolicy& policy, pipeline::Reopen reopen, Job& job) {
  if (!policy.may.has(Choice::kOrder))
    return fail(
        {.code = "LATE-POLICY",
         .message = "operations would have to be chosen, and this control may not decide order (it may: " +
                    policy.may.text() + ")",
         .file = plan.file_name,
         .hint = "plan the operations first (capstan plan --bind strategy), or allow it (may)"});
  pipeline::Policy how;
  how.bind = pipeline::Bind::kStrategy;
  how.only_loaded_cutters = true;
  how.reopen = reopen;
  const std::uint32_t budget = std::exchange(job.evaluation_budget, policy.fallback_budget);
  auto out = stoppable(
      job, [&] { return pipeline::bind(plan, inputs, how, job); },
      [&]() -> Result<model::Plan> { return tl::unexpected(pipeline::stopped_planning(plan)); });
  job.evaluation_budget = budget;
  return out;
}

/// What ended a call: the deadline, where it is the deadline that stopped it.
Diagnostic as_stopped(const Diagnostic& why, const LatePolicy& policy, TimePoint began, const Job& job) {
  if (why.code != kStoppedPlanning) return why;
  return none_in_time(policy.stop_at_deadline, policy.deadline, began, why.file, job).value_or(why);
}

/// The improvement: only in the time left, with twice the time of one check in reserve.
void improve_in_time(LateOutcome& out, const Case& c, pipeline::Reopen reopen, const Spent& spent, Job& job) {
  std::optional<TimePoint> until;
  if (c.policy.deadline) until = c.began + *c.policy.deadline - 2 * spent.checking;
  const bool more = !job.stop_requested() && !spent.same_plan && c.policy.budget > c.policy.fallback_budget &&
                    !(until && job.now() >= *until);
  if (!more) return;
  Job trial;
  pipeline::begin_trial(trial, job);
  trial.evaluation_budget = c.policy.budget;
  if (until) trial.set_deadline(*until);
  // Who stops the call stops the improvement; the fallback is what was checked by then.
  const auto nothing_more = [] {};
  stoppable(
      job,
      [&] {
        stoppable(
            trial, [&] { improve(out, c, reopen, trial, job); }, nothing_more);
      },
      nothing_more);
}

/// `bind`; `why`: what was decided of the plan before. Of a large plan a copy costs more than a workingstep:
/// it is made where something of the plan is changed.
Result<LateOutcome> bind_case(const model::Plan& as_given, pipeline::Inputs inputs, const Call& call,
                              std::vector<std::string> why, Job& job) {
  const LatePolicy& policy = call.policy;
  const TimePoint began = call.began;
  const bool once_more = call.brought != nullptr && call.brought->has_value();
  const std::vector<model::Cutter> magazine = inputs.library;
  // The improvement repeats most of the fallback.
  if (!inputs.memo) inputs.memo = std::make_shared<memo::Memo>();
  if (!inputs.proofs) inputs.proofs = std::make_shared<memo::Memo>();
  poll();
  std::optional<model::Plan> changed, reopened;
  const auto as_it_came = [&]() -> const model::Plan& { return changed ? *changed : as_given; };
  const auto to_change = [&]() -> model::Plan& { return changed ? *changed : changed.emplace(as_given); };
  if (!once_more && has_branches(as_given)) {
    model::Plan& plan = to_change();
    const std::size_t bound = policy.next && policy.next->from ? *policy.next->from - 1 : plan.steps.size();
    const auto ways = take_branches(plan, policy.measured, magazine, policy.may, bound);
    if (!ways) return tl::unexpected(ways.error());
    why.insert(why.end(), ways->begin(), ways->end());
    // Results of steps behind a way that was taken are of other places in the workplan.
    if (!ways->empty() && plan.steps.size() > bound) plan.steps.resize(bound);
  }
  std::optional<pipeline::Window> window;
  std::set<model::AnyRef> operations, cut;
  poll();
  if (policy.next) {
    std::vector<model::AnyRef> steps = given::steps_in_order(as_it_came());
    if (operations_open(as_it_came(), steps)) {
      auto chosen = with_operations(as_it_came(), inputs, policy, pipeline::Reopen::kNothing, job);
      if (!chosen) return tl::unexpected(as_stopped(chosen.error(), policy, began, job));
      changed = *std::move(chosen);
      steps = given::steps_in_order(*changed);
    }
    poll();
    auto meant = window_of(as_it_came(), *policy.next, steps);
    if (!meant) return tl::unexpected(meant.error());
    window = *meant;
    if (auto ok = cut_as_bound(as_it_came(), *policy.next, *window, steps); !ok)
      return tl::unexpected(ok.error());
    operations = operations_of(as_it_came(), *window, steps);
    cut = operations_of(as_it_came(), {0, window->first}, steps);
  }
  poll();
  if (!model::fresh_edits(as_it_came().ledger).empty()) {
    model::Plan& plan = to_change();
    model::settle_edits(plan.model, plan.ledger);
  }
  poll();
  auto matched = given::match_loaded(as_it_came(), inputs.library, job, window ? &operations : nullptr,
                                     call.told.out_of_use);
  if (!matched) return tl::unexpected(matched.error());
  poll();
  if (call.brought != nullptr && !once_more) *call.brought = as_it_came();
  const model::Plan& brought = call.brought != nullptr ? **call.brought : as_it_came();
  if (!matched->open.empty() || !matched->worn.empty()) {
    reopened = as_it_came();
    for (const model::DecisionKey& key : matched->open) reopened->ledger.reopen(key);
    for (const auto& w : matched->worn)
      given::give_tool(*reopened, w.operation, w.mill, {"late.worn", w.why, "the tool table"}, {});
    poll();
  }
  const auto material = material_now(brought, inputs);
  if (material) {
    // Tools that are the plan's have what its card said.
    if (auto ok = pipeline::take_start_values(*material, inputs.library); !ok)
      return tl::unexpected(ok.error());
  }
  if (const std::string other = other_material(brought, material); !other.empty()) {
    const auto speeds = planned_speeds(brought, cut);
    if (!speeds.empty() && !reopened) reopened = as_it_came();
    for (const model::DecisionKey& key : speeds) reopened->ledger.reopen(key);
    if (window && as_it_came().steps.size() > window->first) {
      // What is known of steps from here on, their forces and lives, is of the other material.
      if (!reopened) reopened = as_it_came();
      reopened->steps.resize(window->first);
    }
    if (!speeds.empty()) why.push_back(other + ": the speeds and feeds that planning chose are chosen anew");
  }
  poll();
  const model::Plan& plan = reopened ? *reopened : as_it_came();
  why.insert(why.end(), matched->why.begin(), matched->why.end());
  const Case c{plan,
               inputs,
               material,
               policy,
               window,
               [&](const model::Plan& made) -> Status {
                 if (auto ok = nothing_open(made); !ok) return ok;
                 if (auto ok = only_loaded(made, magazine, call.told.out_of_use); !ok) return ok;
                 if (auto ok = no_more_rest(brought, made); !ok) return ok;
                 return within_policy(brought, made, policy.may, window.has_value());
               },
               began};
  Spent spent;
  auto reopen = pipeline::Reopen::kNothing;
  const auto fallen_back = [&] {
    auto made = stoppable(
        job, [&] { return fallback(c, reopen, spent, job); },
        [&]() -> Result<LateOutcome> { return tl::unexpected(pipeline::stopped_planning(plan)); });
    if (!made) made = tl::unexpected(as_stopped(made.error(), policy, began, job));
    return made;
  };
  const EarlierDiagnostics before(job);
  const auto as_brought = [&]() -> std::optional<LateOutcome> {
    if (!matched->why.empty()) return std::nullopt;
    return stoppable(
        job, [&] { return still_holds(c, spent.checking, job); },
        [] { return std::optional<LateOutcome>(); });
  };
  if (auto holds = as_brought()) {
    finish(*holds, brought, c, why, call.told, job);
    return *std::move(holds);
  }
  // What the plan takes as it was brought may be what time there was.
  if (policy.stop_at_deadline && job.stop_requested())
    return tl::unexpected(as_stopped(pipeline::stopped_planning(plan), policy, began, job));
  auto out = fallen_back();
  const auto nothing_fits = [&] {
    return !out && (out.error().code == "LATE-OPEN" || out.error().code == "LATE-UNSAFE");
  };
  if ((nothing_fits() || (!out && out.error().code == "LATE-REST")) && !matched->worn.empty()) {
    for (const auto& w : matched->worn) reopened->ledger.reopen({w.operation, "its_tool"});
    auto said = job.take_diagnostics();
    auto anew = fallen_back();
    if (anew) {
      why.push_back("as they were to be cut the mills of another diameter do not do (" + out.error().message +
                    "); their tools and cuts were chosen anew");
    } else {
      (void)job.take_diagnostics();
      for (Diagnostic& d : said) job.report(std::move(d));
    }
    if (anew || job.stop_requested()) out = std::move(anew);
  }
  const bool nothing_cut = !window || window->first == 0;
  if (nothing_fits() && nothing_cut && !matched->why.empty() && planning_chose_all(plan)) {
    const std::string anew_for = "with the loaded tools alone the plan's operations cannot be made (" +
                                 out.error().message + "); all of them were chosen anew";
    auto said = job.take_diagnostics();
    reopen = pipeline::Reopen::kOperations;
    if (window) {
      auto chosen = with_operations(plan, inputs, policy, reopen, job);
      if (!chosen) return tl::unexpected(as_stopped(chosen.error(), policy, began, job));
      // Nothing of it names a tool that is missing, so that this comes once.
      why.push_back(anew_for);
      inputs.library = magazine;
      if (call.brought != nullptr) call.brought->reset();
      return bind_case(*chosen, inputs, call, std::move(why), job);
    }
    auto anew = fallen_back();
    if (anew) {
      why.push_back(anew_for);
      out = std::move(anew);
    } else {
      (void)job.take_diagnostics();
      for (Diagnostic& d : said) job.report(std::move(d));
      // It can be made, but not by what may be decided here.
      if (anew.error().code == "LATE-POLICY" || anew.error().code == "LATE-PINNED") out = std::move(anew);
    }
  }
  if (!out) return out;
  improve_in_time(*out, c, reopen, spent, job);
  finish(*out, brought, c, why, call.told, job);
  return out;
}

/// `bind`, as often as the lives of tools ask for it.
Result<LateOutcome> bind_within_lives(const model::Plan& plan, pipeline::Inputs inputs,
                                      const LatePolicy& policy, TimePoint began, const ToldTools& told,
                                      Job& job) {
  if (!inputs.memo) inputs.memo = std::make_shared<memo::Memo>();
  if (!inputs.proofs) inputs.proofs = std::make_shared<memo::Memo>();
  const std::vector<Diagnostic> said = job.diagnostics();
  std::optional<model::Plan> brought, relieved_of_some;
  LatePolicy now = policy;
  const Call call{now, began, told, &brought};
  std::vector<std::string> why;
  std::string first;
  const auto ended = [&](const Diagnostic& with) {
    Diagnostic d = with;
    d.code = "LATE-LIFE";
    d.message = first + (with.message.empty() ? "" : ": " + with.message);
    d.hint = "change its edge, or load another tool of the same kind, and tell its life";
    return fail(std::move(d));
  };
  for (int more = 0;; ++more) {
    auto out = bind_case(relieved_of_some ? *relieved_of_some : plan, inputs, call, std::move(why), job);
    const auto of_tools = [](const std::string& c) {
      return c == "LATE-OPEN" || c == "LATE-UNSAFE" || c == "LATE-TOOL";
    };
    if (!out && more > 0 && of_tools(out.error().code)) return ended(out.error());
    if (!out) return out;
    const std::size_t cut = out->first > 0 ? out->first - 1 : 0;
    const std::size_t told_at = policy.tools_told_at > 0 ? policy.tools_told_at - 1 : cut;
    auto relieved = relieve(*out, {told, minutes_of(out->plan, told_at, cut), inputs.library});
    if (!relieved) return out;
    first = relieved->first;
    if (more == kMostRelieved) return ended({.code = {}, .message = {}, .file = out->plan.file_name});
    (void)job.take_diagnostics();  // of an answer that is not given
    for (const Diagnostic& d : said) job.report(d);
    why = std::move(out->reopened);
    why.insert(why.end(), relieved->why.begin(), relieved->why.end());
    inputs.kept_off.insert(inputs.kept_off.end(), relieved->kept_off.begin(), relieved->kept_off.end());
    relieved_of_some = std::move(relieved->plan);
    if (now.next) now.next->from = out->first;
  }
}

/// `bind`, with what the control tells of its tools.
Result<LateOutcome> bind_told(const model::Plan& plan, pipeline::Inputs inputs, const LatePolicy& policy,
                              TimePoint began, Job& job) {
  const auto told = take_tool_states(policy.tools, plan, inputs.library, job);
  if (!told) return tl::unexpected(told.error());
  auto out = told->life_left_min.empty()
                 ? bind_case(plan, std::move(inputs), {policy, began, *told}, {}, job)
                 : bind_within_lives(plan, std::move(inputs), policy, began, *told, job);
  if (out || out.error().code == "LATE-NONE") return out;
  Diagnostic d = out.error();
  d.message += told->words();
  return fail(std::move(d));
}

}  // namespace

std::optional<Diagnostic> none_in_time(bool stops, std::optional<std::chrono::milliseconds> deadline,
                                       TimePoint began, const std::string& file, const Job& job) {
  if (!stops || !deadline || job.now() < began + *deadline) return std::nullopt;
  return Diagnostic{
      .code = "LATE-NONE",
      .message = "no workingstep was bound and checked when the deadline of " + ms(*deadline) + " came",
      .file = file,
      .hint = "retract and stop; give it more time, or bind fewer workingsteps at once"};
}

Result<LateOutcome> bind(const model::Plan& plan, pipeline::Inputs inputs, const LatePolicy& policy,
                         Job& job) {
  const TimePoint began = policy.began.value_or(job.now());
  if (policy.stop_at_deadline && policy.deadline) job.set_deadline(began + *policy.deadline);
  const Diagnostic none = pipeline::stopped_planning(plan);
  return stoppable(
      job, [&] { return bind_told(plan, std::move(inputs), policy, began, job); },
      [&]() -> Result<LateOutcome> { return tl::unexpected(as_stopped(none, policy, began, job)); });
}

}  // namespace capstan::late
