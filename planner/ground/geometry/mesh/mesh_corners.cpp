#include "planner/ground/geometry/mesh/mesh_corners.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

#include "planner/ground/geometry/mesh/mesh_form.h"

// A mill of radius r along two walls that meet at an angle of 2 a leaves what lies between the corner and the
// circle of radius r that touches both: its centre is r / sin a from the corner, the walls are touched at
// r / tan a.

namespace capstan::geometry {
namespace {

Vec3 normal_of(const Mesh& m, const std::array<std::uint32_t, 3>& t, bool inside_out) {
  const Vec3 n = cross(m.vertices[t[1]] - m.vertices[t[0]], m.vertices[t[2]] - m.vertices[t[0]]);
  const double size = norm(n);
  return size > 0.0 ? (inside_out ? -1.0 : 1.0) / size * n : Vec3{};
}

}  // namespace

bool MeshCorner::keeps(Vec2 p, double radius_mm, double more) const {
  const Vec2 d = p - at;
  const double along = dot(d, into), aside = std::abs(cross(into, d));
  // Between the walls, from which it may be `more` away.
  if (aside * std::cos(half_rad) - along * std::sin(half_rad) > more) return false;
  const double reach = radius_mm / std::max(std::tan(half_rad), 1e-3);
  if (along * std::cos(half_rad) + aside * std::sin(half_rad) > reach + more) return false;
  const Vec2 centre = (radius_mm / std::max(std::sin(half_rad), 1e-3)) * into;
  return norm(d - centre) >= radius_mm - more;
}

std::vector<MeshCorner> sharp_corners(const Mesh& mesh, bool inside_out) {
  struct Side {
    Vec3 normal, apex;
  };
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<Side>> edges;  // of upright triangles
  for (const auto& t : mesh.triangles) {
    const Vec3 n = normal_of(mesh, t, inside_out);
    if (!(norm(n) > 0.0) || std::abs(n.z) > kUprightNormal) continue;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = t[k], b = t[(k + 1) % 3];
      edges[{std::min(a, b), std::max(a, b)}].push_back({n, mesh.vertices[t[(k + 2) % 3]]});
    }
  }
  std::vector<MeshCorner> out;
  for (const auto& [e, sides] : edges) {
    if (sides.size() != 2) continue;
    const Vec3 a = mesh.vertices[e.first], b = mesh.vertices[e.second];
    if (norm(xy(b) - xy(a)) > kWeldMm || dot(sides[0].normal, sides[1].apex - a) <= 0.0) continue;
    const double turn = std::acos(std::clamp(dot(sides[0].normal, sides[1].normal), -1.0, 1.0));
    const Vec2 sum = xy(sides[0].normal) + xy(sides[1].normal);
    if (turn < kSharpTurnRad || !(norm(sum) > 0.0)) continue;
    MeshCorner c{xy(a), (1.0 / norm(sum)) * sum, 0.5 * (std::numbers::pi - turn), std::min(a.z, b.z),
                 std::max(a.z, b.z)};
    const auto same = std::find_if(out.begin(), out.end(), [&](const MeshCorner& o) {
      return norm(o.at - c.at) <= kWeldMm && norm(o.into - c.into) <= kWeldMm;
    });
    if (same == out.end()) {
      out.push_back(c);
      continue;
    }
    same->low = std::min(same->low, c.low);
    same->high = std::max(same->high, c.high);
  }
  return out;
}

Region higher_than(const Mesh& mesh, bool inside_out, double z) {
  // Triangles that face up lie side by side, seen from above: what they cover is bounded by the edges that
  // one of them has alone.
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> directed;
  for (const auto& t : mesh.triangles) {
    const Vec3 n = normal_of(mesh, t, inside_out);
    if (n.z <= kUprightNormal) continue;
    double top = -1e300;
    for (const std::uint32_t v : t) top = std::max(top, mesh.vertices[v].z);
    if (top <= z) continue;
    for (std::size_t k = 0; k < 3; ++k) {
      std::uint32_t a = t[k], b = t[(k + 1) % 3];
      if (inside_out) std::swap(a, b);
      const auto back = directed.find({b, a});
      if (back != directed.end()) {
        if (--back->second == 0) directed.erase(back);
      } else {
        ++directed[{a, b}];
      }
    }
  }
  std::vector<Loop> loops;
  while (!directed.empty()) {
    Loop loop;
    const std::uint32_t first = directed.begin()->first.first;
    for (std::uint32_t at = first;;) {
      const auto next = directed.lower_bound({at, 0});
      if (next == directed.end() || next->first.first != at) break;
      loop.push_back(xy(mesh.vertices[at]));
      at = next->first.second;
      if (--next->second == 0) directed.erase(next);
      if (at == first) break;
    }
    if (loop.size() > 2) loops.push_back(std::move(loop));
  }
  return clean(loops);
}

}  // namespace capstan::geometry
