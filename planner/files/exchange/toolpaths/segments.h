#pragma once

#include <vector>

#include "planner/files/exchange/toolpaths/curves.h"
#include "planner/ground/base/result.h"
#include "planner/ground/geometry/vec.h"

namespace capstan::exchange::curves {

/// A straight line or an arc in space, in the curve's own coordinates. The arc turns by `sweep` about `axis`
/// through `centre` (positive: counter-clockwise) and rises evenly along the axis.
struct Segment {
  geometry::Vec3 from, to;
  bool arc = false;
  geometry::Vec3 centre, axis;
  double sweep = 0.0;
  double u_from = 0.0, u_to = 0.0;  ///< the curve's parameter at its ends; equal where it is not known
};

/// The curve from its start to its end. Never recurses deeper than 32.
[[nodiscard]] Result<std::vector<Segment>> segments_of(const model::Model& m, model::AnyRef curve,
                                                       const CurveOptions& options, Job& job);

/// The other way round.
void reverse(std::vector<Segment>& segments);

/// The point at fraction t.
[[nodiscard]] geometry::Vec3 at(const Segment& s, double t);

/// A B-spline's points, sampled so that chords stay within the tolerance.
[[nodiscard]] Result<std::vector<geometry::Vec3>> sample_spline(const model::Model& m, model::AnyRef curve,
                                                                double from, double to, bool whole,
                                                                const CurveOptions& options);

/// The least value of a one-dimensional B-spline between the parameters of each move, which are taken as
/// fractions of its whole range; entry 0 is its first value.
[[nodiscard]] Result<std::vector<double>> values_of_spline(const model::Model& m, model::AnyRef curve,
                                                           const std::vector<double>& from,
                                                           const std::vector<double>& to);

}  // namespace capstan::exchange::curves
