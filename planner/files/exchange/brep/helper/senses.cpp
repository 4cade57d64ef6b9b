#include "planner/files/exchange/brep/helper/senses.h"

#include <cmath>
#include <numbers>

namespace capstan::exchange {
namespace {

geometry::Vec3 across(geometry::Vec3 v, Direction3 axis) { return v - dot(v, axis) * axis; }

/// Away from the axis, the centre, or the circle of the tube: the normal of the carrier, not of unit length.
geometry::Vec3 away(const Face& face, Point3 at) {
  const geometry::Vec3 out = at - face.point;
  switch (face.carrier) {
    case Carrier::kSphere:
      return out;
    case Carrier::kTorus: {
      const geometry::Vec3 radial = across(out, face.axis);
      const double r = norm(radial);
      return r > 0.0 ? out - (face.radius / r) * radial : out;
    }
    default:
      return across(out, face.axis);
  }
}

}  // namespace

void set_senses(const FacePoint& at, Face& face) {
  if (face.carrier == Carrier::kCone) {
    // From the apex along the axis the radius grows.
    const Point3 apex = face.point - (face.radius / std::tan(face.half_angle)) * face.axis;
    if (dot(at.point - apex, face.axis) < 0.0) {
      face.axis = -1.0 * face.axis;
      face.point = apex;
      face.radius = 0.0;
    }
  }
  face.same_sense = face.outward = dot(at.normal, away(face, at.point)) > 0.0;
}

std::optional<Side> side_of(Direction3 normal, geometry::Vec3 tangent) {
  const geometry::Vec3 into = cross(normal, tangent);
  const double length = norm(into);
  if (!(length > 1e-9 * norm(tangent)) || !std::isfinite(length)) return std::nullopt;
  return Side{(1.0 / length) * into, normal};
}

void set_angle(const Side& a, const Side& b, Edge& edge) {
  constexpr double kPi = std::numbers::pi;
  double angle = std::atan2(-dot(b.into, a.normal), dot(b.into, a.into));
  if (angle < 0.0) angle += 2.0 * kPi;
  edge.dihedral = angle;
  edge.convexity = std::abs(angle - kPi) <= kSmoothAngleRad ? Convexity::kSmooth
                   : angle < kPi                            ? Convexity::kConvex
                                                            : Convexity::kConcave;
}

}  // namespace capstan::exchange
