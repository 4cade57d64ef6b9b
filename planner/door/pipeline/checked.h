#pragma once

#include "planner/door/pipeline/pipeline.h"
#include "planner/door/pipeline/tries.h"

// Planning within what was learned before; only planner/door/pipeline/*.cpp include this.

namespace capstan::pipeline {

/// `bind` without the choices that `tries` bans; it learns more of them on the way.
[[nodiscard]] Result<model::Plan> bind_within(const model::Plan& plan, const Inputs& inputs,
                                              const Policy& policy, Tries& tries, Job& job);

/// Reports what of the case base was found altered or gone in planning (CASE-ROW), each row once.
void tell_altered_cases(const Inputs& inputs, Job& job);

/// Notes what was planned anew (PIP-ANEW).
void tell_tries(const Tries& tries, Job& job);

}  // namespace capstan::pipeline
