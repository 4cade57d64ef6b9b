#include "planner/late/late.h"

#include <algorithm>
#include <utility>

#include "planner/pipeline/shop.h"

namespace capstan::late {
namespace {

using Clock = std::chrono::steady_clock;

double machining_s(const model::Plan& plan) {
  double t = 0.0;
  for (const auto& s : plan.steps) t += s.cutting_s + s.rapid_s;
  return t;
}

const model::Finding* first_error(const std::vector<model::Finding>& findings) {
  const auto it = std::find_if(findings.begin(), findings.end(),
                               [](const auto& f) { return f.severity == Severity::kError; });
  return it == findings.end() ? nullptr : &*it;
}

pipeline::Policy policy_of() {
  pipeline::Policy p;
  p.only_loaded_cutters = true;
  return p;
}

}  // namespace

Result<LateOutcome> bind(model::Plan plan, pipeline::Inputs inputs, const LatePolicy& policy, Job& job) {
  const auto start = Clock::now();
  LateOutcome out;
  auto reopened = pipeline::match_loaded(plan, inputs, job);
  if (!reopened) return tl::unexpected(reopened.error());
  out.reopened = *std::move(reopened);
  const model::Plan asked = plan;

  // The fallback: everything, on a small budget, and checked.
  const std::uint32_t budget = std::exchange(job.evaluation_budget, policy.fallback_budget);
  auto fallback = pipeline::bind(std::move(plan), inputs, policy_of(), job);
  job.evaluation_budget = budget;
  if (!fallback) return tl::unexpected(fallback.error());
  if (!fallback->unplanned.empty()) {
    return fail({.code = "LATE-OPEN",
                 .message = "something stays open: " + fallback->unplanned.front().reason,
                 .file = fallback->file_name,
                 .hint = "load what is missing, or plan anew"});
  }
  const auto check_start = Clock::now();
  out.findings = pipeline::findings_of(*fallback, job);
  const auto checking = Clock::now() - check_start;
  if (first_error(out.findings) != nullptr) {
    // What the check condemns is made anew, while half of the time is left.
    job.evaluation_budget = policy.fallback_budget;
    auto anew = pipeline::bind_checked(asked, inputs, policy_of(), job, start + policy.deadline / 2);
    job.evaluation_budget = budget;
    if (anew && anew->replanned > 0 && anew->plan.unplanned.empty()) {
      out.findings = pipeline::findings_of(*anew, job);
      fallback = std::move(anew->plan);
    }
  }
  if (const auto* f = first_error(out.findings)) {
    return fail({.code = "LATE-UNSAFE",
                 .message = "the plan does not pass the check: " + f->message,
                 .file = fallback->file_name,
                 .path = f->step,
                 .hint = "retract and stop; nothing may be cut from this plan"});
  }
  out.plan = *std::move(fallback);
  out.fallback_s = out.machining_s = machining_s(out.plan);

  // The improvement: only in the time left, with twice the time of one check in reserve.
  const auto passed = Clock::now() - start;
  if (passed > policy.deadline) {
    const auto ms = [](Clock::duration d) {
      return std::to_string(std::chrono::duration_cast<std::chrono::milliseconds>(d).count());
    };
    job.warn("LATE-DEADLINE", "the deadline of " + ms(policy.deadline) + " ms is past: a checked plan took " +
                                  ms(passed) + " ms; it is given all the same");
  }
  const auto until = start + policy.deadline - 2 * checking;
  if (policy.budget <= policy.fallback_budget || Clock::now() >= until) return out;
  Job trial;
  trial.threads = job.threads;
  trial.evaluation_budget = policy.budget;
  trial.set_deadline(until);
  auto better = pipeline::bind(asked, inputs, policy_of(), trial);
  if (!better || !better->unplanned.empty()) return out;
  const double t = machining_s(*better);
  if (!(t < out.fallback_s)) return out;
  auto findings = pipeline::findings_of(*better, trial);
  if (first_error(findings) != nullptr || Clock::now() > start + policy.deadline) return out;
  for (auto& d : trial.take_diagnostics()) job.report(std::move(d));
  out.plan = *std::move(better);
  out.findings = std::move(findings);
  out.improved = true;
  out.machining_s = t;
  return out;
}

}  // namespace capstan::late
