#include "planner/ground/geometry/mesh/mesh_creases.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

#include "planner/ground/geometry/mesh/mesh_corners.h"
#include "planner/ground/geometry/mesh/mesh_form.h"

// Edges are found by sorting the sides of all triangles. A curve is drawn by creases side by side that turn
// about alike: from the facets of a crease, and those that go on from them without a turn, another one is
// looked for. Where there is none on either side, the crease is drawn as such, however narrow its facets are.

namespace capstan::geometry {
namespace {

/// Of the largest coordinate: what the corners of two triangles may be off in an STL file, whose numbers have
/// 24 bits, each by half of the last one. Derived.
constexpr double kRounding = 4.0 / 16777216.0;
/// Shares of a crease's turn: less is none, and from the other on it is one of the same curve. Defaults,
/// unsourced.
constexpr double kGoesOn = 0.25, kAlike = 1.0 / 3.0;
constexpr std::uint32_t kNone = 0xffffffffU;

/// An edge of two facets that face up, or of one and a wall.
struct Edge {
  std::array<std::uint32_t, 2> facets{kNone, kNone};
  std::uint32_t a = 0, b = 0;
  double turn_rad = 0.0;  ///< above 0 of a concave edge
};

class Facets {
 public:
  explicit Facets(const Mesh& mesh) : mesh_(mesh), normals_(mesh.triangles.size()) {
    const MeshForm form = form_of(mesh);
    solid_ = form.kind == MeshForm::Kind::kSolid;
    struct Side {
      std::uint64_t ends = 0;
      std::uint32_t facet = 0, side = 0;
    };
    std::vector<Side> sides;
    for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
      normals_[i] = seen_normal(mesh.triangles[i], solid_ && form.inside_out);
      if (!(norm(normals_[i]) > 0.0)) continue;
      for (std::uint32_t k = 0; k < 3; ++k) {
        const std::uint64_t p = mesh.triangles[i][k], q = mesh.triangles[i][(k + 1) % 3];
        sides.push_back({std::min(p, q) << 32U | std::max(p, q), i, k});
      }
    }
    std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
      return a.ends != b.ends ? a.ends < b.ends : a.facet < b.facet;
    });
    edge_of_.assign(3 * mesh.triangles.size(), kNone);
    for (std::size_t i = 0, end = 0; i < sides.size(); i = end) {
      while (end < sides.size() && sides[end].ends == sides[i].ends) ++end;
      if (end - i != 2) continue;
      const auto id = static_cast<std::uint32_t>(edges.size());
      edge_of_[3 * sides[i].facet + sides[i].side] = edge_of_[3 * sides[i + 1].facet + sides[i + 1].side] =
          id;
      Edge e{{sides[i].facet, sides[i + 1].facet},
             static_cast<std::uint32_t>(sides[i].ends >> 32U),
             static_cast<std::uint32_t>(sides[i].ends & 0xffffffffU)};
      e.turn_rad = turn_at(e);
      edges.push_back(e);
    }
  }

  /// A corner of walls, or the foot of one.
  [[nodiscard]] bool is_of_walls(const Edge& e) const {
    const double one = std::abs(normals_[e.facets[0]].z), other = std::abs(normals_[e.facets[1]].z);
    const double most = std::max(one, other);
    return solid_ && std::min(one, other) < kUprightNormal && (most < kUprightNormal || most > kLevelNormal);
  }

  [[nodiscard]] double across_mm(const Edge& e) const {
    const Vec3 a = mesh_.vertices[e.a], along = mesh_.vertices[e.b] - a;
    const double length = norm(along);
    const auto of = [&](std::uint32_t facet) { return norm(cross(apex(facet, e) - a, along)); };
    return length > 0.0 ? std::min(of(e.facets[0]), of(e.facets[1])) / length : 0.0;
  }

  /// Whether no crease about alike is beside it.
  [[nodiscard]] bool is_alone(std::uint32_t edge) const {
    const double turn = edges[edge].turn_rad;
    const auto alike_at = [&](std::uint32_t facet, std::uint32_t from, const auto& self, int more) -> bool {
      for (std::uint32_t k = 0; k < 3; ++k) {
        const std::uint32_t id = edge_of_[3 * facet + k];
        if (id == kNone || id == from) continue;
        const Edge& e = edges[id];
        if (e.turn_rad >= kAlike * turn) return true;
        if (more == 0 || std::abs(e.turn_rad) > kGoesOn * turn) continue;
        if (self(e.facets[0] == facet ? e.facets[1] : e.facets[0], id, self, more - 1)) return true;
      }
      return false;
    };
    return !alike_at(edges[edge].facets[0], edge, alike_at, 1) &&
           !alike_at(edges[edge].facets[1], edge, alike_at, 1);
  }

  std::vector<Edge> edges;

 private:
  /// Of length 1; 0 of a facet that is not seen, or has no area.
  [[nodiscard]] Vec3 seen_normal(const std::array<std::uint32_t, 3>& t, bool inside_out) const {
    const Vec3 a = mesh_.vertices[t[0]];
    Vec3 n = cross(mesh_.vertices[t[1]] - a, mesh_.vertices[t[2]] - a);
    const double size = norm(n);
    if (!(size > 0.0)) return {};
    n = (inside_out ? -1.0 : 1.0) / size * n;
    // Only of a solid is it known to which side an upright facet faces.
    const bool upright = std::abs(n.z) < (solid_ ? kUprightNormal : 1e-9);
    if (upright) return solid_ ? n : Vec3{};
    if (n.z < 0.0) return solid_ ? Vec3{} : -1.0 * n;
    return n;
  }

  [[nodiscard]] Vec3 apex(std::uint32_t facet, const Edge& e) const {
    for (const std::uint32_t v : mesh_.triangles[facet])
      if (v != e.a && v != e.b) return mesh_.vertices[v];
    return mesh_.vertices[e.a];
  }

  [[nodiscard]] double turn_at(const Edge& e) const {
    const Vec3 one = normals_[e.facets[0]], other = normals_[e.facets[1]];
    const double turn = std::acos(std::clamp(dot(one, other), -1.0, 1.0));
    return dot(one, apex(e.facets[1], e) - mesh_.vertices[e.a]) > 0.0 ? turn : -turn;
  }

  const Mesh& mesh_;
  bool solid_ = false;
  std::vector<Vec3> normals_;
  std::vector<std::uint32_t> edge_of_;  ///< by the sides of triangles
};

}  // namespace

double MeshCrease::curve_mm() const {
  if (alone || turn_rad >= kSharpTurnRad) return std::numeric_limits<double>::infinity();
  return across_mm / turn_rad;
}

std::vector<MeshCrease> creases(const Mesh& mesh) {
  double largest = 0.0;
  for (const Vec3& v : mesh.vertices)
    largest = std::max({largest, std::abs(v.x), std::abs(v.y), std::abs(v.z)});
  const Facets facets(mesh);
  std::vector<MeshCrease> out;
  for (std::uint32_t i = 0; i < facets.edges.size(); ++i) {
    const Edge& e = facets.edges[i];
    if (e.turn_rad < kFlatTurnRad || facets.is_of_walls(e)) continue;
    MeshCrease c{mesh.vertices[e.a], mesh.vertices[e.b], e.turn_rad, facets.across_mm(e), false};
    if (c.turn_rad * c.across_mm < kRounding * largest) continue;
    c.alone = facets.is_alone(i);
    out.push_back(c);
  }
  return out;
}

}  // namespace capstan::geometry
