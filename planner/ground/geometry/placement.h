#pragma once

#include "planner/ground/base/result.h"
#include "planner/ground/geometry/vec.h"

namespace capstan::geometry {

/// A right-handed orthonormal frame: where a local system sits in its parent's.
///
/// Convention   the model's one convention is ISO 14649's: a feature's frame lies at the top of the feature,
///              z points out of the material, depths go along -z.
struct Placement {
  Vec3 origin;
  Vec3 x{1.0, 0.0, 0.0};
  Vec3 y{0.0, 1.0, 0.0};
  Vec3 z{0.0, 0.0, 1.0};

  [[nodiscard]] constexpr Vec3 to_parent(Vec3 p) const { return origin + direction_to_parent(p); }
  [[nodiscard]] constexpr Vec3 direction_to_parent(Vec3 d) const { return d.x * x + d.y * y + d.z * z; }
  [[nodiscard]] constexpr Vec3 to_local(Vec3 p) const { return direction_to_local(p - origin); }
  [[nodiscard]] constexpr Vec3 direction_to_local(Vec3 d) const { return {dot(d, x), dot(d, y), dot(d, z)}; }
  friend bool operator==(const Placement&, const Placement&) = default;
};

/// The frame of an AXIS2_PLACEMENT_3D: ref_direction is projected onto the plane normal to the axis.
/// Fails   GEO-DIRECTION for a zero axis or a ref_direction parallel to it.
/// Source  ISO 10303-42, build_axes and first_proj_axis.
[[nodiscard]] Result<Placement> make_placement(Vec3 origin, Vec3 axis, Vec3 ref_direction);
/// As above with the ref_direction that ISO 10303-42 defaults to (x, or y when the axis is along x).
[[nodiscard]] Result<Placement> make_placement(Vec3 origin, Vec3 axis);

/// The frame `inner` (given in `outer`'s local system) in the parent system of `outer`.
[[nodiscard]] Placement compose(const Placement& outer, const Placement& inner);
/// The parent's frame seen from inside.
[[nodiscard]] Placement inverse(const Placement& p);

/// The box around a box that is brought to another frame.
[[nodiscard]] Box3 transformed(const Box3& box, const Placement& to);

}  // namespace capstan::geometry
