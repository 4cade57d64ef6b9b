#pragma once

#include <optional>

#include "planner/files/exchange/brep/brep.h"

namespace capstan::exchange {

/// A point of a face, and the normal there that points out of the material.
struct FacePoint {
  Point3 point;
  Direction3 normal;
};

/// Sets both senses of a face on a cylinder, cone, sphere or torus, by one point of the face. A cone whose
/// axis and half angle describe the other half of the double cone is turned, and stands at its apex.
void set_senses(const FacePoint& at, Face& face);

/// One of two faces at a point of their edge, which is walked with the face on its left.
struct Side {
  Direction3 into;    ///< at right angles to the edge, into the face
  Direction3 normal;  ///< out of the material
};

/// The side of a face at a point of an edge with this tangent; nothing where tangent and normal are parallel.
[[nodiscard]] std::optional<Side> side_of(Direction3 normal, geometry::Vec3 tangent);

/// Sets angle and convexity of an edge between two sides: the angle from the one through the material to the
/// other.
void set_angle(const Side& a, const Side& b, Edge& edge);

}  // namespace capstan::exchange
