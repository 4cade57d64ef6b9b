#pragma once

#include <string>

#include "planner/model/plan/plan.h"

namespace capstan::model {

/// A position, a length or any number of the plan so large that no geometry can be computed with it, named
/// with its value and the limit (range::kPositionMm); empty: there is none. Looks at the objects, the raw
/// piece, the set-ups and what holds the piece, the target mesh, and the paths. Cost: linear.
[[nodiscard]] std::string beyond_range(const Plan& plan);

}  // namespace capstan::model
