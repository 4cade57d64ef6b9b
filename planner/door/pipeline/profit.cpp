#include "planner/door/pipeline/profit.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "planner/door/pipeline/trial.h"
#include "planner/ground/base/number.h"
#include "planner/making/optimise/cut.h"
#include "planner/physics/motion/time.h"

namespace capstan::pipeline {

Economy economy_of(const model::Plan& plan) {
  Economy out;
  if (const auto t = motion::time_of(plan)) out.time_min = t->total_s() / 60.0;
  const double hour =
      plan.machine.cost_per_hour > 0.0 ? plan.machine.cost_per_hour : optimise::kMachinePerHour;
  const double rate = hour / 60.0;
  out.cost = rate * out.time_min;
  for (const model::StepResult& s : plan.steps) {
    const model::Cutter* c = model::find_cutter(plan, s.cutter_id);
    if (c == nullptr || !(s.loads.tool_life_min > 0.0)) continue;
    const double edge = std::max(0.0, c->price) + rate * plan.machine.tool_change_s / 60.0;
    out.cost += edge * s.cutting_s / 60.0 / s.loads.tool_life_min;
  }
  return out;
}

Result<model::Plan> most_profit(double revenue,
                                const std::function<Result<model::Plan>(double, Job&)>& plan_for, Job& job) {
  constexpr double kSame = 1e-3;  // of the profit per minute
  std::optional<model::Plan> best;
  std::vector<Diagnostic> said;
  Economy of_best;
  double earning = 0.0, most = 0.0;
  int made = 0;
  while (made < kMostPlannings && !(made > 0 && job.stop_requested())) {
    Job trial;
    begin_trial(trial, job);
    if (job.deadline()) trial.set_deadline(*job.deadline());
    auto planned = plan_for(earning, trial);
    if (!planned && !best) {
      for (auto& d : trial.take_diagnostics()) job.report(std::move(d));
      return planned;
    }
    if (!planned) break;
    ++made;
    const Economy e = economy_of(*planned);
    const double profit = e.time_min > 0.0 ? (revenue - e.cost) / e.time_min : 0.0;
    const bool better = !best || profit > most;
    if (better) {
      most = profit;
      of_best = e;
      best = *std::move(planned);
      said = trial.take_diagnostics();
    }
    // Of a piece that loses money, most profit per time would be to take longer.
    if (!better || !(profit > 0.0) || std::abs(profit - earning) <= kSame * profit) break;
    earning = profit;
  }
  for (auto& d : said) job.report(std::move(d));
  if (!(most > 0.0)) {
    job.warn("PIP-LOSS", "a piece brings " + trimmed(revenue, 2) + " and costs " + trimmed(of_best.cost, 2) +
                             " to machine: planned for least cost");
  }
  best->provenance.push_back({"profit", trimmed(60.0 * most, 2) + " per hour",
                              trimmed(revenue, 2) + " less " + trimmed(of_best.cost, 2) + " in " +
                                  trimmed(of_best.time_min, 2) + " min; best of " + std::to_string(made) +
                                  (made == 1 ? " planning" : " plannings")});
  return *std::move(best);
}

}  // namespace capstan::pipeline
