#pragma once

#include <vector>

#include "planner/files/exchange/common/noun_faults.h"
#include "planner/files/exchange/common/report.h"
#include "planner/model/plan/plan.h"

namespace capstan::exchange::ap238 {

/// Ratios that must have been meant as percent (annex J itself has 75 for three quarters) become ratios, with
/// a warning each.
void mend_ratios(model::Plan& plan, Reporter& reporter);

/// Reports a fault for each feature that is machined and whose placement could not be read: its place is
/// unknown.
void doubt_placements(const model::Model& m, std::vector<Doubt>& doubts);

}  // namespace capstan::exchange::ap238
