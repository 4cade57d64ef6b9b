#pragma once

#include <vector>

#include "planner/ground/base/result.h"
#include "planner/ground/geometry/vec.h"
#include "planner/model/nouns/arena/model.h"
#include "planner/model/nouns/forward.h"

namespace capstan::model {

/// Points along a curve in the system it is stated in, first and last included, chords within tolerance_mm of
/// the curve: polyline, trimmed line, circle and ellipse, full circle, composite curve (of segments, or
/// straight of curves, as files have it), B-splines (rational with weights 1). Fails  CRV-… for a curve of
/// another kind or one without what its kind needs.
[[nodiscard]] Result<std::vector<geometry::Vec3>> curve_points(const Model& model, AnyRef curve,
                                                               double tolerance_mm = 0.001);

}  // namespace capstan::model
