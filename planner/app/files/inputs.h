#pragma once

#include "planner/app/command/options.h"
#include "planner/base/job.h"
#include "planner/base/result.h"
#include "planner/pipeline/pipeline.h"

namespace capstan::app {

/// Machine, library, materials and rules as the options name them, or the built-in ones; each stands in
/// `provenance`, a default as "built-in default".
/// Fails  as the rooms that read them.
[[nodiscard]] Result<pipeline::Inputs> gather(const InputOptions& options, Job& job);

}  // namespace capstan::app
