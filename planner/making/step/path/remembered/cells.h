#pragma once

#include "planner/ground/base/result.h"
#include "planner/ground/geometry/profile.h"
#include "planner/ground/memo/memo.h"
#include "planner/model/plan/cutter/cutter.h"
#include "planner/model/plan/cutter_path.h"
#include "planner/physics/engagement/engagement.h"
#include "planner/physics/stock/height_map.h"

// Sections along a path on a height map, measured once for the same path through the same material; `memo`
// may be null.

namespace capstan::step {

/// engagement::measure on a height map: found again where path, outline and all columns that it looks at are
/// the same. What is kept says the columns after the cut, too.
[[nodiscard]] Result<engagement::Measurement> measure_again(stock::HeightMap& map,
                                                            const model::CutterPath& path,
                                                            const model::Cutter& cutter, memo::Memo* memo);

/// The columns that a path may cut.
[[nodiscard]] stock::Patch columns_under(const stock::HeightMap& map, const model::CutterPath& path,
                                         const geometry::CutterProfile& profile);

}  // namespace capstan::step
