#pragma once

#include <optional>
#include <string>
#include <vector>

#include "planner/ground/geometry/placement.h"
#include "planner/model/nouns/arena/model.h"
#include "planner/model/nouns/forward.h"
#include "planner/proof/verify/volumes/outline.h"

namespace capstan::verify::volumes {

/// Small nouns as numbers, read apart from planner/model/features: what a check is to find, it must not
/// share. Each gives nothing for what is not stated, or is no number that can be.

[[nodiscard]] std::optional<geometry::Vec3> point_of(const model::Model& m, model::AnyRef point);
[[nodiscard]] std::optional<geometry::Vec3> unit_of(const model::Model& m, model::AnyRef direction);
/// The frame of an axis2_placement_3d as ISO 10303-42 builds it: z along the axis, x along the part of
/// ref_direction that is square to it, each with its default.
[[nodiscard]] std::optional<geometry::Placement> frame_of(const model::Model& m, model::AnyRef placement);
/// As above; an unset one is the frame it would stand in.
[[nodiscard]] std::optional<geometry::Placement> frame_or_same(const model::Model& m,
                                                               model::AnyRef placement);
[[nodiscard]] std::optional<double> size_of(const model::Model& m, model::AnyRef toleranced_length);
[[nodiscard]] std::optional<double> number_of(const model::Model& m, model::AnyRef numeric_parameter);

/// A curve as exact edges in the plane z = `height_mm` of the system it is stated in; B-splines as chords
/// that stray by less than kSplineMm. `fault` says why there are none.
struct Course {
  std::vector<Edge> edges;
  double height_mm = 0.0;
  std::string fault;
};
inline constexpr double kSplineMm = 0.0005;  ///< half of the planner's own chords; default, unsourced
[[nodiscard]] Course edges_of(const model::Model& m, model::AnyRef curve);
/// The edges in another plane: of an inner system that stands in an outer one, either way up.
[[nodiscard]] Course moved(const Course& c, const geometry::Placement& inner);

}  // namespace capstan::verify::volumes
