#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "planner/ground/geometry/profile.h"
#include "planner/ground/geometry/vec.h"
#include "planner/model/plan/cutter_path.h"
#include "planner/physics/stock/planar/probe.h"

namespace capstan::stock {

/// The volume that a cutter removed along one piece of a move: everything within its radius of the axis'
/// track, down to a floor. Straight tracks of any length (a point for a plunge), arcs of at most about a
/// quarter turn.
///
/// Units  mm.
struct Trail {
  geometry::Vec2 a, b;
  double za = 0.0, zb = 0.0;  ///< of the tip at a and b
  double radius_mm = 0.0;
  bool arc = false;
  geometry::Vec2 centre;  ///< of the arc
  double turn_rad = 0.0;  ///< of the arc, positive counter-clockwise, |turn| < pi
  /// Outline of a cutter that is not flat below: only on level tracks, and at a point. Not owned; null: flat.
  const geometry::CutterProfile* outline = nullptr;

  double lowest_mm = 0.0, highest_mm = 0.0;  ///< of its floor
  double path_radius_mm = 0.0, length_mm = 0.0;
  geometry::Vec2 along;  ///< straight: unit direction; arc: unit direction from the centre to a
  geometry::Vec2 last;   ///< arc: unit direction from the centre to b

  /// Fills what follows from the first block.
  void settle();
  [[nodiscard]] bool level() const { return outline == nullptr && za == zb; }
  /// Distance from p to the track.
  [[nodiscard]] double distance(geometry::Vec2 p) const {
    if (arc) return distance_to_arc(p);
    const geometry::Vec2 w = p - a;
    const double u = std::clamp(dot(w, along), 0.0, length_mm);
    const geometry::Vec2 d = w - u * along;
    return std::sqrt(dot(d, d));
  }
  [[nodiscard]] double distance_to_arc(geometry::Vec2 p) const;
  /// Whether nothing is left of the other, seen from their tracks alone: holes inside of holes, turns of a
  /// helix above each other, ways there and back. False where it is not that plain.
  [[nodiscard]] bool covers(const Trail& other) const;
  /// Height of the floor at a place within the radius.
  [[nodiscard]] double floor_at(geometry::Vec2 p) const;
  /// Lowers the heights along the probe by this trail; heights below `above_mm` may be reported as lower or
  /// not. True if it lowered anything.
  /// Accuracy  level floors: exact but for rounding; others in strips of at most a 16th of what they cover,
  ///           each at the height of its middle.
  bool lower(const Probe& probe, double above_mm, Heights& heights) const;
};

/// Rectangle around everything that a trail covers.
void bounds_of(const Trail& t, geometry::Vec2& lo, geometry::Vec2& hi);

/// Distances closer than this are the same, mm.
inline constexpr double kTouch = 1e-9;

/// Move i as trails of a cutter (arcs in pieces of at most a quarter turn), from first to last.
[[nodiscard]] std::vector<Trail> trails_of(const model::CutterPath& path, std::size_t i, double radius_mm,
                                           const geometry::CutterProfile* outline);

}  // namespace capstan::stock
