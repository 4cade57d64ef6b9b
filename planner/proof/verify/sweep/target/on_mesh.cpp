#include <algorithm>
#include <cmath>
#include <optional>

#include "planner/ground/base/number.h"
#include "planner/ground/base/stopping.h"
#include "planner/proof/verify/copies/copies.h"
#include "planner/proof/verify/sweep/target/corners.h"
#include "planner/proof/verify/sweep/target/mesh_distance.h"
#include "planner/proof/verify/sweep/target/target.h"
#include "planner/proof/verify/volumes/form/in_raw.h"

// What stays on a freeform surface after the last step. The distance is measured square to it: from the top
// of what stands to the nearest of the columns that the finished part fills, and of what is too far from
// those to the mesh itself. It may be the tolerance, and what the finishing step states as the height of its
// ridges and of its chords. In the sharp inside corners of a mesh, which can state no radius, may stay what
// may stay in those of a step.
//
// Where the plan records that a radius stays (CornerRest), more may stay where no ball of that radius touches
// the surface, and nowhere else. Whether one does is asked of the mesh: a ball on the normal of the nearest
// place of the surface touches there if the mesh comes nowhere else into it. In a crease of angle d a ball
// that enters by e leaves e / cos(d / 2): twice that, up to 120 degrees, is taken for what it may leave. What
// stays is put together to zones of neighbouring cells, each reported with its place, its height and the ball
// that would touch there (CHK-REST).

namespace capstan::verify {

using geometry::Vec2;
using geometry::Vec3;
using model::ShapeKind;

namespace {

constexpr double kMostPerEntered = 2.0;  ///< see above
constexpr double kLeastBallMm = 0.25;    ///< radius: no smaller one is looked for; default, unsourced
constexpr std::size_t kMostZones = 6;    ///< that are told one by one; default, unsourced

std::string place(Vec2 p, double z) { return "(" + plain(p.x) + ", " + plain(p.y) + ", " + plain(z) + ")"; }

/// Material that stands too high in one cell.
struct High {
  int ix = 0, iy = 0;
  double z = 0.0, by_mm = 0.0;  ///< its top, and its distance from the surface
  Vec3 nearest;                 ///< on the surface
};

/// How deep a ball that touches the surface below a place enters it elsewhere.
double enters(const MeshDistance& mesh, const High& h, Vec2 centre, double radius_mm) {
  const Vec3 out = Vec3{centre.x, centre.y, h.z} - h.nearest;
  const double length = norm(out);
  if (!(length > 0.0)) return 0.0;
  const Vec3 middle = h.nearest + (radius_mm / length) * out;
  return radius_mm - mesh.from(middle, radius_mm).mm;
}

struct Zone {
  std::size_t cells = 0;
  double volume_mm3 = 0.0;
  High worst;
};

/// Neighbouring cells together, those with most material first.
std::vector<Zone> zones_of(const std::vector<High>& cells, const Grid& grid) {
  std::vector<int> of(static_cast<std::size_t>(grid.nx()) * static_cast<std::size_t>(grid.ny()), -1);
  for (std::size_t i = 0; i < cells.size(); ++i)
    of[grid.index(cells[i].ix, cells[i].iy)] = static_cast<int>(i);
  std::vector<bool> done(cells.size());
  std::vector<Zone> out;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    if (done[i]) continue;
    Zone z;
    std::vector<std::size_t> todo{i};
    done[i] = true;
    while (!todo.empty()) {
      const High& h = cells[todo.back()];
      todo.pop_back();
      ++z.cells;
      const std::size_t at = grid.index(h.ix, h.iy);
      z.volume_mm3 += (h.z - std::max(grid.part[at], grid.base[at])) * grid.cell() * grid.cell();
      if (h.by_mm > z.worst.by_mm) z.worst = h;
      for (int dy = -1; dy <= 1; ++dy) {
        for (int dx = -1; dx <= 1; ++dx) {
          const int x = h.ix + dx, y = h.iy + dy;
          if (x < 0 || y < 0 || x >= grid.nx() || y >= grid.ny()) continue;
          const int k = of[grid.index(x, y)];
          if (k < 0 || done[static_cast<std::size_t>(k)]) continue;
          done[static_cast<std::size_t>(k)] = true;
          todo.push_back(static_cast<std::size_t>(k));
        }
      }
    }
    out.push_back(z);
  }
  std::stable_sort(out.begin(), out.end(),
                   [](const Zone& a, const Zone& b) { return a.volume_mm3 > b.volume_mm3; });
  return out;
}

/// The widest ball that touches the surface there, as wide as `widest_mm` at most; 0: none from kLeastBallMm.
double touching_radius(const MeshDistance& mesh, const High& h, Vec2 centre, double widest_mm,
                       double within_mm) {
  const auto touches = [&](double r) { return enters(mesh, h, centre, r) <= within_mm; };
  double lo = kLeastBallMm, hi = widest_mm;
  if (!touches(lo)) return 0.0;
  for (int i = 0; i < 12; ++i) {
    const double r = 0.5 * (lo + hi);
    (touches(r) ? lo : hi) = r;
  }
  return lo;
}

}  // namespace

void Target::left_on_mesh(const Grid& grid, const Asked& a, Findings& out) const {
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
  const auto recorded = recorded_rest(plan_, part_, e->shapes.front(), a);
  std::optional<MeshDistance> exact;
  std::vector<High> stays;  // where no ball of the recorded radius touches
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
      if (!exact) exact.emplace(in_setup);
      const MeshDistance::Nearest nearest = exact->from({at.x, at.y, z}, near);
      near = nearest.mm;
      if (near <= limit || in_corner(at, z)) continue;
      const High high{ix, iy, z, near, nearest.at};
      if (recorded && near - limit <= kMostPerEntered * enters(*exact, high, at, recorded->radius_mm)) {
        stays.push_back(high);
        continue;
      }
      ++cells;
      if (near > worst.by_mm) worst = high;
    }
  }
  if (!stays.empty()) {
    const std::vector<Zone> zones = zones_of(stays, grid);
    double volume = 0.0;
    for (const Zone& zone : zones) volume += zone.volume_mm3;
    std::string text;
    for (std::size_t i = 0; i < std::min(kMostZones, zones.size()); ++i) {
      const High& h = zones[i].worst;
      const Vec2 at = grid.centre(h.ix, h.iy);
      const double r = touching_radius(*exact, h, at, recorded->radius_mm, limit);
      text +=
          (i == 0 ? ": " : "; ") + mm(h.by_mm) + " at " + place(at, h.z) + ", " + plain(zones[i].volume_mm3) +
          " mm3, " +
          (r > 0.0 ? "which a ball of " + plain(2.0 * r) + " mm would take" : "a corner that no ball makes");
    }
    if (zones.size() > kMostZones) text += "; and smaller ones";
    out.warn(36, "CHK-REST", a.where,
             "on " + e->shapes.front().name + " rest material stays in " +
                 counted(zones.size(), "zone", "zones") + " that no ball of radius " +
                 mm(recorded->radius_mm) + " reaches, as the plan records it, " + plain(volume) + " mm3 on " +
                 plain(100.0 * static_cast<double>(stays.size()) / static_cast<double>(all)) +
                 " % of what lies there" + text,
             recorded->radius_mm);
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
