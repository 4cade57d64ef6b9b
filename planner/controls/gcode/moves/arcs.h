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

/// How a control takes arcs.
struct ArcForm {
  int decimals = 0;  ///< of ends, mm
  /// Of I and J beyond those of ends: finer, so that the radii agree although the ends were rounded.
  int more_centre_decimals = 2;
  double closure_mm = 0.0;  ///< how far the radii at both ends may differ; 0: by a unit of the last decimal
  bool quadrants = false;   ///< an arc ends where it crosses an axis through its centre
  double largest_radius_mm = 0.0;  ///< 0: any
  [[nodiscard]] int centre_decimals() const;
};

/// Move `move` of the path, from the rounded point `from`, in pieces of at most half a turn. The centre is
/// moved onto the perpendicular bisector of the rounded chord:
///
///     c' = c - ((c - m) . u) u        m: middle of the chord, u: its direction
///
/// and rounded to where the radii agree best, so that they agree within the closure, and the arc stays within
/// it of the plan's.
///
/// Fails  OUT-ARC when the plan's own radii differ by more than ten units of the last decimal, or the radius
/// is more than the control's largest.
[[nodiscard]] Result<std::vector<ArcPiece>> arc_pieces(const model::CutterPath& path, std::size_t move,
                                                       geometry::Vec3 from, const ArcForm& form);

}  // namespace capstan::controls::gcode
