#include <algorithm>
#include <cmath>
#include <optional>

#include "planner/ground/base/stopping.h"
#include "planner/proof/verify/copies/copies.h"
#include "planner/proof/verify/sweep/target/mesh_distance.h"
#include "planner/proof/verify/sweep/target/target.h"
#include "planner/proof/verify/volumes/form/in_raw.h"

// What stays on a freeform surface after the last step. The distance is measured square to it: from the top
// of what stands to the nearest of the columns that the finished part fills, and of what is too far from
// those to the mesh itself, but where a feature was cut into the part: the mesh does not show that. It may be
// the tolerance, and what the finishing step states as the height of its ridges and of its chords. In the
// sharp inside corners of a mesh, which can state no radius, may stay what may stay in those of a step.

namespace capstan::verify {

using geometry::Vec2;
using geometry::Vec3;
using model::ShapeKind;

namespace {

/// Material that stands too high in one cell.
struct High {
  int ix = 0, iy = 0;
  double z = 0.0, by_mm = 0.0;  ///< its top, and its distance from the surface
};

}  // namespace

void Target::left_on_mesh(const Grid& grid, const Asked& a, Findings& out) const {
  constexpr double kRoundingMm = 1e-6;  // of heights that are found alike; default, unsourced
  const PartShapes::Entry* e = part_.find(a.feature);
  if (e == nullptr || e->shapes.empty() || e->shapes.front().kind != ShapeKind::kFreeform) return;
  geometry::Mesh in_setup = *plan_.target_mesh;
  for (geometry::Vec3& v : in_setup.vertices) v = frame_.to_parent(v);
  below_mesh(in_setup, a, out);
  const double limit = allowed() + a.bottom_mm + a.ridges_mm;
  const double slack = 0.71 * grid.cell();  // a column may stand anywhere in its cell
  // Inside corners of a solid's walls that no mill makes.
  const std::vector<geometry::MeshCorner> corners =
      sheet_ ? std::vector<geometry::MeshCorner>{} : geometry::sharp_corners(in_setup, inside_out_);
  const auto in_corner = [&](Vec2 p, double z) {
    return std::any_of(corners.begin(), corners.end(), [&](const geometry::MeshCorner& c) {
      const double may_stay = volumes::unstated_corner_mm(c.high - c.low);
      return z <= c.high + limit && c.keeps(p, may_stay, limit + slack);
    });
  };
  // How far columns are aside, by their steps along x and y: asked of each pair of columns, made once.
  const int most = std::max(grid.nx(), grid.ny());
  std::vector<double> asides;
  int known = 0, along_x = 0;
  const auto aside = [&](int dx, int dy) {
    if (const int far = std::max(dx, dy); far >= known) {
      known = std::min(most, 2 * far + 16);
      along_x = std::min(known, grid.nx());
      asides.clear();
      for (int y = 0; y < std::min(known, grid.ny()); ++y) {
        poll();
        for (int x = 0; x < along_x; ++x)
          asides.push_back(std::max(0.0, std::hypot(x, y) * grid.cell() - slack));
      }
    }
    return asides[static_cast<std::size_t>(dy) * static_cast<std::size_t>(along_x) +
                  static_cast<std::size_t>(dx)];
  };
  std::optional<MeshDistance> exact;
  std::vector<double> before;
  // Whether a feature is cut into the mesh at a cell.
  const auto carved = [&](int ix, int iy) {
    if (cavities_.empty()) return false;
    if (before.empty()) before = before_features(grid);
    const std::size_t i = grid.index(ix, iy);
    return grid.part[i] < before[i] - kRoundingMm;
  };
  // The distance from the mesh itself, where no feature is cut into it at both ends.
  const auto from_mesh = [&](int ix, int iy, Vec3 p, double within) {
    if (carved(ix, iy)) return within;
    if (!exact) exact.emplace(in_setup);
    const MeshDistance::Nearest n = exact->from(p, within);
    const double half = 0.5 * grid.cell();
    const auto [x0, x1] = grid.columns(n.at.x - half, n.at.x + half);
    const auto [y0, y1] = grid.rows(n.at.y - half, n.at.y + half);
    for (int jy = y0; jy < y1; ++jy) {
      for (int jx = x0; jx < x1; ++jx)
        if (carved(jx, jy)) return within;
    }
    return n.mm;
  };
  High worst;
  std::size_t cells = 0, all = 0;
  for (int iy = 0; iy < grid.ny(); ++iy) {
    poll();
    for (int ix = 0; ix < grid.nx(); ++ix) {
      const std::size_t i = grid.index(ix, iy);
      const double z = grid.stock[i];
      if (z <= Grid::kNothing / 2) continue;
      ++all;
      // What has no column under it must go down to the underside.
      const double own = std::max(grid.part[i], grid.base[i]);
      double near = z - own;
      if (near <= limit) continue;
      // Rings of columns around, until they are farther away than the nearest found.
      for (int n = 1; n < most && near > limit; ++n) {
        if ((n * grid.cell()) - slack >= near) break;
        for (int dy = -n; dy <= n; ++dy) {
          const int stride = std::abs(dy) == n ? 1 : 2 * n;
          for (int dx = -n; dx <= n; dx += stride) {
            const int jx = ix + dx, jy = iy + dy;
            if (jx < 0 || jy < 0 || jx >= grid.nx() || jy >= grid.ny()) continue;
            const double column = grid.part[grid.index(jx, jy)];
            if (column <= Grid::kNothing / 2) continue;
            const double beside = aside(std::abs(dx), std::abs(dy)), above = std::max(0.0, z - column);
            if (beside * beside + above * above < near * near) near = std::hypot(beside, above);
          }
        }
      }
      if (near <= limit) continue;
      const Vec2 at = grid.centre(ix, iy);
      near = from_mesh(ix, iy, {at.x, at.y, z}, near);
      if (near <= limit || in_corner(at, z)) continue;
      ++cells;
      if (near > worst.by_mm) worst = {ix, iy, z, near};
    }
  }
  if (worst.by_mm <= 0.0) return;
  out.error(36, "CHK-LEFT", a.where,
            "after the last step " + mm(worst.by_mm) + ", square to the surface, still stand at " +
                place(grid.centre(worst.ix, worst.iy), worst.z) + ", and more than is allowed on " +
                plain(100.0 * static_cast<double>(cells) / static_cast<double>(all)) +
                " % of what lies there; allowed " + mm(limit) + " (cells of " + mm(grid.cell()) +
                "); no cutter of the plan reached it",
            worst.by_mm);
}

}  // namespace capstan::verify
