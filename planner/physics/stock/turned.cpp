#include "planner/physics/stock/turned.h"

#include <algorithm>
#include <cmath>

namespace capstan::stock {
namespace {

using geometry::Placement;
using geometry::Vec2;
using geometry::Vec3;

constexpr double kAligned = 1.0 - 1e-9;
constexpr float kNothing = 1e-4F;  // mm above the floor

/// Highest column of `map` over the box [lo, hi], above its floor; 0 outside.
float highest(const HeightMap& map, Vec2 lo, Vec2 hi) {
  constexpr double kEdge = 1e-6;  // of a cell: cells that merely touch do not count
  const auto cell = [&](double p, double origin, double nudge) {
    return static_cast<int>(std::floor((p - origin) / map.cell_mm + nudge));
  };
  const int x0 = std::max(0, cell(lo.x, map.origin.x, kEdge));
  const int x1 = std::min(map.nx - 1, cell(hi.x, map.origin.x, -kEdge));
  const int y0 = std::max(0, cell(lo.y, map.origin.y, kEdge));
  const int y1 = std::min(map.ny - 1, cell(hi.y, map.origin.y, -kEdge));
  float top = 0.0F;
  for (int y = y0; y <= y1; ++y) {
    for (int x = x0; x <= x1; ++x) top = std::max(top, map.top[map.index(x, y)]);
  }
  return top;
}

void sink(HeightMap& map, std::size_t i, float height) {
  Column c = map.at(i);
  if (c.top_mm <= height) return;
  c.top_mm = height;
  if (height <= kNothing) {
    c = {};
  } else if (c.low_mm >= height) {
    c = {height, height, 0.0F};
  }
  map.set(i, c);
}

/// The highest material of `from` along a direction of its own frame.
double extent(const HeightMap& from, Vec3 along) {
  double best = -1e300;
  for (int y = 0; y < from.ny; ++y) {
    for (int x = 0; x < from.nx; ++x) {
      const float top = from.top[from.index(x, y)];
      if (top <= kNothing) continue;
      const double half = 0.5 * from.cell_mm;
      const double flat =
          along.x * from.x_of(x) + along.y * from.y_of(y) + half * (std::abs(along.x) + std::abs(along.y));
      const double z0 = along.z * from.origin.z;
      best = std::max(best, flat + std::max(z0, z0 + along.z * static_cast<double>(top)));
    }
  }
  return best;
}

}  // namespace

void take_over(HeightMap& to, const Placement& to_frame, const HeightMap& from, const Placement& from_frame) {
  const Placement there = compose(from_frame, inverse(to_frame));  // points of `to` in `from`
  const double same = there.z.z;
  if (std::abs(same) < kAligned) {
    const Placement back = inverse(there);
    const double top = extent(from, there.z) + back.origin.z;
    const auto height = static_cast<float>(std::max(0.0, top - to.origin.z));
    for (std::size_t i = 0; i < to.cells(); ++i) sink(to, i, height);
    return;
  }
  for (int y = 0; y < to.ny; ++y) {
    for (int x = 0; x < to.nx; ++x) {
      const std::size_t i = to.index(x, y);
      if (to.top[i] <= kNothing) continue;
      const Vec2 corner{to.origin.x + x * to.cell_mm, to.origin.y + y * to.cell_mm};
      Vec2 lo{1e300, 1e300}, hi{-1e300, -1e300};
      for (const double dx : {0.0, to.cell_mm}) {
        for (const double dy : {0.0, to.cell_mm}) {
          const Vec2 p = xy(there.to_parent({corner.x + dx, corner.y + dy, 0.0}));
          lo = {std::min(lo.x, p.x), std::min(lo.y, p.y)};
          hi = {std::max(hi.x, p.x), std::max(hi.y, p.y)};
        }
      }
      const float top = highest(from, lo, hi);
      if (same < 0.0) {
        if (top <= kNothing) to.set(i, {});
        continue;
      }
      // The same height over the workpiece, above this map's floor.
      const double z = from.origin.z + static_cast<double>(top) - there.origin.z;
      sink(to, i, static_cast<float>(std::max(0.0, top <= kNothing ? 0.0 : z - to.origin.z)));
    }
  }
}

}  // namespace capstan::stock
