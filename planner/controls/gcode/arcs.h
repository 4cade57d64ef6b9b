#pragma once

#include <vector>

#include "planner/ground/base/result.h"
#include "planner/ground/geometry/vec.h"
#include "planner/model/plan/cutter_path.h"

namespace capstan::controls::gcode {

/// A piece of an arc as it is written: rounded end, centre relative to the rounded start.
struct ArcPiece {
  geometry::Vec3 to;
  double i = 0.0, j = 0.0;
  bool line = false;  ///< flatter than the last decimal shows
};

/// Decimals of I and J: finer than the ends, so that the radii agree although the ends were rounded.
[[nodiscard]] int centre_decimals(int decimals);

/// Move `move` of the path, from the rounded point `from`, in pieces of at most half a turn. The centre is
/// moved onto the perpendicular bisector of the rounded chord:
///
///     c' = c - ((c - m) . u) u        m: middle of the chord, u: its direction
///
/// so that both radii agree within 10^-decimals, and the arc stays within 10^-decimals of the plan's.
///
/// Fails  OUT-ARC when the plan's own radii differ by more than ten units of the last decimal.
[[nodiscard]] Result<std::vector<ArcPiece>> arc_pieces(const model::CutterPath& path, std::size_t move,
                                                       geometry::Vec3 from, int decimals);

}  // namespace capstan::controls::gcode
