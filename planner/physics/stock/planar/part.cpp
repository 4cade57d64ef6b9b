#include "planner/physics/stock/planar/part.h"

#include <algorithm>
#include <cmath>

#include "planner/model/plan/path/own_frame.h"
#include "planner/physics/stock/planar/planar_stock.h"

namespace capstan::stock {

using geometry::Box3;
using geometry::Vec2;
using model::on_own_grid;

Trail in_own_frame(Trail t, Vec2 origin) {
  t.za = on_own_grid(t.za);
  t.zb = on_own_grid(t.zb);
  t.along = {};
  if (!t.arc) {
    const bool point = t.length_mm == 0.0;
    t.a = on_own_grid(t.a - origin);
    t.b = point ? t.a : on_own_grid(t.b - origin);
    t.settle();
    return t;
  }
  const Vec2 from = on_own_grid(t.a - t.centre), to = on_own_grid(t.b - t.centre);
  const double turn = std::atan2(cross(from, to), dot(from, to));
  t.centre = on_own_grid(t.centre - origin);
  t.a = t.centre + from;
  t.b = t.centre + to;
  // An arc shorter than the grid may turn nowhere, or back: then it is a line, or a point.
  t.arc = turn * t.turn_rad > 0.0;
  t.turn_rad = t.arc ? turn : 0.0;
  if (!t.arc) {
    t.centre = t.last = {};
    t.path_radius_mm = 0.0;
  }
  t.settle();
  return t;
}

PlanarPart PlanarStock::part(Vec2 lo, Vec2 hi, Vec2 origin) const {
  PlanarPart out;
  out.bar_radius_mm = bar_radius_mm_;
  const Vec2 box_lo = on_own_grid(xy(box_.lo) - origin), box_hi = on_own_grid(xy(box_.hi) - origin);
  if (bar_radius_mm_ > 0.0) {
    const Vec2 middle = 0.5 * (box_lo + box_hi);
    const Vec2 farthest{std::max(std::abs(lo.x - middle.x), std::abs(hi.x - middle.x)),
                        std::max(std::abs(lo.y - middle.y), std::abs(hi.y - middle.y))};
    if (norm(farthest) < bar_radius_mm_) out.bar_radius_mm = 0.0;  // a block to those within
  }
  out.box.lo = {box_lo.x, box_lo.y, on_own_grid(box_.lo.z)};
  out.box.hi = {box_hi.x, box_hi.y, on_own_grid(box_.hi.z)};
  if (out.bar_radius_mm == 0.0) {
    const auto within = [](double v, double from, double to) { return std::min(std::max(v, from), to); };
    out.box.lo = {within(lo.x, box_lo.x, box_hi.x), within(lo.y, box_lo.y, box_hi.y), out.box.lo.z};
    out.box.hi = {within(hi.x, box_lo.x, box_hi.x), within(hi.y, box_lo.y, box_hi.y), out.box.hi.z};
  }
  // Tiles of this stock lie otherwise about equal places: they only find what may be near.
  const Vec2 spare{model::kOwnGrid, model::kOwnGrid};
  int x0, x1, y0, y1;
  tiles_of(lo + origin - spare, hi + origin + spare, x0, x1, y0, y1);
  std::vector<std::uint32_t> ids;
  for (int y = y0; y <= y1; ++y) {
    for (int x = x0; x <= x1; ++x) {
      const auto& there = reaching_[number_of(x, y)];
      ids.insert(ids.end(), there.begin(), there.end());
    }
  }
  std::sort(ids.begin(), ids.end());
  ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
  for (const std::uint32_t id : ids) {
    Trail t = in_own_frame(trails_[id], origin);
    Vec2 from, to;
    bounds_of(t, from, to);
    if (from.x < hi.x && to.x > lo.x && from.y < hi.y && to.y > lo.y) out.trails.push_back(t);
  }
  return out;
}

PlanarStock PlanarStock::from_part(const PlanarPart& part) {
  PlanarStock out =
      part.bar_radius_mm > 0.0 ? from_cylinder(part.box, part.bar_radius_mm) : from_box(part.box);
  for (Trail t : part.trails) {
    t.outline = t.outline != nullptr ? out.keep(*t.outline) : nullptr;
    out.take(t);
  }
  return out;
}

}  // namespace capstan::stock
