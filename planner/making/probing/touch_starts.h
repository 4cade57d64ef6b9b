#pragma once

#include <string>
#include <vector>

#include "planner/ground/geometry/vec.h"
#include "planner/model/features/shape.h"

// Where a touch probe starts and which way it moves.

namespace capstan::probing {

/// One measuring move.
///
/// Frame  workpiece; `start` is the middle of the ball. Units  mm.
struct Touch {
  geometry::Vec3 start, direction, reference;  ///< directions are units; reference is across direction
  double distance_mm = 0.0;                    ///< until the ball touches what should be there
  std::string side;                            ///< "+x" of the feature's frame
};

/// The touches that measure a feature, or why there are none.
struct Touches {
  std::vector<Touch> touches;
  std::string why_not;  ///< set if `touches` is empty
};

/// Allowance that later steps will remove from walls and floor, mm.
struct Left {
  double side_mm = 0.0, bottom_mm = 0.0;
};

/// The surroundings in which touches are searched; workpiece coordinates.
struct Piece {
  const std::vector<model::FeatureShape>& shapes;  ///< of all features
  const geometry::Box3& raw;                       ///< of the raw piece
};

/// Touches that find the place of a feature that is cut except for `left`.
///
/// Upright walls that face each other: holes, pockets and outsides in x and y, slots and open pockets at
/// least across; faces: their level. Each start has room for the ball: within what the feature removes, for
/// an outside also beside the raw piece; each wall is there, not cut away by another feature.
[[nodiscard]] Touches touches_of(const Piece& piece, const model::FeatureShape& shape, Left left,
                                 double ball_radius_mm);

}  // namespace capstan::probing
