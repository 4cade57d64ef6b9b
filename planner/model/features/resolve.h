#pragma once

#include <string>

#include "planner/ground/base/result.h"
#include "planner/ground/geometry/placement.h"
#include "planner/ground/geometry/vec.h"
#include "planner/model/features/shape.h"
#include "planner/model/nouns/arena/model.h"
#include "planner/model/nouns/forward.h"

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
  std::string grade;  ///< "IT9": the coarsest ISO grade that the tolerance holds; empty when there is none
};

/// The length and its tolerance, which always has a width; what either kind of tolerance means: fit/stated.h.
/// Fails  MDL-MISSING when unset or without theoretical_size; MDL-LENGTH below 0; as `stated` for a tolerance
/// that cannot be read.
[[nodiscard]] Result<ResolvedLength> length(const Model& model, Ref<TolerancedLengthMeasure> m);

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
