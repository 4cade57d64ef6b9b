#include "planner/proof/verify/sweep/grid/closer_look.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "planner/ground/base/stopping.h"

namespace capstan::verify {

using geometry::Vec2;

namespace {

constexpr double kPoints = 40e3;  ///< of one look, at most; default, unsourced: a compromise of time
constexpr double kCloser = 8.0;   ///< than the set-up's cells, at most
constexpr double kWorthwhile = 1.4;

}  // namespace

void EarlierCuts::begin(const Grid& grid) {
  stock_ = grid.stock;
  base_ = grid.base;
  cuts_.clear();
}

void EarlierCuts::add(const Move& m, std::shared_ptr<const CutterOutline> cutter) {
  geometry::Box3 box = box_of(m);
  cuts_.push_back({m, std::move(cutter), box});
}

Grid EarlierCuts::before(const Grid& grid, Vec2 lo, Vec2 hi, double cell, std::size_t mark,
                         Begun begun) const {
  const bool all = begun == Begun::kWhereAllHaveIt;
  Grid local(lo, hi, cell, static_cast<long>(2.0 * kPoints));
  local.floor = grid.floor;
  for (int iy = 0; iy < local.ny(); ++iy) {
    tick();
    for (int ix = 0; ix < local.nx(); ++ix) {
      const Vec2 p = local.centre(ix, iy);
      const auto [x0, x1] = grid.columns(p.x - 1.01 * grid.cell(), p.x + 1.01 * grid.cell());
      const auto [y0, y1] = grid.rows(p.y - 1.01 * grid.cell(), p.y + 1.01 * grid.cell());
      // Not beside the piece.
      double low = all && x1 - x0 >= 2 && y1 - y0 >= 2 ? 1e300 : Grid::kNothing;
      double base = all ? Grid::kNothing : 1e300;
      for (int jy = y0; jy < y1; ++jy) {
        for (int jx = x0; jx < x1; ++jx) {
          const double s = stock_[grid.index(jx, jy)], b = base_[grid.index(jx, jy)];
          low = all ? std::min(low, s) : std::max(low, s);
          base = all ? std::max(base, b) : std::min(base, b);
        }
      }
      local.stock[local.index(ix, iy)] = low > base ? low : Grid::kNothing;
      local.base[local.index(ix, iy)] = base;
    }
  }
  local.find_top();
  std::vector<const Cut*> met;
  for (std::size_t i = 0; i < mark; ++i) {
    const Cut& c = cuts_[i];
    const double r = c.cutter->radius();
    if (c.box.lo.x - r > hi.x || c.box.hi.x + r < lo.x || c.box.lo.y - r > hi.y || c.box.hi.y + r < lo.y)
      continue;
    met.push_back(&c);
  }
  std::stable_sort(met.begin(), met.end(),
                   [](const Cut* a, const Cut* b) { return a->box.lo.z < b->box.lo.z; });
  for (const Cut* c : met) {
    tick();
    lower(local, c->move, *c->cutter);
  }
  return local;
}

Bite EarlierCuts::look(const Grid& grid, const Move& m, const CutterOutline& cutter, double advance_mm,
                       int& pieces) const {
  Bite worst;
  if (stock_.size() != grid.stock.size()) return worst;
  const double r = cutter.radius();
  const int n = is_arc(m.kind) ? 1 : std::max(1, static_cast<int>(std::ceil(length_of(m) / (4.0 * r))));
  const geometry::Vec3 start = m.from;
  for (int i = 0; i < n && pieces > 0; ++i) {
    Move part = m;
    if (n > 1) {
      part.from = point_of(m, static_cast<double>(i) / n);
      part.to = point_of(m, static_cast<double>(i + 1) / n);
    }
    const geometry::Box3 box = box_of(part);
    const Vec2 lo{box.lo.x - r, box.lo.y - r};
    const Vec2 hi{box.hi.x + r, box.hi.y + r};
    const double cell = std::max(grid.cell() / kCloser, std::sqrt((hi.x - lo.x) * (hi.y - lo.y) / kPoints));
    if (cell * kWorthwhile > grid.cell()) continue;
    --pieces;
    Grid local = before(grid, lo, hi, cell, cuts_.size(), Begun::kWhereAllHaveIt);
    if (i > 0) {
      Move earlier = m;
      earlier.from = start;
      earlier.to = part.from;
      lower(local, earlier, cutter);
    }
    const Bite bite = cut(local, part, cutter, 1e300, nullptr, advance_mm);
    if (bite.chip_mm > worst.chip_mm) worst = bite;
  }
  return worst;
}

bool EarlierCuts::takes(const Grid& grid, const std::vector<Move>& moves, const CutterOutline& cutter,
                        std::size_t mark, double& cell_mm) const {
  constexpr int kLooks = 400;  // default, unsourced: a compromise of time
  const double r = cutter.radius();
  cell_mm = 0.0;
  int looks = kLooks;
  for (const Move& m : moves) {
    if (m.kind == model::MoveKind::kRapid || m.kind == model::MoveKind::kDwell) continue;
    if (stock_.size() != grid.stock.size()) return true;  // not known
    const int n = is_arc(m.kind) ? 1 : std::max(1, static_cast<int>(std::ceil(length_of(m) / (4.0 * r))));
    for (int i = 0; i < n; ++i) {
      if (looks-- <= 0) return false;  // so many places, and nothing in any of them
      Move part = m;
      if (n > 1) {
        part.from = point_of(m, static_cast<double>(i) / n);
        part.to = point_of(m, static_cast<double>(i + 1) / n);
      }
      const geometry::Box3 box = box_of(part);
      const Vec2 lo{box.lo.x - r, box.lo.y - r};
      const Vec2 hi{box.hi.x + r, box.hi.y + r};
      const double cell = std::max(grid.cell() / kCloser, std::sqrt((hi.x - lo.x) * (hi.y - lo.y) / kPoints));
      Grid local = before(grid, lo, hi, cell, mark, Begun::kWhereAnyHasIt);
      cell_mm = std::max(cell_mm, local.cell());
      if (cut(local, part, cutter, 1e300, nullptr).volume_mm3 > 0.0) return true;
    }
  }
  return false;
}

}  // namespace capstan::verify
