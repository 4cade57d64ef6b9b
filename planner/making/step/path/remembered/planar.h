#pragma once

#include "planner/ground/base/result.h"
#include "planner/ground/memo/memo.h"
#include "planner/model/plan/cutter/cutter.h"
#include "planner/model/plan/cutter_path.h"
#include "planner/physics/engagement/engagement.h"
#include "planner/physics/stock/planar/planar_stock.h"

// Sections along a path through the exact stock, measured once for the same path through the same material;
// `memo` may be null.

namespace capstan::step {

/// For a cutter that is flat below: found again where path, outline and the trails near the path are the
/// same. What is kept says which trails the path left.
[[nodiscard]] Result<engagement::Measurement> measure_again(stock::PlanarStock& exact,
                                                            const model::CutterPath& path,
                                                            const model::Cutter& cutter,
                                                            const engagement::Options& options,
                                                            memo::Memo* memo);

}  // namespace capstan::step
