#pragma once

#include <cstddef>
#include <vector>

#include "planner/making/optimise/feeds.h"

namespace capstan::step {

/// Whether what was kept can be the pieces of a path of so many moves: those of each move in order, their
/// shares rising to 1; the start, which has no length, in one.
[[nodiscard]] inline bool are_pieces_of(const std::vector<optimise::PieceEnd>& pieces, std::size_t moves) {
  std::size_t move = 0;
  double from = 0.0;
  for (const optimise::PieceEnd& e : pieces) {
    // Of what is no number neither holds.
    const bool further = e.share > from && e.share <= 1.0;
    if (move == moves || e.move != move || !further || (move == 0 && e.share != 1.0)) return false;
    from = e.share;
    if (e.share != 1.0) continue;
    ++move;
    from = 0.0;
  }
  return move == moves;
}

}  // namespace capstan::step
