#pragma once

#include <vector>

#include "planner/making/draft/draft.h"
#include "planner/making/piece/piece.h"
#include "planner/model/plan/corner_rest.h"

// Inside corners that no mill of the list makes as they are stated (model::CornerRest).

namespace capstan::piece {

/// Keeps the records of an earlier planning whose features still have the steps that were made for them.
/// `steps`: those of the file.
void keep_corner_rests(model::Plan& plan, const std::vector<model::CornerRest>& before,
                       const std::vector<draft::StepDraft>& steps);

/// Once the paths are made: each record gets the radius of the narrowest mill, which is what stays, and is
/// told with its places and how much that is (PIP-CORNER). One whose corners are made as stated is dropped.
void settle_corner_rests(model::Plan& plan, const Shapes& shapes, double grown_mm,
                         const std::vector<draft::StepDraft>& steps, Job& job);

}  // namespace capstan::piece
