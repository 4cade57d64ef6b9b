#include "planner/making/toolpath/freeform/finish/rest.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "planner/making/toolpath/freeform/rough/reach.h"

// A ball of radius r that touches the surface touches it at its middle less r times the normal, which the
// slope of its places gives. A wider ball touches at that point, too, if it may stand with its middle R along
// the normal from it. How much higher it must stand, square to the surface, is what it leaves at most.

namespace capstan::toolpath::freeform {

using geometry::Vec2;
using geometry::Vec3;

namespace {

/// Where a ball whose tip stands over a place touches the surface raised by an allowance, and its normal
/// there.
struct Contact {
  Vec3 at, normal;
};

std::optional<Contact> contact_of(const DropCutter& drop, const MillEnd& ball, Vec2 p, double allowance_mm,
                                  std::uint32_t& hint) {
  const double r = ball.ball_mm(), step = 1e-3 * r;
  const double z = drop.drop(ball, p.x, p.y, allowance_mm, hint);
  const double zx = drop.drop(ball, p.x + step, p.y, allowance_mm, hint);
  const double zy = drop.drop(ball, p.x, p.y + step, allowance_mm, hint);
  if (z == DropCutter::kNoContact || zx == DropCutter::kNoContact || zy == DropCutter::kNoContact)
    return std::nullopt;
  const Vec3 n{-(zx - z) / step, -(zy - z) / step, 1.0};
  const Vec3 normal = (1.0 / norm(n)) * n;
  return Contact{Vec3{p.x, p.y, z + r} - r * normal, normal};
}

/// What stands above a point of contact, square to the surface.
double standing_at(const stock::HeightMap& stock, const Contact& c) {
  // One height stands for all of a cell, over which the surface rises: half of its diagonal either way.
  const double by_cell = std::numbers::sqrt2 / 2.0 * stock.cell_mm * std::sqrt(1.0 - c.normal.z * c.normal.z);
  return std::max(0.0, (stock::height_at(stock, xy(c.at)) - c.at.z) * c.normal.z + by_cell);
}

/// A value for each place of a grid, in rows beside each other; 0 where it has none.
template <class F>
std::vector<double> over(const DropGrid& grid, Job& job, const F& of) {
  std::vector<double> out(grid.z.size());
  parallel_for(job, static_cast<std::size_t>(grid.ny), [&](std::size_t row) {
    if (job.stop_requested()) return;
    std::uint32_t hint = 0, other = 0;
    for (int ix = 0; ix < grid.nx; ++ix) {
      const std::size_t i = row * static_cast<std::size_t>(grid.nx) + static_cast<std::size_t>(ix);
      if (is_place(grid.z[i])) out[i] = of(grid.place(ix, static_cast<int>(row)), hint, other);
    }
  });
  return out;
}

}  // namespace

std::vector<double> left_by_wider(const DropGrid& grid, const DropCutter& drop, const MillEnd& cutter,
                                  const MillEnd& wider, const stock::HeightMap* stock, Job& job) {
  const double r = cutter.ball_mm(), wide = wider.ball_mm();
  return over(grid, job, [&](Vec2 p, std::uint32_t& hint, std::uint32_t& hint_of_wider) {
    const auto contact = contact_of(drop, cutter, p, 0.0, hint);
    if (!contact) return 0.0;
    const Vec3 normal = contact->normal;
    const Vec3 middle = contact->at + r * normal + (wide - r) * normal;
    const double stands = drop.drop(wider, middle.x, middle.y, 0.0, hint_of_wider);
    const double left = stands == DropCutter::kNoContact
                            ? std::numeric_limits<double>::infinity()
                            : std::max(0.0, (stands - (middle.z - wide)) * normal.z);
    return stock != nullptr && left > 0.0 ? std::min(left, standing_at(*stock, *contact)) : left;
  });
}

Mask more_than(const DropGrid& grid, const std::vector<double>& left_mm, double limit_mm) {
  Mask out = empty_mask(grid);
  for (std::size_t i = 0; i < left_mm.size(); ++i) out.on[i] = left_mm[i] > limit_mm ? 1 : 0;
  return out;
}

std::optional<Mask> where_stock_stands(const DropGrid& grid, const DropCutter& drop, const MillEnd& ball,
                                       const FreeformJob& task, Job& job) {
  /// Of the tolerance: less is a height that other mills or the raw piece have left; of all places: where
  /// fewer are left out, all are gone over. Defaults, unsourced.
  constexpr double kStandsShare = 1.0, kNearlyAll = 0.9;
  const std::vector<double> stands = over(grid, job, [&](Vec2 p, std::uint32_t& hint, std::uint32_t&) {
    const auto contact = contact_of(drop, ball, p, task.allowance_mm, hint);
    return contact ? standing_at(*task.stock, *contact) : std::numeric_limits<double>::infinity();
  });
  Mask standing = grown(more_than(grid, stands, kStandsShare * task.tolerance_mm), 2);
  std::size_t places = 0, of_them = 0;
  for (std::size_t i = 0; i < grid.z.size(); ++i) {
    if (!is_place(grid.z[i])) continue;
    ++places;
    of_them += standing.on[i] != 0 ? 1 : 0;
  }
  if (of_them == 0 || static_cast<double>(of_them) > kNearlyAll * static_cast<double>(places))
    return std::nullopt;
  return standing;
}

}  // namespace capstan::toolpath::freeform
