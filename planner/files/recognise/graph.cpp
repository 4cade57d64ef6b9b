#include "planner/files/recognise/graph.h"

#include <algorithm>
#include <map>
#include <tuple>

namespace capstan::recognise {
namespace {

using exchange::Brep;
using exchange::Carrier;
using exchange::Convexity;
using geometry::cross;
using geometry::dot;
using geometry::norm;

Patch patch_of(const exchange::Face& face) {
  Patch p;
  p.carrier = face.carrier;
  p.axis = face.carrier == Carrier::kPlane && !face.same_sense ? -1.0 * face.axis : face.axis;
  p.point = face.point;
  p.offset = face.carrier == Carrier::kPlane ? dot(p.axis, face.point) : 0.0;
  p.radius = face.radius;
  p.minor_radius = face.minor_radius;
  p.half_angle = face.half_angle;
  p.outward = face.outward;
  p.area = face.area;
  return p;
}

bool near(double a, double b) { return std::abs(a - b) < kSameLengthMm; }

/// How far the axis of `b` passes from the point of `a`.
double axes_apart(const Patch& a, const Patch& b) { return norm(cross(b.point - a.point, a.axis)); }

}  // namespace

bool same_direction(Direction3 a, Direction3 b) { return norm(a - b) < kSameAngleRad; }
bool parallel(Direction3 a, Direction3 b) { return norm(cross(a, b)) < kSameAngleRad; }
bool perpendicular(Direction3 a, Direction3 b) { return std::abs(dot(a, b)) < kSameAngleRad; }

bool same_surface(const Patch& a, const Patch& b) {
  if (a.carrier != b.carrier) return false;
  switch (a.carrier) {
    case Carrier::kPlane:
      // Measured at the points themselves: far from the origin, offsets of almost equal normals differ.
      return same_direction(a.axis, b.axis) && std::abs(dot(b.point - a.point, a.axis)) < kSameLengthMm;
    case Carrier::kCylinder:
      return a.outward == b.outward && near(a.radius, b.radius) && parallel(a.axis, b.axis) &&
             axes_apart(a, b) < kSameLengthMm;
    case Carrier::kCone: {
      if (a.outward != b.outward || !same_direction(a.axis, b.axis) || axes_apart(a, b) > kSameLengthMm)
        return false;
      if (std::abs(a.half_angle - b.half_angle) > kSameAngleRad) return false;
      return near(a.radius + dot(b.point - a.point, a.axis) * std::tan(a.half_angle), b.radius);
    }
    case Carrier::kSphere:
      return a.outward == b.outward && near(a.radius, b.radius) && norm(a.point - b.point) < kSameLengthMm;
    case Carrier::kTorus:
      return a.outward == b.outward && near(a.radius, b.radius) && near(a.minor_radius, b.minor_radius) &&
             parallel(a.axis, b.axis) && norm(a.point - b.point) < kSameLengthMm;
    default:
      return false;
  }
}

Groups::Groups(std::size_t count) : parent_(count) {
  for (std::size_t i = 0; i < count; ++i) parent_[i] = static_cast<std::uint32_t>(i);
}

std::uint32_t Groups::root(std::uint32_t a) const {
  while (parent_[a] != a) a = parent_[a];
  return a;
}

void Groups::join(std::uint32_t a, std::uint32_t b) {
  const std::uint32_t low = std::min(root(a), root(b));
  const std::uint32_t high = std::max(root(a), root(b));
  parent_[high] = low;
}

Graph make_graph(const Brep& brep, const exchange::Body& body) {
  const auto inside = [&](std::uint32_t f) {
    return f >= body.first_face && f - body.first_face < body.face_count;
  };
  std::vector<Patch> of_face;
  for (std::uint32_t f = 0; f < body.face_count; ++f)
    of_face.push_back(patch_of(brep.faces[body.first_face + f]));

  Groups groups(body.face_count);
  for (const exchange::Edge& edge : brep.edges) {
    if (edge.convexity != Convexity::kSmooth || !inside(edge.face[0]) || !inside(edge.face[1])) continue;
    const std::uint32_t a = edge.face[0] - body.first_face;
    const std::uint32_t b = edge.face[1] - body.first_face;
    if (same_surface(of_face[a], of_face[b])) groups.join(a, b);
  }

  Graph graph;
  std::vector<std::uint32_t> patch_at(body.face_count);
  for (std::uint32_t f = 0; f < body.face_count; ++f) {
    const std::uint32_t root = groups.root(f);
    if (root == f) {
      patch_at[f] = static_cast<std::uint32_t>(graph.patches.size());
      graph.patches.push_back(of_face[f]);
    } else {
      patch_at[f] = patch_at[root];
      graph.patches[patch_at[f]].area += of_face[f].area;
    }
    graph.patches[patch_at[f]].faces.push_back(body.first_face + f);
  }

  std::map<std::tuple<std::uint32_t, std::uint32_t, Convexity>, std::uint32_t> known;
  for (std::uint32_t e = 0; e < brep.edges.size(); ++e) {
    const exchange::Edge& edge = brep.edges[e];
    if (edge.convexity == Convexity::kOpen || !inside(edge.face[0]) || !inside(edge.face[1])) continue;
    const auto [a, b] =
        std::minmax(patch_at[edge.face[0] - body.first_face], patch_at[edge.face[1] - body.first_face]);
    if (a == b) continue;  // a seam, or where a face was split
    const auto [at, fresh] =
        known.emplace(std::tuple(a, b, edge.convexity), static_cast<std::uint32_t>(graph.joins.size()));
    if (fresh) {
      graph.joins.push_back({a, b, edge.convexity, {}});
      graph.patches[a].joins.push_back(at->second);
      graph.patches[b].joins.push_back(at->second);
    }
    graph.joins[at->second].edges.push_back(e);
  }
  return graph;
}

}  // namespace capstan::recognise
