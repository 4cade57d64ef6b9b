#pragma once

#include <string_view>

#include "planner/ground/base/job.h"

namespace capstan::pipeline {

/// Makes `trial` the job of a planning within `job`'s: its threads, budget and clock, and its progress told
/// there. What the trial reports stays its own, and so does its deadline, of which it has none yet. `job`
/// outlives it.
inline void begin_trial(Job& trial, Job& job) {
  trial.threads = job.threads;
  trial.evaluation_budget = job.evaluation_budget;
  trial.set_clock(job.clock());
  trial.set_progress([&job](std::string_view stage, double fraction) { job.progress(stage, fraction); });
}

}  // namespace capstan::pipeline
