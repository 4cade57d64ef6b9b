#pragma once

#include "planner/files/exchange/common/written.h"
#include "planner/files/p21/file.h"
#include "planner/ground/base/job.h"
#include "planner/ground/base/result.h"
#include "planner/model/plan/plan.h"

namespace capstan::exchange {

/// Reads an ISO 14649 plan. Instances that no noun describes are kept verbatim and stay connected.
///
/// Numbers   are converted to the model's units; deviations of real files (revolutions per minute, radians,
///           ...) are recognised and reported, see iso14649/deviations.h.
/// Open      `$` in its_tool, its_technology, its_operation, and a technology without feed or speed, is
///           open in the plan's ledger.
/// Fails     with one summary, after each fault went to `job`: EXC-REFERENCE, EXC-PARAMETERS, EXC-VALUE,
///           EXC-CYCLE, EXC-GEOMETRY. Faults of what the project does not reach are warnings. `strict` as in
///           ReadOptions (exchange.h).
/// Source    ISO 14649-10, -11, -111 at the published and at the 2001 draft level.
[[nodiscard]] Result<model::Plan> read_iso14649(const p21::File& file, Job& job, bool strict = true);

/// Writes the plan as ISO 14649 at the published level, by instance number; numbers of objects that came
/// from a file are kept. Who bound what goes into user-defined header entities, see the room's README.
[[nodiscard]] Result<Written> write_iso14649(const model::Plan& plan, Job& job);

}  // namespace capstan::exchange
