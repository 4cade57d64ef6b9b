#pragma once

#include <string>

#include "planner/making/step/plan_so_far.h"
#include "planner/making/toolpath/path_job.h"

namespace capstan::step {

/// How far the path of a step, and the control that follows it, may leave what is wanted, mm; 0: the
/// control's own. For milling: of a step that leaves material a quarter of that, of a finishing one a tenth
/// of the tightest tolerance. Default, unsourced.
struct Deviation {
  double mm = 0.0;
  std::string why;
};
[[nodiscard]] Deviation deviation_of(const PlanSoFar& p, const draft::StepDraft& step,
                                     const toolpath::PathJob& job);

}  // namespace capstan::step
