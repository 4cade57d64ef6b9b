#pragma once

#include <cstddef>
#include <optional>

#include "planner/controls/gcode/moves/arcs.h"
#include "planner/ground/geometry/vec.h"
#include "planner/model/plan/plan.h"

namespace capstan::controls::gcode {

/// A helix of several arcs of a path. Rounded end, centre relative to the rounded start.
struct Helix {
  geometry::Vec3 to;
  double i = 0.0, j = 0.0;
  int further_turns = 0;  ///< whole ones before the arc that ends at `to`, which is one turn at most
  std::size_t last_move = 0;
};

/// The helix of more than one turn that begins with move `move` of the step, from the rounded point `from`:
/// arcs one way round one centre, of one radius, slope, feed and speed, each but the last as many half turns.
/// Nothing for other moves, and where rounding its ends would move its centre by more than half a unit of the
/// last decimal.
[[nodiscard]] std::optional<Helix> helix_at(const model::StepResult& step, std::size_t move,
                                            geometry::Vec3 from, const ArcForm& form);

}  // namespace capstan::controls::gcode
