#pragma once

#include "planner/files/exchange/common/written.h"
#include "planner/files/p21/file.h"
#include "planner/ground/base/job.h"
#include "planner/ground/base/result.h"
#include "planner/model/plan/plan.h"

namespace capstan::exchange {

/// Reads an ISO 10303-238 plan (AIM; editions 1 to 4) by the tables of ap238/mapping. Instances that they do
/// not explain are kept verbatim and stay connected.
///
/// Numbers   are converted from the file's units, which may differ from one to the next.
/// Fails     with one summary, after each fault went to `job`.
[[nodiscard]] Result<model::Plan> read_ap238(const p21::File& file, Job& job, bool strict = true);

/// Writes the plan as ISO 10303-238, edition 3, with additions of edition 4 if the plan has them.
[[nodiscard]] Result<Written> write_ap238(const model::Plan& plan, Job& job);

}  // namespace capstan::exchange
