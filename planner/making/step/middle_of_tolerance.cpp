#include "planner/making/step/middle_of_tolerance.h"

#include <algorithm>
#include <cmath>

// Sizes are cut to the middle of their tolerance: 20 H7 at 20.0105, an outside of 60 h9 at 59.963.

namespace capstan::step {
namespace {

using geometry::Vec2;
using model::FeatureShape;
using model::ShapeKind;
using model::Toleranced;

constexpr double kSame = 1e-3;  // mm; whether an outline is as wide and long as its profile says

double half_shift(const Toleranced& t) { return t.given ? 0.5 * (t.middle() - t.nominal_mm) : 0.0; }

geometry::Region turned(const geometry::Region& r, Vec2 x) {
  geometry::Region out = r;
  for (auto& loop : out.loops) {
    for (Vec2& p : loop) p = {dot(p, x), cross(x, p)};
  }
  return out;
}

/// The direction of the longest straight piece of an outline.
Vec2 longest(const geometry::Loop& loop) {
  Vec2 out{1.0, 0.0};
  double best = 0.0;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const Vec2 d = loop[(i + 1) % loop.size()] - loop[i];
    if (norm(d) <= best + 1e-9) continue;
    best = norm(d);
    out = (1.0 / best) * d;
  }
  return out;
}

/// An outline grown by dx on its sides across x, and by dy on those across y; corners keep their radii.
geometry::Region spread(const geometry::Region& r, double dx, double dy) {
  const auto box = geometry::bounds(r);
  const Vec2 middle = 0.5 * (box.lo + box.hi);
  const auto away = [](double v, double by) { return v > 1e-9 ? by : v < -1e-9 ? -by : 0.0; };
  geometry::Region out = r;
  for (auto& loop : out.loops) {
    for (Vec2& p : loop) {
      p.x += away(p.x - middle.x, dx);
      p.y += away(p.y - middle.y, dy);
    }
  }
  return out;
}

/// An outline at the middle of the tolerances of its length and width, which a rectangle has.
geometry::Region aimed(const geometry::Region& r, const FeatureShape& s) {
  const double across = half_shift(s.width);
  const bool known = s.length.nominal_mm > 0.0 && s.width.nominal_mm > 0.0;
  const double along = known ? half_shift(s.length) : across;
  if (along == 0.0 && across == 0.0) return r;
  if (std::abs(along - across) < 1e-9) return geometry::offset_sharp(r, along);
  if (r.loops.size() == 1) {
    const Vec2 x = longest(r.loops.front());
    const geometry::Region upright = turned(r, x);
    const auto box = geometry::bounds(upright);
    const auto is = [&](double dx, double dy) {
      return std::abs(box.hi.x - box.lo.x - dx) < kSame && std::abs(box.hi.y - box.lo.y - dy) < kSame;
    };
    const Vec2 back{x.x, -x.y};
    if (is(s.length.nominal_mm, s.width.nominal_mm)) return turned(spread(upright, along, across), back);
    if (is(s.width.nominal_mm, s.length.nominal_mm)) return turned(spread(upright, across, along), back);
  }
  return geometry::offset_sharp(r, s.width.given ? across : along);
}

/// What a cutter may reach when an outline that is cut out changes: grown by what it gains, less what it
/// loses.
geometry::Region reached(const geometry::Region& reach, const geometry::Region& before,
                         const geometry::Region& now) {
  return geometry::subtract(geometry::unite(reach, geometry::subtract(now, before)),
                            geometry::subtract(before, now));
}

void aim_pocket(FeatureShape& s) {
  const geometry::Region before = s.area;
  s.area = aimed(before, s);
  if (s.area.loops == before.loops) return;
  s.reach = s.open || !s.islands.empty() ? reached(s.reach, before, s.area) : s.area;
}

void aim_outside(FeatureShape& s) {
  if (s.islands.empty()) return;
  geometry::Region& stays = s.islands.front().area;
  const geometry::Region before = stays;
  stays = aimed(before, s);
  if (stays.loops != before.loops) s.reach = reached(s.reach, stays, before);
}

}  // namespace

void aim_at_the_middle(FeatureShape& s) {
  switch (s.kind) {
    case ShapeKind::kPocket:
      aim_pocket(s);
      break;
    case ShapeKind::kSlot: {
      const double shift = half_shift(s.width);
      if (shift != 0.0 && s.slot_profile.empty()) {
        s.area = geometry::offset_sharp(s.area, shift);
        s.reach = geometry::offset_sharp(s.reach, shift);
      }
      break;
    }
    case ShapeKind::kOutside:
      aim_outside(s);
      break;
    case ShapeKind::kStep:
      break;
    case ShapeKind::kHole:
      if (s.bottom != model::HoleBottom::kFlat || s.bottom_diameter_mm < s.diameter.nominal_mm - kSame)
        return;  // diameters are aimed by their own paths, and the depth of a cone follows from them
      break;
    default:
      return;  // a face's depth is no size of the part
  }
  if (s.depth_tolerance.given && !s.through)
    s.depth_mm += s.depth_tolerance.middle() - s.depth_tolerance.nominal_mm;
}

}  // namespace capstan::step
