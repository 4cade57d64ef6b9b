#pragma once

#include <vector>

#include "planner/ground/geometry/vec.h"
#include "planner/proof/verify/sweep/grid/grid.h"

namespace capstan::verify {

/// Balls of one radius, let down from above on the columns of the finished part. Beside all columns nothing
/// holds them.
///
/// Units mm. Frame: the grid's. Accuracy: a column fills its cell, so that beside a slope of tangent t a ball
/// rests up to a cell times t too high.
class RestingBalls {
 public:
  /// `grid` is kept by the caller.
  RestingBalls(const Grid& grid, double radius_mm);

  /// Whether one of them, or one above it, has its middle nearer to a place than this.
  [[nodiscard]] bool reaches(geometry::Vec3 place, double within_mm);

 private:
  struct Around {
    int dx = 0, dy = 0;
    double height = 0.0;  ///< of the middle above what the ball touches there
  };
  [[nodiscard]] double lowest(int ix, int iy);

  const Grid& grid_;
  double radius_mm_, top_ = Grid::kNothing;
  int stride_ = 1;               ///< of cells, between middles
  std::vector<Around> ball_;     ///< from its middle outwards
  std::vector<double> heights_;  ///< of middles, by cells; found as they are asked for
  std::vector<char> known_;
};

}  // namespace capstan::verify
