// One move of a cutter over heights at the centres of cells. Only cells that stand higher than the cutter may
// come there are looked at closely; what it takes is then exact at their centres (outline.h).
#include <algorithm>
#include <cmath>

#include "planner/ground/base/stopping.h"
#include "planner/ground/vocabulary/unit_factors.h"
#include "planner/proof/verify/sweep/grid/grid.h"

namespace capstan::verify {

using geometry::Vec2;
using geometry::Vec3;

namespace {

/// No depth of cut is taken from what stands no farther than this inside the rim: twice the chord of curves
/// that a file gives as lines. Default, unsourced.
constexpr double kRimMm = 0.004;

/// A point nearer to the rim than this at the start of a move is met by the move, not by what was before.
constexpr double kMetMm = 1e-6;

/// Takes cells down, and that is all.
struct Plane {
  Grid& grid;
  static constexpr bool kMeasures = false;
  void at(int ix, int iy, double, double z, double) {
    const std::size_t i = grid.index(ix, iy);
    if (z < grid.stock[i]) grid.stock[i] = z <= grid.base[i] ? Grid::kNothing : z;
  }
};

/// Takes cells down and keeps the account. What only the outermost rim takes may be what the chords of a
/// file's curves left before: no depth of cut.
struct Knife {
  Grid& grid;
  double allowed;
  const GougeJudge* judge;
  Bite& bite;
  double core, rim;
  const CutterOutline& outline;
  double advance;
  double head = 0.0;
  int judged = 0;
  static constexpr bool kMeasures = true;

  /// The chip at a centre that stands `above` the tip and of which no more than `deep` is taken.
  /// `meets(rho)`: cosine between the way and the direction from the axis to the centre, both level, as a
  /// circle of that radius meets it; below 0: it does not, or the cutter stood over it before the move.
  template <class Meets>
  void chip(int ix, int iy, double above, double deep, const Meets& meets) {
    if (advance <= 0.0 || deep <= 0.0) return;
    const double rho = outline.profile().radius_at(above);
    if (rho <= 0.0) return;
    const double cosine = meets(rho);
    if (cosine < 0.0) return;
    // How upright the surface is there.
    constexpr double kStep = 1e-4;
    const double lean = above > kStep ? (rho - outline.profile().radius_at(above - kStep)) / kStep : 0.0;
    const double upright = advance / std::sqrt(1.0 + lean * lean);
    const double thick = std::min(upright * cosine, deep);
    if (thick > bite.chip_mm) {
      bite.chip_mm = thick;
      bite.chip_at = grid.centre(ix, iy);
    }
    const double aside = std::max(0.0, std::sqrt(1.0 - std::min(1.0, cosine * cosine)) - grid.cell() / rho);
    bite.chip_most_mm = std::max(bite.chip_most_mm, std::min(upright * std::sqrt(1.0 - aside * aside), deep));
  }

  void at(int ix, int iy, double tip_z, double z, double from_axis) {
    const std::size_t i = grid.index(ix, iy);
    double& s = grid.stock[i];
    if (z >= s || (head > 0.0 && s > tip_z + head)) return;
    const double floor = grid.base[i];
    if (s > Grid::kNothing / 2) {
      bite.volume_mm3 += (s - std::max(z, floor)) * grid.cell() * grid.cell();
      const double taken = grid.before_move(i, s) - std::max(z, floor);
      if (from_axis <= rim) {
        bite.contact_mm = std::max(bite.contact_mm, s - tip_z);
        bite.thickest_mm = std::max(bite.thickest_mm, taken);
      }
      if (from_axis <= core) bite.core_mm = std::max(bite.core_mm, taken);
      ++bite.cells;
      const double below = grid.part[i] - z;
      if (below > allowed && below > bite.gouge_mm) gouge(ix, iy, z, below);
    }
    s = z <= floor ? Grid::kNothing : z;
  }
  void gouge(int ix, int iy, double z, double below) {
    constexpr int kMostJudged = 500;  // per move; a true gouge is found by the first
    if (judge != nullptr && (++judged > kMostJudged || !judge->guilty(grid.centre(ix, iy), z))) return;
    bite.gouge_mm = below;
    bite.gouge_at = grid.centre(ix, iy);
  }
};

template <class Edge>
void cut_line(Edge& k, const CutterOutline& o, Vec3 a, Vec3 b) {
  const Vec2 d = xy(b) - xy(a);
  const double length = norm(d);
  const double r = o.radius();
  const double zmin = std::min(a.z, b.z);
  const bool level = std::abs(b.z - a.z) < 1e-9 || length < 1e-9;
  const auto [y0, y1] = k.grid.rows(std::min(a.y, b.y) - r, std::max(a.y, b.y) + r);
  k.grid.cut_rows(y0, y1);
  for (int iy = y0; iy < y1; ++iy) {
    tick();
    if (k.grid.row_top(iy) <= zmin) continue;
    const double y = k.grid.centre(0, iy).y;
    // Of the line only what lies within r of this row matters.
    double t0 = 0.0, t1 = 1.0;
    if (std::abs(d.y) > 1e-12) {
      t0 = (y - r - a.y) / d.y;
      t1 = (y + r - a.y) / d.y;
      if (t0 > t1) std::swap(t0, t1);
      t0 = std::clamp(t0, 0.0, 1.0);
      t1 = std::clamp(t1, 0.0, 1.0);
    }
    const double xa = a.x + t0 * d.x, xb = a.x + t1 * d.x;
    const auto [x0, x1] = k.grid.columns(std::min(xa, xb) - r, std::max(xa, xb) + r);
    for (int ix = x0; ix < x1; ++ix) {
      const double stands = k.grid.stock[k.grid.index(ix, iy)];
      if (stands <= zmin) continue;
      const Vec2 p = k.grid.centre(ix, iy);
      const double foot = length < 1e-9 ? 0.0 : dot(p - xy(a), d) / (length * length);
      const double t = std::clamp(foot, 0.0, 1.0);
      const Vec2 apart = p - (xy(a) + t * d);
      const double square = dot(apart, apart);
      if (square > r * r || stands <= zmin + o.at_least(square)) continue;
      const double near = std::sqrt(square);
      // No lower than the cutter would be at its nearest, at the lower end.
      const double bound = zmin + o.height(near);
      if (stands <= bound) continue;
      if constexpr (Edge::kMeasures) {
        if (length > 1e-9) {
          const double along = foot * length;
          const double off2 = std::max(0.0, dot(p - xy(a), p - xy(a)) - along * along);
          // Where the rim of the full radius meets the centre: the tip's height there.
          const double met = along - std::sqrt(std::max(0.0, r * r - off2));
          const double tip = a.z + std::clamp(met / length, 0.0, 1.0) * (b.z - a.z);
          const double under = std::max(bound, k.grid.base[k.grid.index(ix, iy)]);
          k.chip(ix, iy, stands - tip, stands - under, [&](double rho) {
            if (off2 >= rho * rho) return -1.0;
            const double ahead = std::sqrt(rho * rho - off2);
            const double begins = along - ahead;
            return begins < -kMetMm || begins > length ? -1.0 : ahead / rho;
          });
        }
      }
      if (level) {
        k.at(ix, iy, zmin, bound, near);
        continue;
      }
      const Vec2 aside = p - (xy(a) + foot * d);
      const double z = lowest_on_line(o, a.z, b.z - a.z, foot * length, std::sqrt(dot(aside, aside)), length);
      k.at(ix, iy, a.z + t * (b.z - a.z), z, near);
    }
  }
}

template <class Edge>
void cut_arc(Edge& k, const CutterOutline& o, const Move& m) {
  const double begins = norm(xy(m.from) - m.centre), ends = norm(xy(m.to) - m.centre);
  const double ra = 0.5 * (begins + ends), gap = std::abs(begins - ends);
  const double r = o.radius();
  const double sweep = sweep_of(m);
  const double start = std::atan2(m.from.y - m.centre.y, m.from.x - m.centre.x);
  const double sign = m.kind == model::MoveKind::kArcCcw ? 1.0 : -1.0;
  const bool level = std::abs(m.from.z - m.to.z) < 1e-9;
  const double rise = level ? 0.0 : m.to.z - m.from.z;
  const double zmin = level ? m.to.z : std::min(m.from.z, m.to.z);
  const double inner = std::max(0.0, ra - r), outer = ra + r;
  const geometry::Box3 box = box_of(m);
  const auto [y0, y1] = k.grid.rows(box.lo.y - gap - r, box.hi.y + gap + r);
  const auto [x0, x1] = k.grid.columns(box.lo.x - gap - r, box.hi.x + gap + r);
  k.grid.cut_rows(y0, y1);
  for (int iy = y0; iy < y1; ++iy) {
    tick();
    if (k.grid.row_top(iy) <= zmin) continue;
    for (int ix = x0; ix < x1; ++ix) {
      const std::size_t cell = k.grid.index(ix, iy);
      const double stands = k.grid.stock[cell];
      if (stands <= zmin) continue;
      const Vec2 p = k.grid.centre(ix, iy);
      const Vec2 q = p - m.centre;
      const double square = dot(q, q);
      if (square < inner * inner || square > outer * outer) continue;
      const double away = std::sqrt(square);
      const double radial = std::abs(away - ra);
      if (radial > r || stands <= zmin + o.at_least(radial * radial)) continue;
      double ahead = std::fmod(sign * (std::atan2(q.y, q.x) - start), kRadPerTurn);
      if (ahead < 0.0) ahead += kRadPerTurn;
      const double near = ahead <= sweep ? radial : std::min(norm(p - xy(m.from)), norm(p - xy(m.to)));
      if (near > r) continue;
      const double z =
          level ? zmin + o.height(near) : lowest_on_helix(o, m.from.z, rise, ra, sweep, away, ahead);
      if (stands <= z) continue;
      double tip = level ? zmin : m.from.z + rise * std::min(ahead, sweep) / sweep;
      if constexpr (Edge::kMeasures) {
        // How early before the point the axis is when a circle of that radius meets it, rad; below 0: never.
        // The triangle of the arc's centre, the axis and the point.
        const auto early = [&](double rho) {
          if (away < 1e-9 || ra < 1e-9) return -1.0;
          const double c = (away * away + ra * ra - rho * rho) / (2.0 * away * ra);
          return c >= 1.0 || c <= -1.0 ? -1.0 : std::acos(c);
        };
        const double apart = norm(p - xy(m.from));
        // How far along the way the edge is when a circle about the axis meets the point, rad.
        const auto met_at = [&](double before) {
          const double met = ahead - before;
          // The circle is over the point where the way begins, and comes round to it once more or leaves it.
          if (met < 0.0) return met + kRadPerTurn <= sweep ? met + kRadPerTurn : 0.0;
          return met <= sweep ? met : apart <= r ? 0.0 : sweep;
        };
        if (!level && apart <= r && stands > m.from.z + o.height(apart)) {
          tip = m.from.z;  // it is cut where the way begins
        } else if (!level) {
          // The tip's height where the edge that stands as high as the material first meets the point.
          for (double rho = r; const int again : {0, 1}) {
            const double before = early(rho);
            if (before >= 0.0) tip = m.from.z + rise * met_at(before) / sweep;
            if (again == 0) rho = o.profile().radius_at(stands - tip);
          }
        }
        k.chip(ix, iy, stands - tip, stands - std::max(z, k.grid.base[cell]), [&](double rho) {
          const double before = early(rho);
          if (before < 0.0) return -1.0;
          const double met = ahead - before;
          if (met < -kMetMm / ra || met > sweep) return -1.0;
          // Way and direction to the point at that time: away sin(before) / rho.
          return std::min(1.0, away * std::sin(before) / rho);
        });
      }
      k.at(ix, iy, tip, z, near);
    }
  }
}

}  // namespace

Bite cut(Grid& grid, const Move& m, const CutterOutline& o, double allowed_mm, const GougeJudge* judge,
         double advance_mm, double head_mm) {
  Bite bite;
  if (m.kind == model::MoveKind::kDwell) return bite;
  if (std::min(m.from.z, m.to.z) >= grid.top()) return bite;
  grid.begin_move();
  Knife k{grid, allowed_mm, judge, bite, o.middle(), o.radius() - kRimMm, o, advance_mm, head_mm};
  if (is_arc(m.kind)) {
    cut_arc(k, o, m);
  } else {
    cut_line(k, o, m.from, m.to);
  }
  return bite;
}

void lower(Grid& grid, const Move& m, const CutterOutline& o) {
  if (m.kind == model::MoveKind::kDwell || std::min(m.from.z, m.to.z) >= grid.top()) return;
  Plane k{grid};
  if (is_arc(m.kind)) {
    cut_arc(k, o, m);
  } else {
    cut_line(k, o, m.from, m.to);
  }
}

}  // namespace capstan::verify
