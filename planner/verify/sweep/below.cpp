#include <algorithm>
#include <cmath>

#include "planner/verify/sweep/target.h"

// What no cutter reaches from above: heights hold the highest surface over each place, so that a surface of
// the part that faces down, an undercut or the ceiling of a void, is not among them. Its triangles are
// added up, those of the part's underside left out.

namespace capstan::verify {

using geometry::Vec3;

void Target::below_mesh(const Asked& a, Findings& out) const {
  constexpr double kLevel = 0.02;        // of a unit normal: as good as upright; default, unsourced
  constexpr double kUndersideMm = 0.01;  // default, unsourced
  constexpr double kLeastMm2 = 0.1;      // less is dirt of the mesh; default, unsourced
  const geometry::Mesh& mesh = *plan_.target_mesh;
  if (sheet_ || mesh.triangles.empty()) return;
  double volume = 0.0, low = 1e300;
  for (const auto& t : mesh.triangles) {
    const Vec3 p[] = {frame_.to_parent(mesh.vertices[t[0]]), frame_.to_parent(mesh.vertices[t[1]]),
                      frame_.to_parent(mesh.vertices[t[2]])};
    volume += dot(p[0], cross(p[1], p[2]));
    for (const Vec3& v : p) low = std::min(low, v.z);
  }
  const double outwards = volume < 0.0 ? -1.0 : 1.0;
  double area = 0.0, widest = 0.0;
  Vec3 where;
  for (const auto& t : mesh.triangles) {
    const Vec3 p[] = {frame_.to_parent(mesh.vertices[t[0]]), frame_.to_parent(mesh.vertices[t[1]]),
                      frame_.to_parent(mesh.vertices[t[2]])};
    const Vec3 n = outwards * cross(p[1] - p[0], p[2] - p[0]);
    const double size = norm(n);
    if (!(size > 0.0) || n.z > -kLevel * size) continue;
    if (std::max({p[0].z, p[1].z, p[2].z}) < low + kUndersideMm) continue;
    area += 0.5 * -n.z;  // seen from below
    if (size <= widest) continue;
    widest = size;
    where = (1.0 / 3.0) * (p[0] + p[1] + p[2]);
  }
  if (area < kLeastMm2) return;
  out.warn(36, "CHK-LEFT-BELOW", a.where,
           "under " + plain(area) + " mm2 of the part that face down, the largest triangle at (" +
               plain(where.x) + ", " + plain(where.y) + ", " + plain(where.z) +
               "), the material stays: no cutter reaches there from above; plan another set-up for it",
           area);
}

}  // namespace capstan::verify
