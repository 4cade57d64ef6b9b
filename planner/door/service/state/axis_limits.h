#pragma once

#include <optional>
#include <string>

#include "planner/door/service/formats.h"
#include "planner/door/service/state/machine_state.h"
#include "planner/model/plan/plan.h"

namespace capstan::service {

/// Why the program of a plan, with its tool table, cannot be run within the limits of the axes that the
/// control tells and the travels of its machine, both of which hold, of each axis: LATE-PLACE with step,
/// axis, place and the narrower limit, or that the two do not meet. Nothing where no limits are told, or none
/// is left: then the place of a work offset is not known, and travels are for the control to hold.
[[nodiscard]] std::optional<Diagnostic> leaves_limits(const MachineState& state, const model::Plan& plan,
                                                      const std::string& program, const std::string& table);

/// Whether a format's programs are for another control than that of the plan's machine: they are written of
/// the plan, and are not the one that was held against the limits.
[[nodiscard]] bool is_of_other_control(const Format& format, const model::Plan& plan);
/// Why such a one is not given where limits are told: LATE-PLACE.
[[nodiscard]] Diagnostic not_held(const Format& format, const model::Plan& plan);

}  // namespace capstan::service
