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

/// Whether a person's edits are set into the plan, these or those that its record names.
[[nodiscard]] bool is_edited(const Inputs& inputs);

/// How a part is planned with other inputs. What it comes to has in `unplanned` also what the check condemns.
using Planner = std::function<Result<model::Plan>(const Inputs&, Job&)>;

/// The plan, with the tools that its features lack (`needed`): told at once (PIP-TOOLS-NEEDED) and given as
/// rows of provenance, which every form of a plan keeps. They are proved by planning again with exactly
/// these: a tool is named only where its feature is planned then, with its corners as they are stated; that
/// they plan all of the part is said only where nothing was left out or condemned. Not proved, and told so
/// ("at least"): of a plan with open decisions or edits, of late bindings, and under a deadline, which the
/// proof must not use up; and, with the reason, where the tools cannot be read back as a list, planning with
/// them fails, or each proof drops some. Fails  PIP-STOPPED.
[[nodiscard]] Result<model::Plan> name_needed(model::Plan made, std::vector<model::NeededTool> needed,
                                              const Inputs& inputs, const Policy& policy,
                                              const Planner& planner, Job& job);

/// Reports what of the case base was found altered or gone in planning (CASE-ROW), each row once.
void tell_altered_cases(const Inputs& inputs, Job& job);

/// Notes what was planned anew (PIP-ANEW).
void tell_tries(const Tries& tries, Job& job);

}  // namespace capstan::pipeline
