#pragma once

#include <vector>

#include "planner/making/toolpath/region/adaptive/contact.h"
#include "planner/making/toolpath/region/area/inside.h"

namespace capstan::toolpath {

/// What a pass of constant engagement keeps to. Material lies on the right of the travel.
struct Bite {
  double radius_mm = 0.0;
  double radial_mm = 0.0;  ///< of a straight cut
  double blind_mm = 0.0;   ///< contact less deep than this counts as none
  double chord_mm = 0.0;   ///< tolerance of curves
  /// Arc of contact of the straight cut, as a circle smaller by `blind_mm` has it, rad.
  [[nodiscard]] double arc_rad() const;
};

/// The region of the centres, for a pass that may slide along its boundary.
class Walls {
 public:
  explicit Walls(const geometry::Region& centres);
  [[nodiscard]] bool contains(geometry::Vec2 p) const { return inside_.contains(p); }
  [[nodiscard]] bool contains(geometry::Vec2 a, geometry::Vec2 b) const { return inside_.contains(a, b); }
  /// p itself within the region, else the nearest place of its boundary.
  [[nodiscard]] geometry::Vec2 kept(geometry::Vec2 p) const;
  /// The nearest place of the boundary and its distance; none within `within_mm`: any, or a distance of
  /// 1e300.
  struct Place {
    geometry::Vec2 point;
    double distance_mm = 1e300;
  };
  [[nodiscard]] Place nearest(geometry::Vec2 p, double within_mm) const;

 private:
  struct Edge {
    geometry::Vec2 a, b;
  };
  Inside inside_;
  geometry::Vec2 lo_;
  double cell_ = 1.0;
  std::size_t columns_ = 1, rows_ = 1;
  std::vector<std::vector<Edge>> cells_;
};

/// One pass, step by step.
class Tracer {
 public:
  enum class End : std::uint8_t {
    kFurther,  ///< the ground is to be taken anew; the pass goes on
    kAir,      ///< nothing to cut is left before the cutter
    kBlocked,  ///< walls or too much material on every side
  };
  Tracer(const Walls& walls, const Bite& bite, geometry::Vec2 start, geometry::Vec2 heading);

  /// Goes on until the pass ends or has become so long, or has turned so much, that its own sweep matters.
  End run(ContactMeter& ground);

  /// All places since the start.
  [[nodiscard]] const std::vector<geometry::Vec2>& line() const { return line_; }
  /// How many of them are up to the last contact; 1: there was none.
  [[nodiscard]] std::size_t cut() const { return cut_; }
  [[nodiscard]] geometry::Vec2 heading() const { return heading_; }

 private:
  struct Step {
    geometry::Vec2 to, heading;
    double contact = 0.0;
    bool possible = false;
  };
  [[nodiscard]] Step step(ContactMeter& ground, double right_rad) const;
  [[nodiscard]] Step best(ContactMeter& ground) const;

  const Walls& walls_;
  Bite bite_;
  double limit_;   ///< arc of contact
  double length_;  ///< of a step
  double right_;   ///< most turn of a step to the material, rad
  geometry::Vec2 heading_;
  std::vector<geometry::Vec2> line_;
  std::size_t cut_ = 1;
  double idle_mm_ = 0.0, idle_turn_ = 0.0;
};

}  // namespace capstan::toolpath
