#include "planner/making/step/record/from_cases.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <string>
#include <vector>

#include "casebase/casebase.h"
#include "casebase/planned.h"
#include "planner/ground/base/number.h"
#include "planner/making/step/cut/strategies.h"
#include "planner/model/nouns/all.h"
#include "planner/physics/motion/time.h"

namespace capstan::step {
namespace {

using casebase::words_of;
using draft::StepDraft;

constexpr std::size_t kNamed = 5;  // cases in one line

std::string percent(double p) { return trimmed(100.0 * p, 0) + " %"; }

/// What a cut takes away in a minute, but for factors that two answers to one question share.
double rate(const optimise::CutAnswer& a) {
  return a.feed_mm_min * (a.ap_mm > 0.0 ? a.ap_mm : 1.0) * (a.ae_mm > 0.0 ? a.ae_mm : 1.0);
}

/// Seconds of cutting as another answer to the step's question would take them, whose question is `without`.
/// A path of the same depth and width is this step's: its feeds are scheduled again. Another path is not
/// made for it; its time is that of this one by the nominal rates.
double seconds_without(const model::Plan& plan, const PathWithCut& made, const optimise::FeedQuestion& asked,
                       const optimise::CutQuestion& without, const optimise::CutAnswer& other) {
  const model::StepResult& step = plan.steps.back();
  if (other.ap_mm == made.answer.ap_mm && other.ae_mm == made.answer.ae_mm && step.path) {
    optimise::FeedQuestion q = asked;
    q.cut = without;
    q.n_rpm = std::copysign(other.n_rpm, asked.n_rpm);
    q.feed_mm_min = other.feed_mm_min;
    q.explain = false;
    const auto t = motion::time_of(*step.path, optimise::feeds(q, *step.path).schedule, plan.machine);
    if (t) return t->cutting_s + t->dwell_s;
  }
  return step.cutting_s * rate(made.answer) / rate(other);
}

/// Where the decision on the speed stands, or on the feed where the speed is given.
model::Decision* decision_of(model::Plan& plan, const StepDraft& step) {
  const auto* op = plan.model.get<model::MachiningOperation>(step.operation);
  if (op == nullptr || !op->its_technology.set()) return nullptr;
  return plan.ledger.find(op->its_technology, step.keep_speed ? "feedrate" : "spindle");
}

/// The cut by the table, and about how long it would take.
void tell_without(model::Plan& plan, const StepDraft& step, const PathWithCut& made,
                  const optimise::FeedQuestion& asked, Cuts& cuts, CaseTally& told) {
  const FromCases& from = *made.cases;
  std::string what = "the table without cases: " +
                     words_of({from.table_vc_m_min, from.table_fz_mm, from.table_ap_most_mm, 0.0});
  const double now_s = plan.steps.back().cutting_s;
  std::string why = percent(from.advice.success_asked) + " likely to go well by these cases";
  const optimise::CutQuestion without = without_cases(from, made.question);
  auto other = cuts.answer(without);
  if (other && other->feasible && plan.model.holds<model::PlaneMilling>(step.operation))
    other = cuts.in_one_pass(without, *std::move(other));
  if (other && other->feasible && rate(*other) > 0.0) {
    const double then_s = seconds_without(plan, made, asked, without, *other);
    why +=
        ", about " + motion::duration_text(then_s) + " of cutting instead of " + motion::duration_text(now_s);
    told.with_s += now_s;
    told.without_s += then_s;
  }
  if (auto* d = decision_of(plan, step); d != nullptr)
    d->rejected.push_back({std::move(what), std::move(why)});
}

std::string step_text(const model::Plan& plan, const StepDraft& step) {
  return "step '" + draft::name_of(plan.model, step) + "': ";
}

std::string failed_text(const casebase::Advice& a) {
  std::vector<casebase::Leaned> failed;
  std::copy_if(a.cases.begin(), a.cases.end(), std::back_inserter(failed),
               [](const casebase::Leaned& c) { return c.verdict == casebase::Verdict::kBad; });
  return std::to_string(a.bad) + " of " + counted(a.cuts(), "near cut", "near cuts") + " failed (" +
         casebase::words_of(failed, 3, static_cast<std::size_t>(a.bad)) + ")";
}

/// Chains and cutters that failed cuts put behind what the step has.
void tell_behind(const model::Plan& plan, const StepDraft& step, CaseTally& told, Job& job) {
  std::vector<model::Rejected> all = step.rejected_tools;
  if (const auto* d = plan.ledger.find(step.step, "its_operation"); d != nullptr)
    all.insert(all.end(), d->rejected.begin(), d->rejected.end());
  for (const model::Rejected& r : all) {
    if (!r.why.starts_with(kFirstFailed) || r.what == step.cutter.id) continue;
    if (!told.behind.emplace(step.feature, r.what).second) continue;
    job.report({.code = "CASE-BAD-NEAR",
                .severity = Severity::kWarning,
                .message = step_text(plan, step) + "not made by " + r.what + ", which " + r.why,
                .file = plan.file_name,
                .hint = "look at the cases (capstan cases nearest); a case that is wrong can be judged anew "
                        "or removed"});
  }
}

/// By which strategies near cuts were made, and what they came to. They order none: strategies are the
/// rules'.
void tell_strategies(model::Plan& plan, const PlanSoFar& p, const StepDraft& step, const PathWithCut& made,
                     Job& job) {
  const std::string taken = casebase::strategy_of(plan, step.operation);
  if (taken.empty()) return;
  const std::vector<OfStrategy> near =
      strategies_near(p, step, step.shapes.front(), without_cases(*made.cases, made.question));
  if (near.empty()) return;
  std::string text, well;
  const OfStrategy* bad = nullptr;
  for (const OfStrategy& s : near) {
    const std::string came_to =
        s.strategy + ": " + std::to_string(s.good) + " good, " + std::to_string(s.bad) + " failed";
    text += (text.empty() ? "" : "; ") + came_to;
    if (s.strategy == taken && s.failed()) bad = &s;
    if (s.strategy != taken && s.good >= casebase::kRepeats && s.success >= casebase::kLeastSuccess)
      well += (well.empty() ? "" : "; ") + came_to;
  }
  model::Decision* d = plan.ledger.find(step.operation, "its_machining_strategy");
  if (d == nullptr) d = decision_of(plan, step);
  if (d != nullptr)
    d->rejected.push_back(
        {"ordered by near cases", "cases order no strategy; cuts near by strategy: " + text});
  if (bad == nullptr) return;
  job.report(
      {.code = "CASE-BAD-NEAR",
       .severity = Severity::kWarning,
       .message = step_text(plan, step) + "made by " + taken + ", by which " + std::to_string(bad->bad) +
                  " of " + counted(static_cast<std::size_t>(bad->good + bad->bad), "near cut", "near cuts") +
                  " failed" + (well.empty() ? "" : "; near it went well: " + well),
       .file = plan.file_name,
       .hint = "state another strategy of the operation, or look at the cases (capstan cases nearest)"});
}

constexpr const char* kWhatToDo =
    "look at them (capstan cases nearest); a case that is wrong can be judged anew or removed, and good "
    "repeats at these values lift this";

}  // namespace

void tell_cases(model::Plan& plan, const PlanSoFar& p, const StepDraft& step, const PathWithCut& made,
                const optimise::FeedQuestion& asked, Cuts& cuts, CaseTally& told, Job& job) {
  if (p.wishes.cases == nullptr || step.shapes.empty() || plan.steps.empty()) return;
  tell_behind(plan, step, told, job);
  if (made.cases && !made.cases->why_unasked.empty())
    job.warn("CASE-INVALID", step_text(plan, step) + made.cases->why_unasked + "; the table holds");
  if (made.cases && made.cases->bind()) {
    ++told.leaning;
    told.proven += made.cases->proven ? 1 : 0;
    tell_without(plan, step, made, asked, cuts, told);
  } else if (made.cases && made.cases->advice.any()) {
    ++told.weighed;
    if (auto* d = decision_of(plan, step); d != nullptr)
      d->rejected.push_back({"started from cases", made.cases->advice.why + ", which changes nothing: " +
                                                       casebase::words_of(made.cases->advice.cases, kNamed,
                                                                          made.cases->advice.cuts())});
  } else {
    ++told.none;
  }
  if (made.cases) tell_strategies(plan, p, step, made, job);
  if (made.cases && made.cases->advice.lowered) {
    ++told.lowered;
    const casebase::Advice& a = made.cases->advice;
    job.report({.code = "CASE-BAD-NEAR",
                .severity = Severity::kWarning,
                .message = step_text(plan, step) + failed_text(a) + "; it starts from " + words_of(a.start) +
                           " instead of " +
                           words_of({made.cases->table_vc_m_min, made.cases->table_fz_mm, 0.0, 0.0}) + ", " +
                           percent(a.success) + " likely to go well instead of " + percent(a.success_asked),
                .file = plan.file_name,
                .hint = kWhatToDo});
    return;
  }
  // Values that the file states, in whole or in part.
  if (step.open_technology && !step.keep_speed && !step.keep_feed) return;
  const auto judged = judged_by_cases(p, step, step.shapes.front(), made.question, made.answer);
  if (!judged || judged->success_asked >= casebase::kLeastSuccess) return;
  job.report({.code = "CASE-BAD-NEAR",
              .severity = Severity::kWarning,
              .message = step_text(plan, step) + failed_text(*judged) +
                         "; speed and feed stay as the file states "
                         "them, " +
                         percent(judged->success_asked) + " likely to go well",
              .file = plan.file_name,
              .hint = std::string("re-open the technology (--reopen), or ") + kWhatToDo});
}

void tell_all_cases(const CaseTally& told, Job& job) {
  const int all = told.leaning + told.weighed + told.none;
  if (all == 0) return;
  std::string text = std::to_string(told.leaning) + " of " +
                     counted(static_cast<std::size_t>(all), "step starts", "steps start") +
                     " from near cases";
  if (told.proven > 0) text += ", " + std::to_string(told.proven) + " of them from tuned values";
  if (told.lowered > 0) text += ", " + std::to_string(told.lowered) + " of them below failed ones";
  if (!told.behind.empty())
    text += "; " + counted(told.behind.size(), "chain or cutter", "chains or cutters") +
            " that failed before left for others";
  if (told.with_s > 0.0)
    text += ": about " + motion::duration_text(told.with_s) + " of cutting, by the table without cases " +
            motion::duration_text(told.without_s);
  if (told.weighed > 0)
    text += "; near " + std::to_string(told.weighed) + " there are cases that change nothing";
  if (told.none > 0)
    text += "; " + std::to_string(told.none) + " without a case within a distance of " +
            trimmed(casebase::kPrecedentDistance, 2) + ": there the table holds";
  job.note("CASE-USED", std::move(text));
}

}  // namespace capstan::step
