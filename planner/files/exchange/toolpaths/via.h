#pragma once

#include <span>
#include <string>

#include "planner/files/exchange/toolpaths/segments.h"
#include "planner/ground/base/result.h"
#include "planner/ground/geometry/vec.h"
#include "planner/model/nouns/forward.h"
#include "planner/model/plan/plan.h"

/// @file Points of a polyline that describe arcs (via_arc_point, via_helix_point): an arc runs from the
/// ordinary point before, through them, to the ordinary point after, by less than a full turn; a full turn
/// (whose ends coincide) has two of them.

namespace capstan::exchange::curves {

struct ViaOptions {
  double coincident_mm = 1e-5;  ///< points nearer are one point
  double radius_mm = 0.01;      ///< how far points may stray from one circle; files have 4 decimals
  bool helix = false;
  geometry::Vec3 axis = {0, 0, 1};  ///< of a helix; an arc's follows from its points
};

/// The arc or helix, in the coordinates of the points. A straight line where a via point coincides with a
/// neighbour or lies between its ends, to within `coincident_mm`. Its centre is rounded to the nanometre
/// where that moves it by less than the arithmetic does.
///
/// Fails  EXC-VIA: no circle through the points, points out of order, or one via point for a full turn.
/// Source ISO 10303-238, via_arc_point and via_helix_point (WHERE rules and informal propositions).
[[nodiscard]] Result<Segment> arc_through(geometry::Vec3 from, std::span<const geometry::Vec3> via,
                                          geometry::Vec3 to, const ViaOptions& options);

/// Puts, in a polyline, a neighbour in the place of each via point that lies within `uncertainty_mm` of it:
/// there the arc degenerates to a line. Its points stay as many, so that what goes by its parameter still
/// does. Returns how many were replaced. Source ISO 10303-238, via_arc_point (coincident within the
/// uncertainty of its context).
std::size_t degenerate_via_points(model::Model& m, model::Ref<model::Polyline> at, double uncertainty_mm);

/// How many via points an arc takes: two for a full turn, else one.
[[nodiscard]] std::size_t via_count(double sweep);

}  // namespace capstan::exchange::curves
