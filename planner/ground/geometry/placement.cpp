#include "planner/ground/geometry/placement.h"

namespace capstan::geometry {
namespace {

constexpr double kParallel = 1e-9;  // sine below which two directions count as parallel

}  // namespace

Result<Placement> make_placement(Vec3 origin, Vec3 axis, Vec3 ref_direction) {
  if (!(norm(axis) > 0.0)) return fail("GEO-DIRECTION", "the axis of a placement has no length");
  if (!(norm(ref_direction) > 0.0))
    return fail("GEO-DIRECTION", "the ref_direction of a placement has no length");
  const Vec3 z = normalised(axis);
  const Vec3 r = normalised(ref_direction);
  const Vec3 in_plane = r - dot(r, z) * z;
  if (norm(in_plane) < kParallel) {
    return fail("GEO-DIRECTION", "the ref_direction of a placement is parallel to its axis");
  }
  const Vec3 x = normalised(in_plane);
  return Placement{.origin = origin, .x = x, .y = cross(z, x), .z = z};
}

Result<Placement> make_placement(Vec3 origin, Vec3 axis) {
  if (!(norm(axis) > 0.0)) return fail("GEO-DIRECTION", "the axis of a placement has no length");
  const Vec3 z = normalised(axis);
  const bool along_x = norm(cross(z, Vec3{1.0, 0.0, 0.0})) < kParallel;
  return make_placement(origin, axis, along_x ? Vec3{0.0, 1.0, 0.0} : Vec3{1.0, 0.0, 0.0});
}

Placement compose(const Placement& outer, const Placement& inner) {
  return {.origin = outer.to_parent(inner.origin),
          .x = outer.direction_to_parent(inner.x),
          .y = outer.direction_to_parent(inner.y),
          .z = outer.direction_to_parent(inner.z)};
}

Placement inverse(const Placement& p) {
  return {.origin = p.to_local({0.0, 0.0, 0.0}),
          .x = p.direction_to_local({1.0, 0.0, 0.0}),
          .y = p.direction_to_local({0.0, 1.0, 0.0}),
          .z = p.direction_to_local({0.0, 0.0, 1.0})};
}

Box3 transformed(const Box3& box, const Placement& to) {
  Box3 out;
  for (const double x : {box.lo.x, box.hi.x}) {
    for (const double y : {box.lo.y, box.hi.y}) {
      for (const double z : {box.lo.z, box.hi.z}) out.add(to.to_parent({x, y, z}));
    }
  }
  return out;
}

}  // namespace capstan::geometry
