#pragma once

#include <string>

#include "planner/base/result.h"
#include "planner/geometry/placement.h"
#include "planner/geometry/vec.h"
#include "planner/model/model.h"
#include "planner/model/nouns/forward.h"
#include "planner/model/shape.h"

namespace capstan::model {

/// What small nouns mean as numbers: points, directions, placements, toleranced lengths, depths.

/// Coordinates of a point, mm; a missing third coordinate is 0.
/// Fails  MDL-MISSING when unset or without two or three coordinates.
[[nodiscard]] Result<geometry::Vec3> point(const Model& model, Ref<CartesianPoint> p);

/// A unit vector. Fails  MDL-MISSING when unset; GEO-DIRECTION without a length.
[[nodiscard]] Result<geometry::Vec3> direction(const Model& model, Ref<Direction> d);

/// The frame in the system it is stated in; absent axis and ref_direction as ISO 10303-42 defaults them.
/// Fails  MDL-MISSING without a location; GEO-DIRECTION for a frame that is none.
[[nodiscard]] Result<geometry::Placement> placement(const Model& model, Ref<Axis2Placement3d> p);
/// As above, with the parent's own frame for an unset handle: what ISO 14649 means by an absent one.
[[nodiscard]] Result<geometry::Placement> placement_or_identity(const Model& model, Ref<Axis2Placement3d> p);

/// A length with its tolerance as deviations from nominal, mm.
struct ResolvedLength : Toleranced {
  std::string
      grade;  ///< "IT9": the coarsest ISO grade that lies within the tolerance; empty when none stated
};

/// The length and its tolerance.
///
///     plus_minus_value   [nominal - lower_limit, nominal + upper_limit]; where that is empty and
///                        lower_limit is negative, lower_limit is read as a signed deviation
///     limits_and_fits    deviation is the fundamental one: the limit nearer to nominal; the tolerance
///                        lies from there away from nominal. 0: upwards for a hole, downwards for a shaft
///
/// Fails   MDL-MISSING when unset or without theoretical_size.
/// Source  ISO 14649-10, toleranced_length_measure; ISO 286-1 for deviations.
[[nodiscard]] Result<ResolvedLength> length(const Model& model, Ref<TolerancedLengthMeasure> m);

/// The standard tolerance of a grade, mm. Grades 5..18, sizes to 500 mm; 0 outside.
/// Source  ISO 286-1, table 1.
[[nodiscard]] double tolerance_of_grade(int grade, double nominal_mm);
/// The coarsest grade whose tolerance does not exceed `width_mm`; 0 none.
[[nodiscard]] int grade_of_tolerance(double nominal_mm, double width_mm);

/// How deep a feature goes.
struct ResolvedDepth {
  double depth_mm = 0.0;        ///< along -z of the feature's frame, from its origin to the depth surface
  Toleranced tolerance;         ///< stated only where the file gives the depth as a toleranced length
  geometry::Placement surface;  ///< the depth surface's, feature frame
  bool tilted = false;          ///< its normal is not along the feature's z
};

/// The depth of a machining feature: where its depth surface cuts the feature's z axis.
/// A TOLERANCED_LENGTH_MEASURE in place of the surface (seen in files) is that length downwards.
/// Fails  MDL-MISSING when the feature has no depth; MDL-DEPTH when the surface is parallel to the axis.
[[nodiscard]] Result<ResolvedDepth> depth_of(const Model& model, AnyRef feature);

}  // namespace capstan::model
