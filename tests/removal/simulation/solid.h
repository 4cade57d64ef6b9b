#pragma once

#include <functional>
#include <vector>

#include "tests/removal/simulation/point.h"

namespace capstan::testing::removal {

/// How deep a point lies inside a shape: positive inside, negative outside, never changing by more than the
/// distance between two points. Exact inside convex shapes; outside near edges it is too small, never too
/// large.
using Depth = std::function<double(const Point&)>;
/// The same in a plane.
using Depth2 = std::function<double(double, double)>;

[[nodiscard]] Depth2 rectangle(double x0, double y0, double x1, double y1);
[[nodiscard]] Depth2 rounded_rectangle(double x0, double y0, double x1, double y1, double radius);
[[nodiscard]] Depth2 disc(double x, double y, double radius);
/// A closed line through points, either way round, not convex if need be.
[[nodiscard]] Depth2 polygon(std::vector<std::pair<double, double>> points);
/// A thick line: everything within half the width of it.
[[nodiscard]] Depth2 stroke(std::vector<std::pair<double, double>> points, double width);
[[nodiscard]] Depth2 both(Depth2 a, Depth2 b);
[[nodiscard]] Depth2 without(Depth2 a, Depth2 b);

[[nodiscard]] Depth box(Point lo, Point hi);
/// A plane shape from z0 to z1.
[[nodiscard]] Depth prism(Depth2 base, double z0, double z1);
/// A section in (across, z) that runs along `from`..`to` on a line in the plane at z = 0; across is to the
/// left of the way. Both ends cut square.
[[nodiscard]] Depth along(Point from, Point to, Depth2 section);
/// (r, z) turned about the upright line through x, y.
[[nodiscard]] Depth turned(double x, double y, Depth2 section);
[[nodiscard]] Depth cylinder(double x, double y, double radius, double z0, double z1);
/// Between two circles about one upright axis, the lower one first.
[[nodiscard]] Depth cone(double x, double y, double z0, double r0, double z1, double r1);
[[nodiscard]] Depth sphere(Point centre, double radius);
[[nodiscard]] Depth both(Depth a, Depth b);
[[nodiscard]] Depth either(std::vector<Depth> all);
[[nodiscard]] Depth without(Depth a, Depth b);
/// Grown by d (shrunk when negative).
[[nodiscard]] Depth grown(Depth a, double d);
[[nodiscard]] Depth moved(Depth a, double dx, double dy, double dz);
/// Turned about the upright line through x, y, counter-clockwise.
[[nodiscard]] Depth rotated(Depth a, double x, double y, double angle_rad);

/// The bluntest drill for a conical bottom, whole angle: what it leaves in the point may stay
/// (rules/data/hole.yaml, bluntest_deg).
inline constexpr double kBluntestDeg = 140.0;

/// The wanted part: a block with hollows. Between the least and the most of a hollow either is right.
class Target {
 public:
  explicit Target(Depth body) : body_(std::move(body)) {}
  void cut(const Depth& hollow) { cut(hollow, hollow); }
  /// `least` must be gone, everything outside `most` must stay.
  void cut(Depth least, Depth most);
  /// How deep p lies inside what must stay; negative: it may go, or must.
  [[nodiscard]] double stays(const Point& p) const;
  /// How deep p lies inside what must be gone, hollows and around the body.
  [[nodiscard]] double goes(const Point& p) const;

 private:
  Depth body_;
  std::vector<Depth> least_, most_;
};

}  // namespace capstan::testing::removal
