#include "planner/making/toolpath/freeform/finish/rest.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "planner/making/toolpath/freeform/rough/reach.h"

// A ball of radius r that touches the surface touches it at its middle less r times the normal, which the
// slope of its places gives. A wider ball touches at that point, too, if it may stand with its middle R along
// the normal from it. How much higher it must stand, square to the surface, is what it leaves at most.

namespace capstan::toolpath::freeform {

using geometry::Vec2;
using geometry::Vec3;

std::vector<double> left_by_wider(const DropGrid& grid, const DropCutter& drop, const MillEnd& cutter,
                                  const MillEnd& wider, const stock::HeightMap* stock, Job& job) {
  std::vector<double> out(grid.z.size());
  const double r = cutter.ball_mm(), wide = wider.ball_mm();
  const double step = 1e-3 * r;
  parallel_for(job, static_cast<std::size_t>(grid.ny), [&](std::size_t row) {
    if (job.stop_requested()) return;
    std::uint32_t hint = 0, hint_of_wider = 0;
    for (int ix = 0; ix < grid.nx; ++ix) {
      const std::size_t i = row * static_cast<std::size_t>(grid.nx) + static_cast<std::size_t>(ix);
      if (!is_place(grid.z[i])) continue;
      const Vec2 p = grid.place(ix, static_cast<int>(row));
      const double z = drop.drop(cutter, p.x, p.y, 0.0, hint);
      const double zx = drop.drop(cutter, p.x + step, p.y, 0.0, hint);
      const double zy = drop.drop(cutter, p.x, p.y + step, 0.0, hint);
      if (z == DropCutter::kNoContact || zx == DropCutter::kNoContact || zy == DropCutter::kNoContact)
        continue;
      const Vec3 normal = [&] {
        const Vec3 n{-(zx - z) / step, -(zy - z) / step, 1.0};
        return (1.0 / norm(n)) * n;
      }();
      const Vec3 middle = Vec3{p.x, p.y, z + r} + (wide - r) * normal;
      const double stands = drop.drop(wider, middle.x, middle.y, 0.0, hint_of_wider);
      out[i] = stands == DropCutter::kNoContact ? std::numeric_limits<double>::infinity()
                                                : std::max(0.0, (stands - (middle.z - wide)) * normal.z);
      if (stock == nullptr || !(out[i] > 0.0)) continue;
      const Vec3 contact = Vec3{p.x, p.y, z + r} - r * normal;
      // One height stands for all of a cell, over which the surface rises: half of its diagonal either way.
      const double by_cell =
          std::numbers::sqrt2 / 2.0 * stock->cell_mm * std::sqrt(1.0 - normal.z * normal.z);
      const double there = (stock::height_at(*stock, xy(contact)) - contact.z) * normal.z + by_cell;
      out[i] = std::min(out[i], std::max(0.0, there));
    }
  });
  return out;
}

Mask more_than(const DropGrid& grid, const std::vector<double>& left_mm, double limit_mm) {
  Mask out = empty_mask(grid);
  for (std::size_t i = 0; i < left_mm.size(); ++i) out.on[i] = left_mm[i] > limit_mm ? 1 : 0;
  return out;
}

}  // namespace capstan::toolpath::freeform
