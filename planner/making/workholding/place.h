#pragma once

#include <string>
#include <vector>

#include "planner/ground/base/result.h"
#include "planner/ground/geometry/vec.h"
#include "planner/model/plan/resources/workholding.h"
#include "tooling/shop/fixtures/fixtures.h"

namespace capstan::workholding {

inline constexpr double kLeastGrip = 3.0;        ///< mm held by jaws, at least; default, unsourced
inline constexpr double kUsualGrip = 2.0 / 3.0;  ///< of the piece's height, at most; default, unsourced

/// Puts fixture and clamps around the piece.
///
/// Frame   the set-up's. `piece` is what is still there of the raw piece when the set-up begins.
/// Fails   HOLD-OPENING  the piece is wider than the jaws open
///         HOLD-PARALLEL it would stand above the jaws, or deeper than they are high
///         HOLD-INSIDE   a clamp lies inside the piece
///         HOLD-CONTACT  a clamp does not touch it
///         HOLD-NOTHING  a plate without clamps
///         HOLD-SIZE     the piece is larger than the plate
[[nodiscard]] Result<model::Workholding> place(const tooling::HoldingWish& wish, const geometry::Box3& piece,
                                               const std::vector<tooling::Fixture>& fixtures,
                                               const std::string& file = {});

}  // namespace capstan::workholding
