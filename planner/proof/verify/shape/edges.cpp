#include "planner/proof/verify/shape/edges.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "planner/ground/geometry/mesh/welded.h"
#include "planner/proof/verify/shape/lattice.h"

namespace capstan::verify {
namespace {

using geometry::Vec3;

/// Faces that turn by less are one curved face in chords. Default, unsourced.
const double kSharpCosine = std::cos(std::numbers::pi / 6.0);

/// A side of a triangle, from the vertex of the lower number.
struct Side {
  std::uint32_t a = 0, b = 0, triangle = 0;
  friend auto operator<=>(const Side&, const Side&) = default;
};

struct SharpEdge {
  Vec3 from, to, inwards;  ///< `inwards`: to where it is 1 mm within both faces
};

Vec3 normal_of(const geometry::Mesh& mesh, std::uint32_t i) {
  const auto t = corners(mesh, i);
  const Vec3 n = cross(t[1] - t[0], t[2] - t[0]);
  return norm(n) > 0.0 ? normalised(n) : Vec3{};
}

std::vector<SharpEdge> sharp_edges(const geometry::Mesh& mesh) {
  const std::vector<std::uint32_t> one = geometry::welded(mesh);
  std::vector<Side> sides;
  sides.reserve(3 * mesh.triangles.size());
  for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
    const auto& t = mesh.triangles[i];
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = one[t[k]], b = one[t[(k + 1) % 3]];
      sides.push_back({std::min(a, b), std::max(a, b), i});
    }
  }
  std::sort(sides.begin(), sides.end());
  std::vector<SharpEdge> out;
  for (std::size_t i = 0; i + 1 < sides.size(); ++i) {
    const Side &s = sides[i], &o = sides[i + 1];
    if (s.a != o.a || s.b != o.b) continue;
    const Vec3 n = normal_of(mesh, s.triangle), m = normal_of(mesh, o.triangle);
    const double cosine = dot(n, m);
    if (cosine > kSharpCosine || cosine < -kSharpCosine) continue;
    const Vec3 from = mesh.vertices[s.a], to = mesh.vertices[s.b];
    // Convex: the other triangle falls away behind the plane of the first.
    double beyond = 0.0;
    for (const Vec3& c : corners(mesh, o.triangle)) beyond = std::min(beyond, dot(n, c - from));
    if (!(beyond < -1e-9)) continue;
    out.push_back({from, to, (-1.0 / (1.0 + cosine)) * (n + m)});
  }
  return out;
}

}  // namespace

std::vector<Vec3> inside_sharp_edges(const geometry::Mesh& mesh, double inside_mm, std::size_t most) {
  const std::vector<SharpEdge> edges = sharp_edges(mesh);
  double length = 0.0;
  for (const SharpEdge& e : edges) length += norm(e.to - e.from);
  // Half of the places by length; short edges take one each, or one for several.
  const double apart = std::max(length / (0.5 * static_cast<double>(most)), 1e-9);
  std::vector<Vec3> out;
  double since = apart;
  for (const SharpEdge& e : edges) {
    const double mm = norm(e.to - e.from);
    since += mm;
    if (mm < apart && since < apart && out.size() > most / 2) continue;
    since = 0.0;
    const int pieces = std::max(1, static_cast<int>(mm / apart));
    for (int i = 0; i < pieces && out.size() < most; ++i)
      out.push_back(e.from + ((i + 0.5) / pieces) * (e.to - e.from) + inside_mm * e.inwards);
  }
  return out;
}

}  // namespace capstan::verify
