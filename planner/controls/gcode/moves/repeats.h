#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "planner/controls/gcode/words.h"
#include "planner/model/plan/plan.h"

namespace capstan::controls::gcode {

/// Holes one behind the other whose moves are the same lines, each by one rapid across from the one before at
/// the height from which all are begun.
struct Repeats {
  std::string lines;                   ///< of one hole, from above it and back, with their line ends
  std::vector<geometry::Vec2> places;  ///< as planned: not rounded
  std::size_t last_move = 0;
};

/// The equal holes that begin with move `move` of the step, the tool at `at` (rounded), as explicit moves.
/// Nothing where there are fewer than three, or where a hole has no more lines than its place and call.
[[nodiscard]] std::optional<Repeats> repeats_at(const model::StepResult& step, std::size_t move,
                                                geometry::Vec3 at, const model::Control& control,
                                                const Words& words);

}  // namespace capstan::controls::gcode
