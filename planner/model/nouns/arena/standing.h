#pragma once

#include "planner/ground/base/result.h"
#include "planner/ground/geometry/placement.h"
#include "planner/model/nouns/arena/model.h"

namespace capstan::model {

/// Of the coordinates that a feature's placement is stated in, the frame in workpiece coordinates: the
/// workpiece's own, or those of the compound or pattern that lists the feature (the first, where several do),
/// by the same reading as its shape's (shape/containers.cpp).
/// Fails  SHP-UNSUPPORTED for what is nested in itself; as `placement` for one that is none.
[[nodiscard]] Result<geometry::Placement> coordinates_of(const Model& model, AnyRef feature);

}  // namespace capstan::model
