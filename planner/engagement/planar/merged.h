#pragma once

#include "planner/engagement/engagement.h"

namespace capstan::engagement {

/// One measurement of two of the same path: level and upright moves as `exact` has them (measured with
/// Ways::kUprightAndLevel), ramps and helices as `cells` has them. In the path's order, one empty sample
/// where a cut ends; totals are those of the samples, what rapids touch the larger of both.
[[nodiscard]] Measurement merged(const model::CutterPath& path, const Measurement& exact,
                                 const Measurement& cells);

}  // namespace capstan::engagement
