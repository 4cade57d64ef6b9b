#include "planner/proof/verify/sweep/grid/carry.h"
#include "planner/ground/base/stopping.h"

#include <algorithm>
#include <cmath>

namespace capstan::verify {
namespace {

using geometry::Placement;
using geometry::Vec2;
using geometry::Vec3;

constexpr double kAligned = 1.0 - 1e-9;
constexpr double kThin = 1e-6;  // mm: thinner is nothing

/// The cell a point lies in, or next to it within half a cell; -1 outside.
long cell_at(const Grid& g, Vec2 p) {
  const Vec2 first = g.centre(0, 0);
  const auto along = [&](double at, double start, int n) -> long {
    const long i = std::lround((at - start) / g.cell());
    if (i == -1) return 0;
    if (i == n) return n - 1;
    return i >= 0 && i < n ? i : -1;
  };
  const long ix = along(p.x, first.x, g.nx());
  const long iy = along(p.y, first.y, g.ny());
  if (ix < 0 || iy < 0) return -1;
  return static_cast<long>(g.index(static_cast<int>(ix), static_cast<int>(iy)));
}

bool solid(const Grid& g, Vec3 p) {
  const long i = cell_at(g, xy(p));
  if (i < 0) return false;
  const auto k = static_cast<std::size_t>(i);
  return p.z <= g.stock[k] && p.z >= g.base[k];
}

void trim(Grid& to, std::size_t i, double lo, double hi) {
  to.stock[i] = std::min(to.stock[i], hi);
  to.base[i] = std::max(to.base[i], lo);
  if (to.stock[i] <= to.base[i] + kThin) to.stock[i] = Grid::kNothing;
}

}  // namespace

void carry(Grid& to, const Placement& to_frame, const Grid& from, const Placement& from_frame) {
  const Placement there = compose(from_frame, inverse(to_frame));  // points of `to` in `from`
  const double same = there.z.z;
  const double step = to.cell();
  for (int iy = 0; iy < to.ny(); ++iy) {
    poll();
    for (int ix = 0; ix < to.nx(); ++ix) {
      const std::size_t i = to.index(ix, iy);
      double hi = to.stock[i];
      double lo = to.base[i];
      if (hi <= Grid::kNothing / 2) continue;
      const Vec2 c = to.centre(ix, iy);
      if (std::abs(same) > kAligned) {
        const Vec3 p = there.to_parent({c.x, c.y, 0.0});
        const long k = cell_at(from, xy(p));
        if (k < 0 || from.stock[static_cast<std::size_t>(k)] <= Grid::kNothing / 2) {
          to.stock[i] = Grid::kNothing;
          continue;
        }
        const double a = (from.stock[static_cast<std::size_t>(k)] - p.z) * same;
        const double b = (from.base[static_cast<std::size_t>(k)] - p.z) * same;
        trim(to, i, std::min(a, b), std::max(a, b));
        continue;
      }
      // Seen at an angle: from both ends to where the other grid has material, then halved to 1/128 of a
      // cell.
      const auto at = [&](double z) { return solid(from, there.to_parent({c.x, c.y, z})); };
      const auto edge = [&](double out, double in) {
        for (int n = 0; n < 7; ++n) {
          const double middle = 0.5 * (out + in);
          (at(middle) ? in : out) = middle;
        }
        return out;
      };
      double z = hi - kThin;
      while (z > lo && !at(z)) z -= step;
      if (z <= lo) {
        to.stock[i] = Grid::kNothing;
        continue;
      }
      const double top = z < hi - kThin ? edge(std::min(hi, z + step), z) : hi;
      double y = lo + kThin;
      while (y < z && !at(y)) y += step;
      const double bottom = y > lo + kThin ? edge(y - step, y) : lo;
      trim(to, i, bottom, top);
    }
  }
  to.find_top();
}

}  // namespace capstan::verify
