#include "planner/files/from_cad/solid/part.h"

#include <algorithm>
#include <cmath>

namespace capstan::from_cad {
namespace {

using exchange::Carrier;

/// An area that is no more than the rounding of meshes, mm2.
constexpr double kSpeckMm2 = 1e-3;
/// A direction is along an axis of the workpiece, but for rounding.
constexpr double kAlong = 1e-9;

Vec3 clean(Vec3 d) {
  const auto snap = [](double v) {
    if (std::abs(v) < kAlong) return 0.0;
    if (std::abs(std::abs(v) - 1.0) < kAlong) return v > 0.0 ? 1.0 : -1.0;
    return v;
  };
  return {snap(d.x), snap(d.y), snap(d.z)};
}

/// Whether a loop is a sliver between two meshes of one round wall, each of which leaves it by up to a
/// chord's height.
bool sliver(const geometry::Loop& loop, double chord_mm) {
  double round = 0.0;
  for (std::size_t i = 0, n = loop.size(); i < n; ++i) round += norm(loop[(i + 1) % n] - loop[i]);
  // Of a triangle as high as that over a long side, the area is so much of what goes round it.
  return std::abs(geometry::signed_area(loop)) < 0.25 * (2.0 * chord_mm) * round;
}

}  // namespace

Part::Part(const Brep& brep, std::size_t body, const geometry::Box3& raw)
    : brep_(brep), body_(body), raw_(raw), raw_mesh_(mesh_of(raw)) {
  mesh_.vertices = brep.points;
  const exchange::Body& b = brep.bodies[body];
  for (std::uint32_t f = b.first_face; f < b.first_face + b.face_count; ++f) {
    const exchange::Face& face = brep.faces[f];
    for (std::uint32_t t = face.first_triangle; t < face.first_triangle + face.triangle_count; ++t) {
      mesh_.triangles.push_back(brep.triangles[t]);
      face_of_.push_back(f);
    }
  }
}

geometry::Placement Part::frame_along(Vec3 access) {
  const Vec3 z = clean(access);
  return *geometry::make_placement({}, z);
}

std::pair<double, double> Part::raw_span(const geometry::Placement& frame) const {
  const geometry::Box3 box = geometry::transformed(raw_, geometry::inverse(frame));
  return {box.lo.z, box.hi.z};
}

std::pair<double, double> Part::span(const geometry::Placement& frame,
                                     const std::vector<std::uint32_t>& faces) const {
  double lo = 1e300;
  double hi = -1e300;
  for (const std::uint32_t f : faces) {
    const exchange::Face& face = brep_.faces[f];
    for (std::uint32_t t = face.first_triangle; t < face.first_triangle + face.triangle_count; ++t) {
      for (const std::uint32_t corner : brep_.triangles[t]) {
        const double z = dot(brep_.points[corner], frame.z);
        lo = std::min(lo, z);
        hi = std::max(hi, z);
      }
    }
  }
  return {lo, hi};
}

const Cleared& Part::cleared(const geometry::Placement& frame, double z_mm,
                             const std::vector<std::uint32_t>& but) const {
  const auto same = std::find_if(known_.begin(), known_.end(), [&](const auto& k) {
    return k.first.access == frame.z && std::abs(k.first.z - z_mm) < 0.1 * kLevelMm && k.first.but == but;
  });
  if (same != known_.end()) return same->second;
  std::vector<bool> out(mesh_.triangles.size(), false);
  for (std::size_t i = 0; i < out.size(); ++i)
    out[i] = std::binary_search(but.begin(), but.end(), face_of_[i]);
  Cleared c;
  c.raw = shadow_above(raw_mesh_, {}, frame, z_mm + kLevelMm);
  const geometry::Region part = shadow_above(mesh_, out, frame, z_mm + kLevelMm);
  for (geometry::Region& room : geometry::pieces(geometry::subtract(c.raw, part))) {
    if (geometry::area(room) <= kSpeckMm2) continue;
    std::erase_if(room.loops, [&](const geometry::Loop& loop) {
      return geometry::signed_area(loop) < 0.0 && sliver(loop, brep_.chord);
    });
    c.rooms.push_back(std::move(room));
  }
  known_.emplace_back(Key{frame.z, z_mm, but}, std::move(c));
  return known_.back().second;
}

std::vector<RoundWall> Part::round_walls(const geometry::Placement& frame) const {
  std::vector<RoundWall> out;
  const exchange::Body& b = body();
  for (std::uint32_t f = b.first_face; f < b.first_face + b.face_count; ++f) {
    const exchange::Face& face = brep_.faces[f];
    if (face.carrier != Carrier::kCylinder || norm(cross(face.axis, frame.z)) > recognise::kSameAngleRad)
      continue;
    const Vec2 centre = xy(frame.to_local(face.point));
    const bool known = std::any_of(out.begin(), out.end(), [&](const RoundWall& w) {
      return norm(w.centre - centre) < 0.1 * recognise::kSameLengthMm &&
             std::abs(w.radius_mm - face.radius) < 0.1 * recognise::kSameLengthMm;
    });
    if (!known) out.push_back({centre, face.radius});
  }
  return out;
}

std::vector<FlatWall> Part::flat_walls(const geometry::Placement& frame) const {
  std::vector<FlatWall> out;
  const exchange::Body& b = body();
  for (std::uint32_t f = b.first_face; f < b.first_face + b.face_count; ++f) {
    const exchange::Face& face = brep_.faces[f];
    if (face.carrier != Carrier::kPlane || std::abs(dot(face.axis, frame.z)) > recognise::kSameAngleRad)
      continue;
    const Vec3 d = geometry::normalised(cross(frame.z, face.axis));
    double lo = 1e300;
    double hi = -1e300;
    for (std::uint32_t t = face.first_triangle; t < face.first_triangle + face.triangle_count; ++t) {
      for (const std::uint32_t corner : brep_.triangles[t]) {
        const double along = dot(brep_.points[corner] - face.point, d);
        lo = std::min(lo, along);
        hi = std::max(hi, along);
      }
    }
    if (lo > hi) continue;
    out.push_back({xy(frame.to_local(face.point + lo * d)), xy(frame.to_local(face.point + hi * d))});
  }
  return out;
}

std::vector<Part::Spot> Part::spots(std::uint32_t f) const {
  std::vector<Spot> out;
  const exchange::Face& face = brep_.faces[f];
  for (std::uint32_t t = face.first_triangle; t < face.first_triangle + face.triangle_count; ++t) {
    const auto& [a, b, c] = brep_.triangles[t];
    const Vec3 p = brep_.points[a], q = brep_.points[b], r = brep_.points[c];
    const Vec3 n = cross(q - p, r - p);
    const double twice = norm(n);
    if (twice < 1e-12) continue;
    out.push_back({(1.0 / 3.0) * (p + q + r), (1.0 / twice) * n, 0.5 * twice});
  }
  return out;
}

Vec3 normal_of(const exchange::Face& face) { return face.same_sense ? face.axis : -1.0 * face.axis; }

geometry::Region all_of(const Cleared& cleared) {
  geometry::Region out;
  for (const geometry::Region& r : cleared.rooms) out = geometry::unite(out, r);
  return out;
}

int room_at(const Cleared& cleared, Vec2 p) {
  for (std::size_t i = 0; i < cleared.rooms.size(); ++i) {
    if (geometry::contains(cleared.rooms[i], p)) return static_cast<int>(i);
  }
  return -1;
}

}  // namespace capstan::from_cad
