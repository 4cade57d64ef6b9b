#pragma once

#include "planner/making/piece/piece.h"
#include "planner/model/plan/proposal.h"
#include "tooling/selection/select.h"

namespace capstan::step {

/// What a proposed step removes, as selection asks: from the feature's geometry, rest machining and islands
/// not taken off (more, not less). `batch`: pieces.
[[nodiscard]] tooling::Preferences preferences_of(const piece::Piece& piece, int batch,
                                                  const model::ProposedStep& step,
                                                  const model::FeatureShape& shape);

}  // namespace capstan::step
