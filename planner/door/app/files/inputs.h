#pragma once

#include "planner/door/app/command/options.h"
#include "planner/door/pipeline/pipeline.h"
#include "planner/ground/base/job.h"
#include "planner/ground/base/result.h"

namespace capstan::app {

/// Machine, library, materials and rules as the options name them; else as the plan says that it was made
/// with them (machine, material, raw piece); else the built-in ones. Each stands in `provenance`, a default
/// as "built-in default". Fails  as the rooms that read them.
[[nodiscard]] Result<pipeline::Inputs> gather(const InputOptions& options, const model::Plan& plan, Job& job);

/// Whether the machine's data are there, and not only its name (all that an ISO 14649 file holds).
[[nodiscard]] bool has_data(const model::Machine& machine);

}  // namespace capstan::app
