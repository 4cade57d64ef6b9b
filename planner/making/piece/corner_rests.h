#pragma once

#include <vector>

#include "planner/making/draft/draft.h"
#include "planner/making/piece/piece.h"
#include "planner/model/plan/corner_rest.h"

// Inside corners that no mill of the list makes as they are stated (model::CornerRest).

namespace capstan::piece {

/// The records of an earlier planning whose features still have the steps that were made for them, as rows of
/// provenance. `steps`: those of the file.
[[nodiscard]] std::vector<model::Provenance> kept_corner_rests(const std::vector<model::CornerRest>& before,
                                                               const std::vector<draft::StepDraft>& steps);

/// The plan's rows of provenance once the paths are made. The record of a corner gets the radius of the
/// narrowest mill, which is the radius that stays, and a report with places and amounts (PIP-CORNER). The
/// record of corners that are made as stated is dropped.
[[nodiscard]] std::vector<model::Provenance> settled_corner_rests(const Piece& piece,
                                                                  const std::vector<draft::StepDraft>& steps,
                                                                  Job& job);

}  // namespace capstan::piece
