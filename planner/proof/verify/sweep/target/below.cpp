#include <algorithm>
#include <vector>

#include "planner/proof/verify/sweep/target/target.h"

// What no cutter reaches from above: heights hold the highest surface over each place, so that a surface of
// the part that faces down, an undercut or the ceiling of a void, is not among them. Its triangles are
// added up, those of the part's underside left out. Below that, what of the raw piece is lower stays, too.

namespace capstan::verify {

using geometry::Vec3;

void Target::below_mesh(const geometry::Mesh& mesh, const Asked& a, Findings& out) const {
  constexpr double kLevel = 0.02;        // of a unit normal: as good as upright; default, unsourced
  constexpr double kUndersideMm = 0.01;  // default, unsourced
  constexpr double kLeastMm2 = 0.1;      // less is dirt of the mesh; default, unsourced
  if (sheet_ || mesh.triangles.empty()) return;
  const std::vector<Vec3>& at = mesh.vertices;
  const geometry::Box3 box = geometry::bounds(mesh);
  double area = 0.0, widest = 0.0;
  Vec3 where;
  for (const auto& t : mesh.triangles) {
    const Vec3 &a0 = at[t[0]], &a1 = at[t[1]], &a2 = at[t[2]];
    const Vec3 n = (inside_out_ ? -1.0 : 1.0) * cross(a1 - a0, a2 - a0);
    const double size = norm(n);
    if (!(size > 0.0) || n.z > -kLevel * size) continue;
    if (std::max({a0.z, a1.z, a2.z}) < box.lo.z + kUndersideMm) continue;
    area += 0.5 * -n.z;  // seen from below
    if (size <= widest) continue;
    widest = size;
    where = (1.0 / 3.0) * (a0 + a1 + a2);
  }
  if (stock_.lo.z < box.lo.z - kUndersideMm) {
    out.warn(
        36, "CHK-LEFT-UNDER", a.where,
        "under the part, from z " + plain(stock_.lo.z) + " to " + plain(box.lo.z) + ", " +
            mm(box.lo.z - stock_.lo.z) +
            " of the raw piece stay: nothing cuts there from above; face the underside in another set-up, "
            "or give a raw piece that ends there",
        box.lo.z - stock_.lo.z);
  }
  if (area < kLeastMm2) return;
  out.warn(36, "CHK-LEFT-BELOW", a.where,
           "under " + plain(area) + " mm2 of the part that face down, the largest triangle at (" +
               plain(where.x) + ", " + plain(where.y) + ", " + plain(where.z) +
               "), the material stays: no cutter reaches there from above; plan another set-up for it",
           area);
}

}  // namespace capstan::verify
