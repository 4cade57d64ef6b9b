#pragma once

#include <optional>
#include <string>
#include <vector>

#include "planner/ground/base/job.h"
#include "planner/model/plan/plan.h"
#include "planner/model/plan/resources/machine.h"

namespace capstan::service {

/// What a control says of its machine as it runs. Nothing: as its machine file has it.
struct MachineState {
  std::optional<double> spindle_power_kw;  ///< at most, at the motor
  std::optional<unsigned> feed_override;   ///< %, 1 to 100
};

/// The machine as its state leaves it, and what that is in rows of provenance, from `sign` and the option's
/// name. States narrow only, so that one that is said again changes nothing: power and torque of the spindle
/// stay below `spindle_power_kw` at each speed.
/// Notes   LATE-OVERRIDE, that times are those of the whole feed.
void take_state(const MachineState& state, const std::string& sign, model::Machine& machine,
                std::vector<model::Provenance>& provenance, Job& job);

}  // namespace capstan::service
