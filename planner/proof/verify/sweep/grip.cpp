#include "planner/proof/verify/sweep/grip.h"

#include <algorithm>
#include <cmath>

namespace capstan::verify {
namespace {

using geometry::Vec2;
using model::FixtureSolid;

constexpr double kPressMm = 0.05;     // a clamp touches what is within this of it; default, unsourced
constexpr double kLostShare = 0.005;  // of a contact, that sampling may lose; default, unsourced

/// The cell a point lies in; nothing outside.
std::optional<std::size_t> cell_at(const Grid& g, Vec2 p) {
  const Vec2 first = g.centre(0, 0);
  const auto ix = static_cast<long>(std::lround((p.x - first.x) / g.cell()));
  const auto iy = static_cast<long>(std::lround((p.y - first.y) / g.cell()));
  if (ix < 0 || iy < 0 || ix >= g.nx() || iy >= g.ny()) return std::nullopt;
  return g.index(static_cast<int>(ix), static_cast<int>(iy));
}

bool within(const FixtureSolid& s, Vec2 p) {
  bool in = false;
  for (std::size_t i = 0, k = s.outline.size() - 1; i < s.outline.size(); k = i++) {
    const Vec2 a = s.outline[i], b = s.outline[k];
    if ((a.y > p.y) != (b.y > p.y) && p.x < (b.x - a.x) * (p.y - a.y) / (b.y - a.y) + a.x) in = !in;
  }
  return in;
}

}  // namespace

double Grip::contact(const FixtureSolid& s, const Grid& grid) const {
  double area = 0.0;
  // Beside: just outside each edge, as high as solid and piece stand side by side.
  for (std::size_t i = 0; i < s.outline.size(); ++i) {
    const Vec2 a = s.outline[i], d = s.outline[(i + 1) % s.outline.size()] - a;
    const double length = norm(d);
    if (!(length > 0.0)) continue;
    const Vec2 out = (1.0 / length) * Vec2{d.y, -d.x};
    const int n = std::max(1, static_cast<int>(std::ceil(length / grid.cell())));
    for (int k = 0; k < n; ++k) {
      const auto cell = cell_at(grid, a + ((k + 0.5) / n) * d + (0.6 * grid.cell()) * out);
      if (!cell) continue;
      const double top = std::min(s.top_mm, grid.stock[*cell]);
      const double bottom = std::max(s.bottom_mm, grid.base[*cell]);
      area += std::max(0.0, top - bottom) * length / n;
    }
  }
  // Below: where the piece's top carries the clamp.
  double x0 = 1e300, x1 = -1e300, y0 = 1e300, y1 = -1e300;
  for (const Vec2 p : s.outline) {
    x0 = std::min(x0, p.x);
    x1 = std::max(x1, p.x);
    y0 = std::min(y0, p.y);
    y1 = std::max(y1, p.y);
  }
  const auto [r0, r1] = grid.rows(y0, y1);
  const auto [c0, c1] = grid.columns(x0, x1);
  for (int iy = r0; iy < r1; ++iy) {
    for (int ix = c0; ix < c1; ++ix) {
      const double gap = s.bottom_mm - grid.stock[grid.index(ix, iy)];
      if (std::abs(gap) <= kPressMm && within(s, grid.centre(ix, iy))) area += grid.cell() * grid.cell();
    }
  }
  return area;
}

Grip::Grip(const model::Workholding& holding, const Grid& grid, const StepMoves& first, Findings& findings)
    : holding_(holding) {
  for (const FixtureSolid& s : holding.solids) {
    area_.push_back(s.presses && s.outline.size() > 2 ? contact(s, grid) : 0.0);
    if (!s.presses || area_.back() > 0.0) continue;
    findings.error(31, "CHK-HOLD-CONTACT", {first.order + 1, first.id, -1},
                   "'" + s.id + "' of '" + holding.id +
                       "' does not touch the piece when the set-up begins: nothing is there between z = " +
                       plain(s.bottom_mm) + " and " + plain(s.top_mm));
  }
}

void Grip::after(const StepMoves& step, const Grid& grid, Findings& findings) {
  for (std::size_t i = 0; i < area_.size(); ++i) {
    const FixtureSolid& s = holding_.solids[i];
    if (!s.presses || area_[i] <= 0.0) continue;
    const double now = contact(s, grid);
    const double lost = area_[i] - now;
    if (lost > std::max(kLostShare * area_[i], grid.cell() * grid.cell())) {
      findings.error(31, now > 0.0 ? "CHK-HOLD-CUT" : "CHK-HOLD-LOST", {step.order + 1, step.id, -1},
                     "the step takes away " + plain(lost) + " mm2 of the " + plain(area_[i]) + " mm2 that '" +
                         s.id + "' of '" + holding_.id + "' presses on (cells of " + mm(grid.cell()) + ")" +
                         (now > 0.0 ? "" : ": the piece is no longer held there"),
                     lost);
    }
    area_[i] = std::min(area_[i], now);
  }
}

}  // namespace capstan::verify
