#pragma once

#include <string>

#include "planner/model/plan/plan.h"

namespace capstan::verify {

/// The largest feed at which a cutter may be in a slot as wide as it is, mm/min, and what holds it.
struct SlotBound {
  double feed_mm_min = 0.0;
  std::string by;
};

/// By the check's own mean forces of a worn edge (sweep/rates.cpp): spindle, the chip that the tool bears,
/// and the force, torque and power that the plan states for the step's own path, whose limits it keeps.
[[nodiscard]] SlotBound slot_bound(const model::Plan& plan, const model::StepResult& step,
                                   const model::Cutter& cutter, double depth_mm, double rpm);

}  // namespace capstan::verify
