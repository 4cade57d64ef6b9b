#pragma once

#include "planner/door/pipeline/pipeline.h"
#include "planner/door/pipeline/tries.h"

// Planning within what was learned before; only planner/door/pipeline/*.cpp include this.

namespace capstan::pipeline {

/// `bind` without the choices that `tries` bans; it learns more of them on the way.
[[nodiscard]] Result<model::Plan> bind_within(const model::Plan& plan, const Inputs& inputs,
                                              const Policy& policy, Tries& tries, Job& job);

/// `bind_checked` without the values that edits set; left by a stop.
[[nodiscard]] Result<Checked> bind_anew(const model::Plan& plan, const Inputs& inputs, const Policy& policy,
                                        Job& job, const Anew& anew);
/// The same, then with them. Fails  also as given::take_edits.
[[nodiscard]] Result<Checked> bind_edited(const model::Plan& plan, const Inputs& inputs, const Policy& policy,
                                          Job& job, const Anew& anew);

/// Reports what of the case base was found altered or gone in planning (CASE-ROW), each row once.
void tell_altered_cases(const Inputs& inputs, Job& job);

/// Notes what was planned anew (PIP-ANEW).
void tell_tries(const Tries& tries, Job& job);

}  // namespace capstan::pipeline
