#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "planner/ground/geometry/vec.h"

namespace capstan::verify::volumes {

/// A piece of a plane boundary, mm: a straight line, or an arc of a circle. Exact: never taken as chords.
struct Edge {
  geometry::Vec2 from, to;
  geometry::Vec2 centre;
  double radius_mm = 0.0;  ///< 0: straight
  double start_rad = 0.0;  ///< arcs: direction of `from` seen from the centre
  double sweep_rad = 0.0;  ///< arcs: positive counter-clockwise; at most a full turn
  bool open = false;       ///< no wall: the mouth of an open pocket

  [[nodiscard]] bool arc() const { return radius_mm > 0.0; }
  [[nodiscard]] double length() const;
  /// The place at a share 0 .. 1 of the way, and the direction of travel there.
  [[nodiscard]] geometry::Vec2 at(double share) const;
  [[nodiscard]] geometry::Vec2 along(double share) const;
  [[nodiscard]] Edge reversed() const;
};
[[nodiscard]] Edge straight(geometry::Vec2 from, geometry::Vec2 to);
[[nodiscard]] Edge round(geometry::Vec2 centre, double radius_mm, double start_rad, double sweep_rad);

/// Which edges of an outline reach into each of its rows: bands of y, one above the other.
struct Rows {
  double from = 0.0, per_mm = 0.0;   ///< y of the first row's foot, and how many rows there are in a mm
  std::vector<std::uint32_t> begin;  ///< of row i in `edges`; one more than there are rows
  std::vector<std::uint32_t> edges;
  std::size_t of = 0;  ///< edges of the outline
};

/// Edges one after the other; closed: the boundary of an area. Ends may be apart by less than kJoin.
struct Outline {
  std::vector<Edge> edges;
  geometry::Vec2 lo{1e300, 1e300}, hi{-1e300, -1e300};  ///< the box that holds it
  std::shared_ptr<const Rows> rows;                     ///< of many edges; unset: not sorted
  void add(const Edge& e);
  /// Sorts the edges of a finished outline into rows, so that `turns_around` looks at few of them.
  void sort();
  [[nodiscard]] bool empty() const { return edges.empty(); }
};

/// Ends of consecutive edges that are nearer than this are one point, mm; default, unsourced.
inline constexpr double kJoin = 0.01;

/// The nearest place of an outline.
struct Near {
  double distance_mm = 1e300;
  std::size_t edge = 0;
  double share = 0.0;  ///< of that edge
};
[[nodiscard]] Near nearest(const Outline& o, geometry::Vec2 p, bool walls_only = false);

/// How far walls that run straight past their corners, to meet there in a mitre, would have to be moved to
/// come to p, which is beside them, mm: the distance to a wall; about a corner of 60 degrees or more to the
/// farther one of its two walls' lines.
[[nodiscard]] double mitred(const Outline& o, geometry::Vec2 p, bool walls_only = false);

/// How often a closed outline runs round p, counter-clockwise positive; 0: p is outside.
[[nodiscard]] int turns_around(const Outline& o, geometry::Vec2 p);
[[nodiscard]] inline bool inside(const Outline& o, geometry::Vec2 p) {
  if (p.x < o.lo.x || p.x > o.hi.x || p.y < o.lo.y || p.y > o.hi.y) return false;
  return turns_around(o, p) != 0;
}
/// Twice the area, counter-clockwise positive, mm2.
[[nodiscard]] double twice_area(const Outline& o);

/// A corner of a closed outline that a radius does not fit into, in words; or the outline with arcs there.
struct Rounded {
  Outline outline;
  std::string fault;
};
/// Every inside corner of an area rounded by a radius: the arc that touches both edges.
[[nodiscard]] Rounded rounded(const Outline& o, double radius_mm);

}  // namespace capstan::verify::volumes
