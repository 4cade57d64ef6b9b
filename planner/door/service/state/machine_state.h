#pragma once

#include <optional>
#include <string>
#include <vector>

#include "planner/ground/base/job.h"
#include "planner/ground/base/result.h"
#include "planner/model/plan/plan.h"
#include "planner/model/plan/resources/machine.h"

namespace capstan::service {

/// How far an axis may go now, mm, machine coordinates.
struct AxisLimit {
  std::string axis;
  double least_mm = 0.0, most_mm = 0.0;
};

/// What a control says of its machine as it runs. Nothing: as its machine file has it.
struct MachineState {
  std::optional<double> spindle_power_kw;  ///< at most, at the motor
  std::vector<AxisLimit> axis_limits;
  std::optional<unsigned> feed_override;  ///< %, 1 to 100
};

/// "X=0:350,Z=-200:-5". Fails  OPTION-VALUE where it is not that, a range is empty, or an axis comes twice.
[[nodiscard]] Result<std::vector<AxisLimit>> parse_axis_limits(const std::string& text);

/// The machine as its state leaves it, and what that is in rows of provenance, from `sign` and the option's
/// name. States narrow only, so that one that is said again changes nothing: power and torque of the spindle
/// stay below `spindle_power_kw` at each speed, travels within the limits.
/// Notes   LATE-OVERRIDE, that times are those of the whole feed.
/// Fails   LATE-STATE where the machine has no such axis, or nothing of its travel is left.
[[nodiscard]] Status take_state(const MachineState& state, const std::string& sign, model::Machine& machine,
                                std::vector<model::Provenance>& provenance, Job& job);

}  // namespace capstan::service
