#include <algorithm>
#include <cmath>
#include <optional>

#include "planner/ground/base/stopping.h"
#include "planner/ground/geometry/mesh/mesh_creases.h"
#include "planner/proof/verify/copies/copies.h"
#include "planner/proof/verify/sweep/target/corners.h"
#include "planner/proof/verify/sweep/target/mesh_distance.h"
#include "planner/proof/verify/sweep/target/resting_ball.h"
#include "planner/proof/verify/sweep/target/target.h"
#include "planner/proof/verify/volumes/form/in_raw.h"

// What stays on a freeform surface after the last step. The distance is measured square to it: from the top
// of what stands to the nearest of the columns that the finished part fills, and of what is too far from
// those to the mesh itself, but where a feature was cut into the part: the mesh does not show that. It may be
// the tolerance, and what the finishing step states as the height of its ridges and of its chords. In the
// sharp inside corners of a mesh, which can state no radius, may stay what may stay in those of a step; near
// its creases that state none, what no ball of that radius reaches that rests on the part (resting_ball.h);
// where the plan records a wider radius, what none of that radius does, but in corners of upright walls.

namespace capstan::verify {

using geometry::Vec2;
using geometry::Vec3;
using model::ShapeKind;

namespace {

/// Where creases state no radius, and the one that may stay there: that of the ball that finishes all of the
/// surface, which its other creases make narrower.
struct Creases {
  double radius_mm = 0.0;  ///< 0: there are none
  std::vector<char> near;  ///< by cells
};

Creases creases_of(const geometry::Mesh& mesh, const Grid& grid, double slack) {
  constexpr double kMostRadii = 3.0;    // how far from a narrow crease a ball touches; default, unsourced
  constexpr double kLeastBallMm = 1.0;  // radius: curves of less are made by that; default, unsourced
  Creases out;
  const double top = geometry::bounds(mesh).hi.z;
  const std::vector<geometry::MeshCrease> all = geometry::creases(mesh);
  double least = 1e300;
  bool any = false;
  const auto unstated = [&](const geometry::MeshCrease& c) {
    return volumes::unstated_corner_mm(top - std::min(c.a.z, c.b.z));
  };
  const auto states_none = [&](const geometry::MeshCrease& c) { return c.curve_mm() >= unstated(c); };
  for (const geometry::MeshCrease& c : all) {
    least = std::min(least, states_none(c) ? unstated(c) : std::max(kLeastBallMm, c.curve_mm()));
    any = any || states_none(c);
  }
  if (!any) return out;
  out.radius_mm = least;
  out.near.assign(grid.stock.size(), 0);
  for (const geometry::MeshCrease& c : all) {
    if (!states_none(c)) continue;
    const double far = least * std::min(kMostRadii, std::tan(0.5 * c.turn_rad)) + slack;
    const Vec2 a = xy(c.a), along = xy(c.b) - a;
    const double length2 = dot(along, along);
    const auto [y0, y1] = grid.rows(std::min(c.a.y, c.b.y) - far, std::max(c.a.y, c.b.y) + far);
    for (int iy = y0; iy < y1; ++iy) {
      poll();
      // Of the crease what is no farther from the row than that, and as much beside it.
      const double y = grid.centre(0, iy).y - a.y;
      double from = 0.0, to = 1.0;
      if (std::abs(along.y) > 1e-9) {
        const double t0 = (y - far) / along.y, t1 = (y + far) / along.y;
        from = std::clamp(std::min(t0, t1), 0.0, 1.0);
        to = std::clamp(std::max(t0, t1), 0.0, 1.0);
      }
      const double xa = a.x + from * along.x, xb = a.x + to * along.x;
      const auto [x0, x1] = grid.columns(std::min(xa, xb) - far, std::max(xa, xb) + far);
      for (int ix = x0; ix < x1; ++ix) {
        const Vec2 p = grid.centre(ix, iy) - a;
        const double t = length2 > 0.0 ? std::clamp(dot(p, along) / length2, 0.0, 1.0) : 0.0;
        if (norm(p - t * along) <= far) out.near[grid.index(ix, iy)] = 1;
      }
    }
  }
  return out;
}

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
  struct Stays {
    double most_mm = 0.0, mm3 = 0.0;
    std::optional<RestingBalls> balls;
  } in_creases, as_recorded;
  const auto recorded = recorded_rest(plan_, part_, e->shapes.front(), a);
  std::optional<Creases> creases;  // made for the first place
  const auto no_ball_reaches = [&](Vec3 p, double near, double radius, Stays& stays) {
    if (!(radius > 0.0) || near >= radius) return false;
    if (!stays.balls) stays.balls.emplace(grid, radius);
    if (stays.balls->reaches(p, radius - limit)) return false;
    stays.most_mm = std::max(stays.most_mm, near);
    stays.mm3 += near * grid.cell() * grid.cell();
    return true;
  };
  const auto may_stay = [&](std::size_t i, Vec3 p, double near) {
    if (!creases) creases = creases_of(in_setup, grid, limit + slack);
    if (!creases->near.empty() && creases->near[i] != 0 &&
        no_ball_reaches(p, near, creases->radius_mm, in_creases))
      return true;
    const auto in_wider_corner = [&](const geometry::MeshCorner& c) {
      return c.keeps(xy(p), recorded->radius_mm, limit + slack);
    };
    return recorded && std::none_of(corners.begin(), corners.end(), in_wider_corner) &&
           no_ball_reaches(p, near, recorded->radius_mm, as_recorded);
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
      if (near <= limit || in_corner(at, z) || may_stay(i, {at.x, at.y, z}, near)) continue;
      ++cells;
      if (near > worst.by_mm) worst = {ix, iy, z, near};
    }
  }
  const auto words = [&](const Stays& s) {
    return "up to " + mm(s.most_mm) + " stay, square to the surface, about " + plain(s.mm3) + " mm3 in all: ";
  };
  if (in_creases.most_mm > 0.0)
    out.note(36, "CHK-REST", a.where,
             "in creases that state no radius " + words(in_creases) +
                 "no ball of the radius that may stay in unstated corners reaches it");
  if (as_recorded.most_mm > 0.0)
    out.warn(36, "CHK-REST", a.where,
             "in narrow places " + words(as_recorded) + "a radius of " + mm(recorded->radius_mm) +
                 " stays in place of " + mm(recorded->stated_mm) + ", as the plan records it",
             as_recorded.most_mm);
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
