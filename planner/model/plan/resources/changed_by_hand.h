#pragma once

#include "planner/model/plan/resources/machine.h"

namespace capstan::model {

/// Whether the tools of a machine are changed by hand: it states no pocket, or one, which is the spindle
/// itself. The number of tools is then free.
[[nodiscard]] inline bool changed_by_hand(const Machine& machine) { return machine.magazine_pockets <= 1; }

}  // namespace capstan::model
