#include "planner/making/piece/mesh/surface_form.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <map>
#include <numbers>
#include <utility>

#include "planner/ground/geometry/mesh/mesh_form.h"

namespace capstan::piece {
SurfaceForm surface_form(const geometry::Mesh& mesh, const geometry::Box3& raw) {
  using geometry::Vec3;
  constexpr double kSameMm = 0.02;  // of coordinates; default, unsourced
  SurfaceForm out;
  const geometry::MeshForm form = geometry::form_of(mesh);
  if (form.kind != geometry::MeshForm::Kind::kSolid) return out;
  out.inside_out = form.inside_out;
  const auto on_side = [&](const std::array<Vec3, 3>& t) {
    const auto all = [&](auto coordinate, double at) {
      return std::all_of(t.begin(), t.end(), [&](Vec3 v) { return std::abs(coordinate(v) - at) < kSameMm; });
    };
    const auto x = [](Vec3 v) { return v.x; };
    const auto y = [](Vec3 v) { return v.y; };
    return all(x, raw.lo.x) || all(x, raw.hi.x) || all(y, raw.lo.y) || all(y, raw.hi.y);
  };
  struct Side {
    Vec3 normal, apex;
  };
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<Side>> edges;  // of upright facets
  constexpr double kSameFloorMm = 1e-3;
  constexpr double kLeastFloorMm2 = 3.0;               // the disc of a mill of 2 mm; default, unsourced
  constexpr std::size_t kMostFloors = 64;              // default, unsourced
  std::map<double, std::pair<double, double>> floors;  // area and height, by the cell of kSameFloorMm
  for (const auto& t : mesh.triangles) {
    const std::array<Vec3, 3> p{mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]};
    Vec3 n = cross(p[1] - p[0], p[2] - p[0]);
    if (!(norm(n) > 0.0)) continue;
    n = (form.inside_out ? -1.0 : 1.0) / norm(n) * n;
    if (std::abs(n.z) < geometry::kUprightNormal) {
      if (on_side(p)) continue;
      out.walls = true;
      const double foot = std::min({p[0].z, p[1].z, p[2].z});
      out.foot_mm = std::max(out.foot_mm.value_or(foot), foot);
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t a = t[k], b = t[(k + 1) % 3];
        edges[{std::min(a, b), std::max(a, b)}].push_back({n, p[(k + 2) % 3]});
      }
    } else if (n.z > geometry::kLevelNormal) {
      auto& [area, height] =
          floors.emplace(std::round(p[0].z / kSameFloorMm), std::pair(0.0, p[0].z)).first->second;
      area += 0.5 * norm(cross(p[1] - p[0], p[2] - p[0]));
      height = std::max(height, p[0].z);
    } else if (n.z > 0.0) {
      out.curved = true;
    }
  }
  // A floor is worth levels of its own where an end mill has room on it; the largest ones, so that a relief
  // of many heights is not cut level by level: a ball makes the others.
  std::vector<std::pair<double, double>> by_area;
  for (const auto& [cell, floor] : floors) by_area.push_back(floor);
  std::sort(by_area.begin(), by_area.end(), std::greater<>());
  for (const auto& [area, height] : by_area) {
    if (area >= kLeastFloorMm2 && out.floors_mm.size() < kMostFloors)
      out.floors_mm.push_back(height);
    else
      out.curved = true;
  }
  std::sort(out.floors_mm.begin(), out.floors_mm.end(), std::greater<>());
  if (out.walls) out.sharp = geometry::sharp_corners(mesh, form.inside_out);
  for (const auto& [e, sides] : edges) {
    if (sides.size() != 2) continue;
    const Vec3 a = mesh.vertices[e.first];
    const Vec3 along = mesh.vertices[e.second] - a;
    if (!(norm(along) > 0.0) || dot(sides[0].normal, sides[1].apex - a) <= 0.0) continue;  // not concave
    const double angle = std::acos(std::clamp(dot(sides[0].normal, sides[1].normal), -1.0, 1.0));
    if (angle < geometry::kFlatTurnRad || angle > geometry::kSharpTurnRad) continue;
    const double width =
        std::min(norm(cross(sides[0].apex - a, along)), norm(cross(sides[1].apex - a, along))) / norm(along);
    out.corner_mm = out.corner_mm > 0.0 ? std::min(out.corner_mm, width / angle) : width / angle;
  }
  return out;
}

}  // namespace capstan::piece
