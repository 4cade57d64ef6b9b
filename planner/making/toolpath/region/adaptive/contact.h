#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "planner/ground/geometry/region.h"

namespace capstan::toolpath {

/// The boundary of cleared ground, prepared to tell how much of a cutter's front touches what is not cleared.
/// Cost of a question: the edges near the circle.
class ContactMeter {
 public:
  /// `radius_mm`: of the circle that is asked about; the ground's own chords must be finer than what it is
  /// smaller than the cutter.
  ContactMeter(const geometry::Region& cleared, double radius_mm);

  /// Adds a place that the cutter has been at since the ground was taken.
  void visited(geometry::Vec2 p) { visited_.push_back(p); }

  /// Arc of contact of the front half of the circle at p, which moves along the unit direction, rad: all of
  /// it that lies on ground not cleared. 0 where the circle crosses no boundary: the centre is on cleared
  /// ground.
  [[nodiscard]] double arc(geometry::Vec2 p, geometry::Vec2 direction);
  /// Whether the disc of a radius at p touches ground that is not cleared; p lies on cleared ground.
  [[nodiscard]] bool touches(geometry::Vec2 p, double radius_mm);

 private:
  struct Edge {
    geometry::Vec2 a, b;
  };
  struct Crossing {
    double angle;  ///< to the direction, (-pi, pi]
    bool into;     ///< counter-clockwise round the circle it leads onto cleared ground
  };
  struct Span {
    double from, to;
  };
  void gather(geometry::Vec2 p);
  void take_visited(geometry::Vec2 p, geometry::Vec2 direction);
  [[nodiscard]] std::size_t column(double x) const;
  [[nodiscard]] std::size_t row(double y) const;

  double radius_;
  geometry::Vec2 lo_;
  double cell_ = 1.0;
  std::size_t columns_ = 1, rows_ = 1;
  std::vector<Edge> edges_;
  std::vector<std::vector<std::uint32_t>> cells_;
  std::vector<std::uint32_t> seen_;  ///< per edge: the gathering that took it last
  std::uint32_t gathering_ = 0;
  geometry::Vec2 gathered_at_{1e300, 1e300};
  std::vector<Edge> near_;  ///< edges near the circle round `gathered_at_`
  std::vector<geometry::Vec2> visited_;
  std::vector<Crossing> crossings_;
  std::vector<Span> spans_;
};

}  // namespace capstan::toolpath
