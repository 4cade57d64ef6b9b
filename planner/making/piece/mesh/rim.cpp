#include "planner/making/piece/mesh/rim.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <utility>

#include "planner/ground/geometry/mesh/mesh_form.h"

// A torus of radius R and corner r that rests on a facet of unit normal n touches it at r n below the circle
// of radius R - r about its axis: its axis stands (R - r) + r |n_xy| beside the point of contact, on the side
// to which the facet falls. Let down with its axis over the rim, it touches so far within, and leaves (R - r)
// tan a + r (1 / cos a - 1) at the rim of a slope of angle a. Source  derived. The rim is where a facet that
// is seen from above ends: at an upright one, at one that looks down, or at nothing.

namespace capstan::piece {
namespace {

using geometry::Vec2;
using geometry::Vec3;

constexpr double kLevel =
    1e-3;  ///< the horizontal part of a unit normal: less is the rounding of coordinates

struct Facet {
  Vec3 normal;  ///< of length 1, upwards
  Vec2 apex;    ///< opposite the edge
};

}  // namespace

geometry::Box2 box_of_axis(const geometry::Mesh& mesh, double radius_mm, double corner_mm, double left_mm) {
  const geometry::Box3 all = geometry::bounds(mesh);
  geometry::Box2 out{xy(all.lo), xy(all.hi)};
  const geometry::MeshForm form = geometry::form_of(mesh);
  const bool solid = form.kind == geometry::MeshForm::Kind::kSolid;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<Facet>> edges;
  for (const auto& t : mesh.triangles) {
    const Vec3 a = mesh.vertices[t[0]];
    Vec3 n = cross(mesh.vertices[t[1]] - a, mesh.vertices[t[2]] - a);
    if (!(norm(n) > 0.0)) continue;
    n = (form.inside_out ? -1.0 : 1.0) / norm(n) * n;
    if (!solid && n.z < 0.0) n = -1.0 * n;  // a sheet may be drawn either way up
    if (n.z < geometry::kUprightNormal) continue;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t p = t[k], q = t[(k + 1) % 3];
      edges[{std::min(p, q), std::max(p, q)}].push_back({n, xy(mesh.vertices[t[(k + 2) % 3]])});
    }
  }
  for (const auto& [ends, facets] : edges) {
    if (facets.size() != 1) continue;
    const Facet& f = facets.front();
    const Vec2 a = xy(mesh.vertices[ends.first]), b = xy(mesh.vertices[ends.second]);
    const Vec2 slope = xy(f.normal);
    const double steep = norm(slope);
    const Vec2 along = b - a;
    // Outwards is the side of the edge on which its facet's third corner is not.
    const double side = along.x * (f.apex.y - a.y) - along.y * (f.apex.x - a.x);
    const double falls = along.x * slope.y - along.y * slope.x;
    if (steep < kLevel || falls * side >= 0.0) continue;
    const double upright = f.normal.z;
    if ((radius_mm - corner_mm) * steep / upright + corner_mm * (1.0 / upright - 1.0) <= left_mm) continue;
    const Vec2 beside = ((radius_mm - corner_mm + corner_mm * steep) / steep) * slope;
    for (const Vec2 at : {a + beside, b + beside}) {
      out.lo = {std::min(out.lo.x, at.x), std::min(out.lo.y, at.y)};
      out.hi = {std::max(out.hi.x, at.x), std::max(out.hi.y, at.y)};
    }
  }
  return out;
}

}  // namespace capstan::piece
