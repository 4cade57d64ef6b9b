#pragma once

#include "planner/ground/base/result.h"
#include "planner/ground/memo/memo.h"
#include "planner/model/plan/cutter/cutter.h"
#include "planner/model/plan/cutter_path.h"
#include "planner/physics/engagement/engagement.h"
#include "planner/physics/stock/planar/planar_stock.h"

// Sections along a path through the exact stock, measured in the path's own frame
// (model/plan/path/own_frame.h) and once for equal paths through equal material; `memo` may be null.

namespace capstan::step {

/// For a cutter that is flat below: engagement::measure, found again where path, outline and the trails near
/// the path are the same but for their place; then cuts the path from the stock.
/// Accuracy  path and trails are rounded (model::kOwnGrid) for the measurement, beside what it says itself;
///           the stock is cut by what was not rounded. Heights that are equal stay within stock::kTouch.
///           Across the axis what touches may part or overlap by 2.6e-9 mm, twice what an end of an arc
///           moves, which is more than that and does no harm: a contact so narrow counts in volume alone
///           (engagement::kSliver), a section so small not at all, and ends of moves are seen from 1e-5 of
///           the radius inside (engagement/planar).
[[nodiscard]] Result<engagement::Measurement> measure_again(stock::PlanarStock& exact,
                                                            const model::CutterPath& path,
                                                            const model::Cutter& cutter,
                                                            const engagement::Options& options,
                                                            memo::Memo* memo);

}  // namespace capstan::step
