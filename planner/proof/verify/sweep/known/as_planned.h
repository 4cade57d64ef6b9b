#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "planner/proof/verify/moves.h"

namespace capstan::verify {

/// A program's step that moves as its plan does, but for the program's decimals and for rapids before and
/// after: its moves from `first` on, up to `last`, are the plan's.
struct AsPlanned {
  std::size_t first = 0, last = 0;
  std::vector<long> where;  ///< for each of the plan's moves the line that makes it
};

/// Holds them against each other move by move. Each end lies within half a unit of the last decimal
/// (Move::rounding_mm of the text), points on the way of an arc within two of them, for ends and centre are
/// rounded each by itself; feed, speed and synchronisation agree. A rapid along one axis may be several that
/// go on from each other. Waits are not compared: nothing is swept by them, nor by what stays in its place.
/// Nothing  where they differ, or where the text's decimals are too coarse for the check not to see them.
[[nodiscard]] std::optional<AsPlanned> as_planned(const StepMoves& step, const std::vector<Move>& plan);

}  // namespace capstan::verify
