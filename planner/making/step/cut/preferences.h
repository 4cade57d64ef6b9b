#pragma once

#include "planner/making/piece/piece.h"
#include "planner/model/plan/proposal.h"
#include "tooling/selection/select.h"

namespace capstan::step {

/// Volume, depth and length of cut of a proposed step, for tool selection. Computed from the feature's
/// geometry; between upright walls without what rest machining, allowances and islands to the top leave.
/// `batch`: pieces.
[[nodiscard]] tooling::Preferences preferences_of(const piece::Piece& piece, int batch,
                                                  const model::ProposedStep& step,
                                                  const model::FeatureShape& shape);

/// Height of the ridges, and of the chords, that a proposed freeform step leaves, mm: of one with an
/// allowance a quarter of it. Defaults, unsourced.
[[nodiscard]] double freeform_ridges_mm(const model::ProposedStep& step);

}  // namespace capstan::step
