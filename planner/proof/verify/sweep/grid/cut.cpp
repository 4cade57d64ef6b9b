// One move of a cutter over heights at the centres of cells. Only cells that stand higher than the cutter may
// come there are looked at closely; what it takes is then exact at their centres (outline.h).
#include <algorithm>
#include <cmath>

#include "planner/ground/base/stopping.h"
#include "planner/proof/verify/sweep/grid/grid.h"
#include "planner/proof/verify/sweep/grid/way.h"

namespace capstan::verify {

using geometry::Vec2;

namespace {

/// No depth of cut is taken from what stands no farther than this inside the rim: twice the chord of curves
/// that a file gives as lines. Default, unsourced.
constexpr double kRimMm = 0.004;

/// Takes cells down and keeps the account. What only the outermost rim takes may be what the chords of a
/// file's curves left before: no depth of cut.
struct Knife {
  Grid& grid;
  const CutAsks& asks;
  Bite& bite;
  double core, rim;
  int judged = 0;

  template <class Way>
  void take(int ix, int iy, const Way& way, Vec2 p, Over& over) {
    const std::size_t i = grid.index(ix, iy);
    if (asks.contact || asks.head_mm > 0.0 || asks.advance_mm > 0.0) way.find_tip(p, grid.stock[i], over);
    const double deep = grid.stock[i] - std::max(over.bound, grid.base[i]);
    const double thick = way.chip(p, grid.stock[i], deep, asks.advance_mm, over);
    if (thick > bite.chip_mm) {
      bite.chip_mm = thick;
      bite.chip_at = p;
    }
    at(ix, iy, over.tip, over.z, over.near);
  }
  void at(int ix, int iy, double tip_z, double z, double from_axis) {
    const std::size_t i = grid.index(ix, iy);
    double& s = grid.stock[i];
    if (z >= s || (asks.head_mm > 0.0 && s > tip_z + asks.head_mm)) return;
    const double floor = grid.base[i];
    if (s > Grid::kNothing / 2) {
      bite.volume_mm3 += (s - std::max(z, floor)) * grid.cell() * grid.cell();
      const double taken = s - std::max(z, floor);
      if (from_axis <= rim) {
        const double from_z = asks.above_underside ? std::max(tip_z, floor) : tip_z;
        if (asks.contact) bite.contact_mm = std::max(bite.contact_mm, s - from_z);
        bite.thickest_mm = std::max(bite.thickest_mm, taken);
      }
      if (from_axis <= core) bite.core_mm = std::max(bite.core_mm, taken);
      const double below = grid.part[i] - z;
      if (below > asks.allowed_mm && below > bite.gouge_mm) gouge(ix, iy, z, below);
    }
    s = z <= floor ? Grid::kNothing : z;
  }
  void gouge(int ix, int iy, double z, double below) {
    constexpr int kMostJudged = 500;  // per move; a true gouge is found by the first
    if (asks.judge != nullptr && (++judged > kMostJudged || !asks.judge->is_gouge(grid.centre(ix, iy), z)))
      return;
    bite.gouge_mm = below;
    bite.gouge_at = grid.centre(ix, iy);
  }
};

/// Cells in rows and columns that the way touches, those that stand higher than it comes.
template <class Way>
void pass(Knife& k, const Way& way) {
  const auto [ya, yb] = way.reach_y();
  const auto [y0, y1] = k.grid.rows(ya, yb);
  Over at;
  for (int iy = y0; iy < y1; ++iy) {
    tick();
    if (k.grid.row_top(iy) <= way.zmin()) continue;
    const auto [xa, xb] = way.reach_x(k.grid.centre(0, iy).y);
    const auto [x0, x1] = k.grid.columns(xa, xb);
    if (x0 >= x1) continue;
    k.grid.cut_cells(iy, x0, x1);
    const double* const row = k.grid.stock.data() + k.grid.index(0, iy);
    const Vec2 first = k.grid.centre(0, iy);
    way.candidates(row, x0, x1, first, k.grid.cell(), [&](int ix) {
      const double stands = row[ix];
      if (stands <= way.zmin()) return;
      const Vec2 p = k.grid.centre(ix, iy);
      if (way.meets(p, stands, at)) k.take(ix, iy, way, p, at);
    });
  }
}

}  // namespace

Bite cut(Grid& grid, const Move& m, const CutterOutline& o, const CutAsks& asks) {
  Bite bite;
  if (m.kind == model::MoveKind::kDwell) return bite;
  if (std::min(m.from.z, m.to.z) >= grid.top()) return bite;
  Knife k{grid, asks, bite, o.middle(), o.radius() - kRimMm};
  along_way(o, m, [&](const auto& way) { pass(k, way); });
  return bite;
}

}  // namespace capstan::verify
