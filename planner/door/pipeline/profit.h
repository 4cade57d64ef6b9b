#pragma once

#include <functional>

#include "planner/door/pipeline/pipeline.h"

// Cost and earning of a plan; only planner/door/pipeline/*.cpp include this.

namespace capstan::pipeline {

/// Time of the whole program, and what it costs: the machine by the minute, edges by their share of a life.
///
///     cost = r t + sum over steps (t_cut / T) (price + r times the change)    r: Machine::cost_per_hour / 60
///
/// Steps of unknown edge life cost no edges. A machine without a rate gets the assumed one of optimise/cut.h.
/// Source  as there: textbook machining economics.
struct Economy {
  double time_min = 0.0, cost = 0.0;
};
[[nodiscard]] Economy economy_of(const model::Plan& plan);

/// Plans for what a minute earns, as `bind` says. `plan_for` plans once, with the job it is given; the
/// diagnostics of the plan that is kept go to `job`.
[[nodiscard]] Result<model::Plan> most_profit(
    double revenue, const std::function<Result<model::Plan>(double, Job&)>& plan_for, Job& job);

}  // namespace capstan::pipeline
