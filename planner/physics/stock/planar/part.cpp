#include "planner/physics/stock/planar/part.h"

#include <algorithm>
#include <cmath>

#include "planner/model/plan/path/own_frame.h"
#include "planner/physics/stock/planar/planar_stock.h"

namespace capstan::stock {

using geometry::Box3;
using geometry::Vec2;
using model::on_own_grid;

namespace {

/// False only if nothing of the trail lies between lo and hi, seen along x, y and, of a straight one, its
/// track: by the trail and the two places alone, wherever tiles lie. All for which it is true is noted there:
/// stretches hold what lies within a trail's rectangle and no farther from the line of its track than its
/// radius.
bool may_reach(const Trail& t, Vec2 lo, Vec2 hi) {
  if (!(lo.x < hi.x && lo.y < hi.y)) return false;
  Vec2 from, to;
  bounds_of(t, from, to);
  if (from.x >= hi.x || to.x <= lo.x || from.y >= hi.y || to.y <= lo.y) return false;
  if (t.arc) return true;
  const Vec2 half = 0.5 * (hi - lo);
  const double beside = std::abs(cross(t.along, 0.5 * (lo + hi) - t.a));
  return beside < t.radius_mm + std::abs(t.along.y) * half.x + std::abs(t.along.x) * half.y;
}

}  // namespace

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
  const auto within_box = [&](Vec2 p) {
    return Vec2{std::min(std::max(p.x, box_lo.x), box_hi.x), std::min(std::max(p.y, box_lo.y), box_hi.y)};
  };
  const Vec2 part_lo = within_box(lo), part_hi = within_box(hi);
  const bool bar = out.bar_radius_mm > 0.0;
  const Vec2 from = bar ? box_lo : part_lo, to = bar ? box_hi : part_hi;
  out.box.lo = {from.x, from.y, on_own_grid(box_.lo.z)};
  out.box.hi = {to.x, to.y, on_own_grid(box_.hi.z)};
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
    const Trail t = in_own_frame(trails_[id], origin);
    if (may_reach(t, part_lo, part_hi)) out.trails.push_back(t);
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
