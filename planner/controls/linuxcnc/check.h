#pragma once

#include "planner/ground/base/job.h"
#include "planner/ground/base/result.h"
#include "planner/model/plan/plan.h"

namespace capstan::controls {

/// Whether a program can be written for the plan at all: every step bound, every number finite, every tool in
/// the magazine under its own number. The failures are those of `write_linuxcnc`.
[[nodiscard]] Status writable(const model::Plan& plan, Job& job);

}  // namespace capstan::controls
