#include "planner/making/step/cut/ranking.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "planner/ground/base/number.h"
#include "planner/ground/vocabulary/operation.h"
#include "planner/ground/vocabulary/thread_mill.h"
#include "planner/making/step/cut/drilled_hole.h"
#include "planner/making/step/cut/precedents.h"
#include "planner/making/step/cut/question.h"
#include "planner/making/step/path/job_of.h"
#include "planner/making/step/path/strategy_choice.h"
#include "planner/model/nouns/all.h"
#include "planner/model/plan/resources/changed_by_hand.h"
#include "tooling/library/nouns/nouns.h"

namespace capstan::step {

using draft::StepDraft;

void take_cutter(model::Plan& plan, std::vector<StepDraft>& steps, StepDraft& step,
                 const model::Candidate& c) {
  std::erase_if(step.rejected_tools, [&](const auto& r) { return r.what == c.cutter.id; });
  plan.model.get<model::MachiningOperation>(step.operation)->its_tool =
      tooling::tool_noun(plan.model, c.cutter);
  fit_to_cutter(plan.model, steps, step);
  plan.ledger.bind(step.operation, "its_tool", model::Binder::kToolSelection, c.why,
                   {{step.step, "its_operation"}}, step.rejected_tools);
}

void keep_in_magazine(const model::Machine& machine, const std::vector<StepDraft>& steps, StepDraft& step) {
  const auto pockets = static_cast<std::size_t>(std::max(0, machine.magazine_pockets));
  if (model::changed_by_hand(machine) || step.candidates.size() < 2) return;
  const std::string own = std::exchange(step.cutter.id, {});
  const std::vector<std::string> others = draft::cutters_of(steps);
  step.cutter.id = own;
  if (others.size() < pockets) return;
  const auto dropped = step.candidates.drop_if([&](const model::Candidate& c) {
    return c.cutter.id != own && std::find(others.begin(), others.end(), c.cutter.id) == others.end();
  });
  for (const auto& c : dropped)
    step.rejected_tools.push_back({c->cutter.id, "the other steps' tools fill the magazine"});
}

namespace {

constexpr std::size_t kCompared = 5;
/// What returns and links add to the time of a cut of constant engagement, and how sure an estimate has to be
/// before another cutter is taken for it. Default, unsourced.
constexpr double kReturns = 1.25;
constexpr double kNever = 1e12;  // s: no path, or no path within the limits

bool is_used(const std::vector<std::string>& used, const model::Cutter& c) {
  return std::find(used.begin(), used.end(), c.id) != used.end();
}

/// Seconds of a face: whole passes over its longer side, and the cutter's own width at the ends of each.
double face_s(const toolpath::PathJob& job, const optimise::CutQuestion& q, const optimise::CutAnswer& a) {
  constexpr double kSlack = 1e-9;
  const double length = geometry::area(job.shape.area) / q.width_mm;
  const double passes = std::ceil(q.width_mm / a.ae_mm - kSlack);
  return 60.0 * a.levels * passes * (length + q.cutter.cutting_diameter_mm) / a.feed_mm_min;
}

/// Takes the candidates in this order, then the others. Records who `lost`, and of the one that was first
/// until now `why_not`, where it is neither first nor among those.
void in_order(model::Plan& plan, std::vector<StepDraft>& steps, StepDraft& step,
              const std::vector<std::size_t>& order, std::vector<model::Rejected> lost,
              const std::string& why_not) {
  const std::string first = step.candidates.front().cutter.id;
  step.candidates.prefer(order);
  const bool known = step.candidates.front().cutter.id == first ||
                     std::any_of(lost.begin(), lost.end(), [&](const auto& r) { return r.what == first; });
  if (!known) lost.push_back({first, why_not});
  if (lost.empty()) return;
  step.cutter = step.candidates.front().cutter;
  for (model::Rejected& r : lost) {
    std::erase_if(step.rejected_tools, [&](const auto& other) { return other.what == r.what; });
    step.rejected_tools.push_back(std::move(r));
  }
  take_cutter(plan, steps, step, step.candidates.front());
}

/// The candidates that were compared by their times, the first of them first, then the others.
void in_order(model::Plan& plan, std::vector<StepDraft>& steps, StepDraft& step,
              std::vector<std::pair<double, std::size_t>> times) {
  const double of_first = times.front().first;
  std::stable_sort(times.begin(), times.end());
  std::vector<std::size_t> order;
  for (const auto& [t, i] : times) order.push_back(i);
  in_order(
      plan, steps, step, order, {},
      "fits, but takes " +
          (of_first < kNever ? trimmed(of_first, 1) + " s" : std::string("too long, or breaks a limit,")) +
          " against " + trimmed(times.front().first, 1) + " s of " +
          step.candidates[order.front()].cutter.id);
}

}  // namespace

void rank_by_time(model::Plan& plan, const PlanSoFar& p, std::vector<StepDraft>& steps, StepDraft& step,
                  const std::vector<std::string>& used, Stocks& stocks, const Progress& progress,
                  Cuts& cuts) {
  if (step.candidates.size() < 2 || step.shapes.empty()) return;
  const bool plane = model::has(step.operation.type, model::OperationTrait::kPlane);
  if (!plane && !(model::has(step.operation.type, model::OperationTrait::kRoughs) &&
                  model::has(step.operation.type, model::OperationTrait::kWalls))) {
    return;
  }
  const std::size_t n = std::min(kCompared, step.candidates.size());
  std::vector<std::pair<double, std::size_t>> times;
  std::optional<model::Rejected> failed;  // the first, where near cases failed
  for (std::size_t i = 0; i < n; ++i) {
    StepDraft trial = step;
    trial.cutter = step.candidates[i].cutter;
    auto job = job_of(p, trial, step.shapes.front());
    progress.prepare(trial, stocks.of(trial.setup), job);
    auto q = question_of(p, trial, &step.candidates[i], job);
    const auto cases =
        step.open_technology ? start_from_cases(p, trial, step.shapes.front(), q) : std::nullopt;
    double t = kNever * static_cast<double>(i + 1);
    const double volume = geometry::area(job.shape.area) * q.depth_mm;
    const auto take = [&](double factor) {
      const auto a = cuts.answer(q);
      if (!a || !a->feasible) return;
      const bool face = plane && q.width_mm > 0.0;
      t = std::min(t, factor * (face ? face_s(job, q, cuts.in_one_pass(q, *a))
                                     : estimated_seconds(q, *a, volume, false)));
    };
    take(1.0);
    // Constant engagement may want another cutter: a longer edge, more teeth.
    if (may_engage_constantly(p, trial, job) && !q.slot && !q.constant_engagement) {
      q.constant_engagement = true;
      take(kReturns);
    }
    // Cuts that are made in vain take their time, too.
    if (t < kNever && cases && cases->advice.good + cases->advice.bad > 0)
      t *= casebase::kTrustInTable / cases->advice.success;
    if (t < kNever && !is_used(used, trial.cutter)) t += plan.machine.tool_change_s;
    times.emplace_back(t, i);
    if (i == 0 && cases && cases->advice.lowered)
      failed = {trial.cutter.id, std::string(kFirstFailed) + cases->advice.why + ": " +
                                     casebase::words_of(cases->advice.cases, 3, cases->advice.cuts())};
  }
  in_order(plan, steps, step, std::move(times));
  if (failed && step.cutter.id != failed->what) step.rejected_tools.push_back(*std::move(failed));
}

void rank_by_path(model::Plan& plan, std::vector<StepDraft>& steps, StepDraft& step,
                  const std::vector<std::string>& used,
                  const std::function<std::optional<double>(std::size_t)>& seconds) {
  if (step.candidates.size() < 2 || step.shapes.empty()) return;
  const model::CutterClass first = step.candidates.front().cutter.cutter_class;
  if (!model::has(first, model::CutterTrait::kSlotForm) && !model::mills_threads(first)) return;
  std::vector<std::pair<double, std::size_t>> times;
  for (std::size_t i = 0; i < std::min(kCompared, step.candidates.size()); ++i) {
    const double change = is_used(used, step.candidates[i].cutter) ? 0.0 : plan.machine.tool_change_s;
    const auto t = seconds(i);
    times.emplace_back(t ? *t + change : kNever * static_cast<double>(i + 1), i);
  }
  in_order(plan, steps, step, std::move(times));
}

namespace {

/// Of each diameter the mill with the roundest corner up to a quarter of it, which leaves the lowest cusps
/// between levels; from the first candidate's diameter down. `balls`: before it the one that is rounder
/// still, which goes down into pits.
std::vector<std::size_t> of_each_diameter(const draft::Candidates& all, bool balls) {
  constexpr double kSame = 1e-6;
  constexpr double kRoundest =
      0.25;  // of the diameter: the rest is level and clears floors; default, unsourced
  struct Best {
    std::optional<std::size_t> ball, level;
  };
  std::map<double, Best, std::greater<>> best;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const model::Cutter& c = all[i].cutter;
    const double d = c.cutting_diameter_mm;
    if (d > all.front().cutter.cutting_diameter_mm + kSame) continue;
    Best& of = best[d];
    const bool round = model::end_radius_mm(c) > kRoundest * d + kSame;
    std::optional<std::size_t>& at = round ? of.ball : of.level;
    if (!at || model::end_radius_mm(c) > model::end_radius_mm(all[*at].cutter) + kSame) at = i;
  }
  std::vector<std::size_t> out;
  for (const auto& [d, of] : best) {
    if (of.ball && (balls || !of.level)) out.push_back(*of.ball);
    if (of.level) out.push_back(*of.level);
  }
  if (out.size() > kCompared) out.resize(kCompared);
  return out;
}

}  // namespace

bool rank_by_rest(model::Plan& plan, std::vector<StepDraft>& steps, StepDraft& step,
                  const std::vector<std::string>& used, bool rest,
                  const std::function<std::optional<Roughed>(std::size_t)>& roughed,
                  const std::function<void()>& best) {
  // What a wider mill cannot reach a smaller one takes at this share of its rate. Default, unsourced.
  constexpr double kRestRate = 0.25;
  constexpr double kNothingLeft = 0.002;  // of what was taken; default, unsourced
  if (step.candidates.empty()) return false;
  std::vector<std::pair<double, std::size_t>> times;
  const std::vector<std::size_t> compared = of_each_diameter(step.candidates, rest);
  double diameter = 1e300, of_diameter = kNever, of_wider = kNever;  // s, the quickest of each
  for (const std::size_t i : compared) {
    const double d = step.candidates[i].cutter.cutting_diameter_mm;
    if (d < diameter && of_diameter > of_wider) break;  // a smaller one takes longer still
    const auto t = roughed(i);
    if (!t || !(t->taken_mm3 > 0.0)) continue;
    const bool even = t->too_much_mm3 <= kNothingLeft * t->taken_mm3;
    double s = t->seconds + (is_used(used, step.candidates[i].cutter) ? 0.0 : plan.machine.tool_change_s);
    if (!even) s += t->seconds * t->too_much_mm3 / (kRestRate * t->taken_mm3) + plan.machine.tool_change_s;
    if (d < diameter) {
      of_wider = std::exchange(of_diameter, kNever);
      diameter = d;
    }
    of_diameter = std::min(of_diameter, s);
    const auto quickest = std::min_element(times.begin(), times.end());
    if (times.empty() || std::pair(s, i) < *quickest) best();
    times.emplace_back(s, i);
    if (even || (!rest && of_diameter > of_wider)) break;
  }
  if (times.empty()) return false;
  std::vector<model::Rejected> lost;
  std::stable_sort(times.begin(), times.end());
  std::vector<std::size_t> order;
  for (const auto& [t, i] : times) {
    if (!order.empty())
      lost.push_back({step.candidates[i].cutter.id, "fits, but takes " + trimmed(t, 1) +
                                                        " s with what it leaves, against " +
                                                        trimmed(times.front().first, 1) + " s"});
    order.push_back(i);
  }
  // The first candidate's diameter is the widest that is compared.
  in_order(plan, steps, step, order, std::move(lost),
           compared.front() == 0
               ? std::string("fits, but has no path within the limits that takes anything")
               : "fits, but of its diameter " + step.candidates[compared.front()].cutter.id +
                     " was compared, whose corner suits levels better");
  return true;
}

}  // namespace capstan::step
