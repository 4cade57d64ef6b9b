#pragma once

#include <string>

#include "planner/making/step/plan_so_far.h"
#include "planner/making/toolpath/path_job.h"

namespace capstan::step {

/// Largest deviation of a step's path, and of the control that follows it, from the wanted surface, mm; 0:
/// use the control's own setting. Applies to milling: a quarter of the allowance of a roughing step, a tenth
/// of the tightest tolerance of a finishing step. Default, unsourced.
struct Deviation {
  double mm = 0.0;
  std::string why;
};
[[nodiscard]] Deviation deviation_of(const PlanSoFar& p, const draft::StepDraft& step,
                                     const toolpath::PathJob& job);

}  // namespace capstan::step
