#pragma once

#include "planner/ground/base/result.h"
#include "planner/ground/geometry/profile.h"
#include "planner/ground/memo/memo.h"
#include "planner/model/plan/cutter/cutter.h"
#include "planner/model/plan/cutter_path.h"
#include "planner/physics/engagement/engagement.h"
#include "planner/physics/stock/height_map.h"
#include "planner/physics/stock/planar/planar_stock.h"

// Sections along a path, measured once for the same path through the same material; `memo` may be null.

namespace capstan::step {

/// engagement::measure on a height map: found again where path, outline and all columns that it looks at are
/// the same. What is kept says the columns after the cut, too.
[[nodiscard]] Result<engagement::Measurement> measure_again(stock::HeightMap& map,
                                                            const model::CutterPath& path,
                                                            const model::Cutter& cutter, memo::Memo* memo);

/// The same on the exact stock, for a cutter that is flat below: found again where path, outline and the
/// trails near the path are the same. What is kept says which trails the path left.
[[nodiscard]] Result<engagement::Measurement> measure_again(stock::PlanarStock& exact,
                                                            const model::CutterPath& path,
                                                            const model::Cutter& cutter,
                                                            const engagement::Options& options,
                                                            memo::Memo* memo);

/// The columns that a path may cut.
[[nodiscard]] stock::Patch columns_under(const stock::HeightMap& map, const model::CutterPath& path,
                                         const geometry::CutterProfile& profile);

}  // namespace capstan::step
