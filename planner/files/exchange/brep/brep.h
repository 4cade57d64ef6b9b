#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "planner/files/exchange/brep/pmi.h"
#include "planner/ground/geometry/vec.h"

namespace capstan::exchange {

using Point3 = geometry::Vec3;      ///< mm
using Direction3 = geometry::Vec3;  ///< a unit vector

/// The surface that a face is a part of.
enum class Carrier : std::uint8_t { kPlane, kCylinder, kCone, kSphere, kTorus, kSpline, kOther };

/// "plane", "cylinder", "cone", "sphere", "torus", "B-spline", "other"
[[nodiscard]] const char* to_text(Carrier carrier);

/// The curve that an edge is a part of. kSpline is also a curve of Bezier, kOther a hyperbola, an offset, ….
enum class Curve : std::uint8_t { kLine, kCircle, kEllipse, kSpline, kOther };

/// How the material meets at an edge: kConvex below half a turn of material, kConcave above, kSmooth where
/// the two faces are tangent within kSmoothAngleRad, kOpen where the edge has not two uses by faces.
enum class Convexity : std::uint8_t { kConvex, kConcave, kSmooth, kOpen };

inline constexpr double kSmoothAngleRad = 0.017453292519943295;  ///< 1 degree

/// One closed chain of edges around a face. Walked in this order and these senses, and seen from outside the
/// material, the face lies on the left. A seam occurs twice, once in each sense.
struct Loop {
  std::vector<std::uint32_t> edges;  ///< into Brep::edges
  std::vector<bool> forward;         ///< per edge: walked from its start to its end
  friend bool operator==(const Loop&, const Loop&) = default;
};

/// A face: a bounded part of its carrier.
struct Face {
  Carrier carrier = Carrier::kOther;
  /// Plane: a point of it. Cylinder, torus: the centre of the placement, on the axis. Cone: the point of the
  /// axis where the radius is `radius`. Sphere: its centre. Spline, other: unused, zero.
  Point3 point;
  /// Plane: the normal of the carrier. Cylinder, cone, torus, sphere: the axis. Spline, other: zero.
  Direction3 axis;
  double radius = 0;        ///< mm: cylinder, sphere, cone at `point`, torus: major
  double minor_radius = 0;  ///< mm: torus
  double half_angle = 0;    ///< radians, 0..pi/2: cone, whose radius grows along +axis
  /// The outward normal of the material is that of the carrier. Normals of cylinders, cones, spheres and tori
  /// point away from the axis, the centre, or the circle of the tube.
  bool same_sense = true;
  /// Cylinder, cone, sphere, torus: the material is on the inside (a boss, a round): true; a hole or a
  /// fillet: false. Others: true.
  bool outward = true;
  std::int64_t id = 0;      ///< `#id` of the ADVANCED_FACE in the file; 0 where there is none
  std::string name;         ///< the face's name in the file
  std::vector<Loop> loops;  ///< the outer one first; a closed sphere or torus may have none
  std::uint32_t first_triangle = 0;
  std::uint32_t triangle_count = 0;  ///< into Brep::triangles
  double area = 0;                   ///< mm2
  friend bool operator==(const Face&, const Face&) = default;
};

/// An edge between two faces.
struct Edge {
  Curve curve = Curve::kOther;
  Point3 start;
  Point3 end;         ///< equal to `start` for a closed edge
  Point3 middle;      ///< at the middle of the curve's parameter
  Point3 centre;      ///< circle and ellipse
  Direction3 axis;    ///< line: from start to end. Circle and ellipse: the axis it turns about, start to end
  double radius = 0;  ///< mm: circle; ellipse: the major one
  double minor_radius = 0;              ///< mm: ellipse
  double length = 0;                    ///< mm
  std::array<std::uint32_t, 2> face{};  ///< the neighbours, lower index first; equal for a seam and for kOpen
  Convexity convexity = Convexity::kOpen;
  double dihedral = 0;  ///< radians of material at `middle`, 0..2 pi; 0 for kOpen
  friend bool operator==(const Edge&, const Edge&) = default;
};

/// A connected piece: a solid, or a sheet without an inside.
struct Body {
  bool solid = false;
  std::uint32_t first_face = 0;
  std::uint32_t face_count = 0;
  double volume = 0;  ///< mm3; 0 for a sheet
  double area = 0;    ///< mm2
  std::int64_t id =
      0;  ///< `#id` of the solid or shell in the file; equal for a body that is placed many times
  std::string name;
  friend bool operator==(const Body&, const Body&) = default;
};

/// A boundary representation as planning reads it: faces on their carriers, loops, edges with the angle of
/// material, and a tessellation to prove with.
///
/// Frame  that of the file's assembly, each body placed in it.
/// Units  mm and radians, whatever the file has.
struct Brep {
  std::vector<Body> bodies;
  std::vector<Face> faces;  ///< those of a body stand together
  std::vector<Edge> edges;
  std::vector<Point3> points;  ///< of the tessellation
  std::vector<std::array<std::uint32_t, 3>>
      triangles;       ///< into `points`; counter-clockwise seen from outside
  double chord = 0;    ///< mm: what the tessellation was asked to keep
  std::string unit;    ///< of lengths in the file: "mm", "inch", "m", …, or "mixed"
  geometry::Box3 box;  ///< of the exact geometry
  Pmi pmi;             ///< what the file asks of the shape
  friend bool operator==(const Brep&, const Brep&) = default;
};

}  // namespace capstan::exchange
