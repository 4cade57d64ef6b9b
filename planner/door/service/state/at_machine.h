#pragma once

#include <string>
#include <vector>

#include "planner/controls/dialect.h"
#include "planner/door/pipeline/pipeline.h"
#include "planner/door/service/outputs.h"
#include "planner/door/service/request.h"
#include "planner/ground/base/job.h"
#include "planner/model/plan/plan.h"

// What a control asks of a plan before it binds it.

namespace capstan::service {

/// What the control is able to do that plans are held against: that of the option "profile", else the
/// machine's own.
/// Fails  as controls::load_profile; CONTROL-UNKNOWN: the machine's control is none of those that are known.
[[nodiscard]] Result<controls::Conformance> control_of(const Request& request, const model::Machine& machine,
                                                       Job& job);

/// What of a plan does not suit a control, before the first chip: what it is unable to do (FIT-ARC, FIT-FEED,
/// ...: controls::suitability), and what the plan leaves open, misses, states twice or against itself
/// (controls::specification). Errors first. `part`: the plan is of some workingsteps only.
[[nodiscard]] std::vector<model::Finding> unsuited(const controls::Conformance& control,
                                                   const model::Plan& plan, bool part);

/// What of a plan no longer holds with the shop's machine, material and tools (late::no_longer_valid).
[[nodiscard]] Outcome<std::vector<std::string>> no_longer_valid(const pipeline::Inputs& shop,
                                                                const Request& request,
                                                                const model::Plan& plan, Job& job);

}  // namespace capstan::service
