#pragma once

#include "planner/ground/geometry/vec.h"

namespace capstan::verify {

/// A face that a cycle of the control mills in straight strokes, as a reader understands its parameters.
/// Which path the control takes is its own; the reader's is one that covers the rectangle level by level,
/// with a first stroke as wide as the cutter (`BlockState::mill`). Frame  the work offset's, its axes those
/// of the rectangle. Units  mm, mm/min.
struct FacedArea {
  long line = 0;
  geometry::Vec2 lo, hi;
  bool along_y = false;                   ///< the strokes; else along X
  double out_mm = 0.0;                    ///< from the edge to the cutter where strokes begin and end
  double beyond_mm = 0.0;                 ///< how far the cutter goes over the edges along the strokes
  double back_z = 0.0, start_z = 0.0;     ///< where it ends; by rapid to there, beside the rectangle
  double reference_z = 0.0;               ///< from where levels count
  double floor_z = 0.0, bottom_mm = 0.0;  ///< of the finished face, and left on it
  double level_mm = 0.0, over_mm = 0.0;   ///< at most: a level, and from stroke to stroke
  double feed_mm_min = 0.0;
  double cutter_mm = 0.0;  ///< diameter by the program's header
};

}  // namespace capstan::verify
