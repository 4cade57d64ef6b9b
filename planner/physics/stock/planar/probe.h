#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "planner/ground/geometry/vec.h"

namespace capstan::stock {

/// Places on a probe where something begins or ends; more than fit are not kept (a trail gives at most 14).
class Cuts {
 public:
  void add(double x) {
    if (size_ < x_.size()) x_[size_++] = x;
  }
  void sort();
  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] double operator[](std::size_t i) const { return x_[i]; }

 private:
  std::array<double, 32> x_{};
  std::size_t size_ = 0;
};

/// A line in the plane to look along: straight, or the front half of a cutter's circle.
///
///     straight  at(x) = origin + x along
///     front     at(x) = origin + x along + sqrt(R^2 - x^2) ahead      (along: to the right of the feed)
///
/// On the front half x is the offset across the feed, so that lengths in x are widths of cut.
struct Probe {
  geometry::Vec2 origin, along, ahead;
  double radius_mm = 0.0;  ///< 0: straight
  double lo = 0.0, hi = 0.0;

  [[nodiscard]] static Probe front(geometry::Vec2 centre, geometry::Vec2 unit_heading, double radius_mm);
  [[nodiscard]] static Probe straight(geometry::Vec2 origin, geometry::Vec2 unit_along, double lo, double hi);
  [[nodiscard]] geometry::Vec2 at(double x) const;
  /// Where the probe meets the line n . p = d (n of unit length) and a circle.
  void cross_line(geometry::Vec2 n, double d, Cuts& out) const;
  void cross_circle(geometry::Vec2 centre, double radius_mm, Cuts& out) const;
};

/// Heights of the material along a probe: constant pieces that follow one another without gaps.
class Heights {
 public:
  struct Piece {
    double x0, x1, z_mm;
  };
  void reset(double lo, double hi, double z_mm);
  /// Lowers everything above z between x0 and x1 to z; true if there was any.
  bool lower(double x0, double x1, double z_mm);
  /// The highest piece above z and the range of all of them; x0 > x1: there is none.
  [[nodiscard]] Piece standing(double above_mm) const;
  /// Narrows x0 .. x1 to the range of material above z between them; false: there is none.
  [[nodiscard]] bool narrow(double& x0, double& x1, double above_mm) const;
  [[nodiscard]] const std::vector<Piece>& pieces() const { return pieces_; }

 private:
  std::vector<Piece> pieces_, changed_;
};

}  // namespace capstan::stock
