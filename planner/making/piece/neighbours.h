#pragma once

#include <cstddef>
#include <vector>

#include "planner/model/features/shape.h"

namespace capstan::piece {

/// A ball around a shape's area at its top: a quick answer to whether two are far apart.
struct Around {
  geometry::Vec3 centre;
  double radius_mm = 0.0;
};
[[nodiscard]] Around around(const model::FeatureShape& shape);

/// Which shapes lie near a place, seen along an axis. Asks for few of many shapes where these are spread.
///
/// Cost     O(n log n) to make, for few directions of axes; of a question O(log n) and what lies in the cells
///          that it reaches.
class Neighbours {
 public:
  Neighbours() = default;
  explicit Neighbours(const std::vector<model::FeatureShape>& shapes);

  [[nodiscard]] std::size_t size() const { return balls_.size(); }
  [[nodiscard]] const Around& ball(std::size_t shape) const { return balls_[shape]; }
  /// Mean distance of shapes: where a search begins, mm. Above 0.
  [[nodiscard]] double spacing_mm() const { return cell_mm_; }

  /// The shapes whose axis is parallel to `axis` or turned round (within what callers take for parallel, 1e-6
  /// of the cosine), and whose balls, seen along it, are not farther than `reach_mm` from that of `here`;
  /// some that are a little farther, too. Rising.
  [[nodiscard]] std::vector<std::size_t> near(const Around& here, geometry::Vec3 axis, double reach_mm) const;

  /// No two of the shapes, and nothing between them, is farther apart than this, mm.
  [[nodiscard]] double span_mm() const { return span_mm_; }

 private:
  struct Entry {
    long row, column;
    std::size_t shape;
  };
  /// Shapes of one direction, up or down, in a grid across it.
  struct Direction {
    geometry::Vec3 x, y, z;
    std::vector<Entry> cells = {};        ///< by row, column, shape
    std::vector<std::size_t> large = {};  ///< wider than some cells: each is looked at
    double radius_mm = 0.0;               ///< of the largest in cells
  };
  [[nodiscard]] long cell(double v) const;

  std::vector<Around> balls_;
  std::vector<Direction> directions_;
  double cell_mm_ = 1.0, span_mm_ = 0.0;
};

}  // namespace capstan::piece
