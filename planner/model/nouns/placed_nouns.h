#pragma once

#include <string_view>

#include "planner/ground/geometry/placement.h"
#include "planner/model/nouns/arena/model.h"
#include "planner/model/nouns/geometric_item.h"

/// @file Nouns of points, directions and placements (ISO 10303-42), made from numbers. None has a coordinate
/// of minus zero, so that equal places are written as equal text.

namespace capstan::model {

/// Adds a CARTESIAN_POINT.
/// Units   mm.
Ref<CartesianPoint> add_point(Model& m, geometry::Vec3 at, std::string_view name = "");
/// Adds a DIRECTION; its ratios are those of `along`, which need not have the length one.
Ref<Direction> add_direction(Model& m, geometry::Vec3 along, std::string_view name = "");
/// Adds an AXIS2_PLACEMENT_3D with its location, its axis (z) and its ref_direction (x).
/// Frame   `at` in the frame that the noun is stated in.
Ref<Axis2Placement3d> add_placement(Model& m, const geometry::Placement& at, std::string_view name = "");
/// Adds an AXIS2_PLACEMENT_3D with a location alone: its axes are those of the frame that it is stated in.
Ref<Axis2Placement3d> add_placement_at(Model& m, geometry::Vec3 at, std::string_view name = "");

}  // namespace capstan::model
