#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <optional>

#include "planner/ground/geometry/vec.h"
#include "planner/proof/verify/sweep/grid/outline.h"

namespace capstan::verify {

/// The cells of rows that a cutter may lower on its way along a line. Of the cells beside a line most stand
/// lower than the cutter comes there; some side by side are told so at once (line_cells.cpp). Rounding may
/// let a cell through, never keep one back.
///
/// Units  mm.
class LineCells {
 public:
  /// `d`: from the line's start `a` to its end; the tip runs from `from_z` to `to_z`; `four`: as many cells
  /// at once, for a processor that `takes_four`.
  LineCells(const CutterOutline& o, geometry::Vec2 a, geometry::Vec2 d, double from_z, double to_z,
            bool four = takes_four());
  [[nodiscard]] static bool takes_four();

  /// Calls f(ix) for those of the cells from..to - 1 of a row that may be lowered, and for some others.
  /// `stock`: the row's heights; the centre of cell ix is (first.x + ix cell, first.y).
  template <class F>
  void each(const double* stock, int from, int to, geometry::Vec2 first, double cell, const F& f) const {
    for (int begin = from; begin < to; begin += kAtOnce) {
      const int count = std::min(kAtOnce, to - begin);
      for (std::uint64_t left = marks(stock + begin, count, {first.x + begin * cell, first.y}, cell);
           left != 0; left &= left - 1)
        f(begin + std::countr_zero(left));
    }
  }

  /// What the marking of cells knows of a line.
  struct Line {
    geometry::Vec2 a, d, per;  ///< `per`: d over its square, so that their product with a way is the foot
    double most = 0.0;         ///< square of the distance
    std::array<CutterOutline::Floor, 2> floors;  ///< heights, of the square of the distance
    /// Of a cutter whose end is one sphere.
    struct Sphere {
      double square = 0.0;             ///< of its radius
      double nearest = 0.0;            ///< its centre's height at the lower end
      double start = 0.0, rise = 0.0;  ///< the same at the line's start, and from there to its end
      double upright = 0.0;            ///< of its heights over the line: the line's length over that in XY
    };
    std::optional<Sphere> sphere;
  };

 private:
  static constexpr int kAtOnce = 64;
  /// A bit for each of these cells, 64 at most: it may be lowered.
  [[nodiscard]] std::uint64_t marks(const double* stock, int count, geometry::Vec2 first, double cell) const;

  Line line_;
  bool four_;
};

}  // namespace capstan::verify
