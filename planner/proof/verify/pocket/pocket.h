#pragma once

#include "planner/ground/geometry/vec.h"

namespace capstan::verify {

/// A pocket that a cycle of the control roughs, as a reader understands its parameters. Which path the
/// control takes is its own; the reader's is one that covers the pocket level by level, with a full slot at
/// the bottom of each (`BlockState::mill`).
/// Frame  the work offset's. Units  mm, mm/min, rad.
struct Pocket {
  long line = 0;
  bool round = false;
  geometry::Vec2 centre;
  double length_mm = 0.0, width_mm = 0.0;  ///< along the angle and across; of a round one both its diameter
  double corner_mm = 0.0, angle_rad = 0.0;
  double back_z = 0.0;                    ///< where it ends
  double start_z = 0.0;                   ///< by rapid to there, fed from there
  double reference_z = 0.0;               ///< from where levels count
  double floor_z = 0.0;                   ///< of the finished pocket
  double side_mm = 0.0, bottom_mm = 0.0;  ///< left on walls and floor
  double level_mm = 0.0;                  ///< at most; the levels are alike
  double over_mm = 0.0;                   ///< from ring to ring at most
  bool own_rings = false;                 ///< no parameter states it: it is the control's
  double feed_mm_min = 0.0, ramp_feed_mm_min = 0.0;
  double helix_mm = 0.0, turn_mm = 0.0;  ///< the way in: radius of the tool's centre, and down per turn
  double slope = 0.0;                    ///< above 0: in back and forth along the middle, this steep at most
  bool clockwise = false;                ///< the way round along the walls
  double cutter_mm = 0.0;                ///< diameter by the program's header
};

}  // namespace capstan::verify
