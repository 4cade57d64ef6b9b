#include "planner/making/piece/surroundings.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "planner/ground/base/number.h"
#include "planner/ground/base/stopping.h"
#include "planner/ground/geometry/moved.h"
#include "planner/making/piece/mesh/surface_form.h"
#include "planner/model/features/in_piece.h"
#include "planner/model/features/raw_piece.h"
#include "planner/model/nouns/arena/walk.h"

namespace capstan::piece {
namespace {

using geometry::Box2;
using geometry::Loop;
using geometry::Region;
using geometry::Vec2;
using model::FeatureShape;
using model::Model;
using model::ShapeKind;

constexpr double kSame = 1e-6;                 // mm, and of directions
constexpr std::size_t kMostPoints = 400;       // of an outline that distances are measured from
constexpr std::size_t kMostMeasured = 200000;  // points against segments, of one pair of outlines

/// Heights that a feature takes away, and the box of its area, in another feature's frame.
struct Seen {
  double top = 0.0, bottom = 0.0;
  Box2 box;
};

Seen see(const FeatureShape& other, const geometry::Placement& to) {
  const auto rel = compose(to, other.frame);
  const double a = rel.origin.z;
  const double b = (rel.origin - other.depth_mm * rel.z).z;
  Seen out{std::max(a, b), std::min(a, b), {}};
  const Box2 own = geometry::bounds(other.area);
  for (const Vec2 c : {own.lo, Vec2{own.hi.x, own.lo.y}, own.hi, Vec2{own.lo.x, own.hi.y}}) {
    const auto p = rel.to_parent({c.x, c.y, 0.0});
    out.box.lo = {std::min(out.box.lo.x, p.x), std::min(out.box.lo.y, p.y)};
    out.box.hi = {std::max(out.box.hi.x, p.x), std::max(out.box.hi.y, p.y)};
  }
  return out;
}

double gap(const Box2& a, const Box2& b) {
  const double x = std::max({0.0, a.lo.x - b.hi.x, b.lo.x - a.hi.x});
  const double y = std::max({0.0, a.lo.y - b.hi.y, b.lo.y - a.hi.y});
  return std::hypot(x, y);
}

/// The area that a feature removes at its bottom; of an outside, everything but the contour that stays.
geometry::Region taken(const FeatureShape& s) {
  geometry::Region out = s.area;
  for (const auto& i : s.islands) out = geometry::subtract(out, i.area);
  return out;
}

std::size_t points_of(const geometry::Region& r) {
  std::size_t n = 0;
  for (const Loop& loop : r.loops) n += loop.size();
  return n;
}

double gap(const Box2& box, Vec2 p) { return gap(box, {p, p}); }

/// The smallest distance between two areas; 0 when they meet, nothing when they are too fine to measure. Asks
/// the point that lies nearest to the other's box first: few others can then be nearer than it.
std::optional<double> between(const geometry::Region& a, const geometry::Region& b) {
  if (points_of(a) * points_of(b) > kMostMeasured) return std::nullopt;
  double out = 1e300;
  for (const auto& [from, to] : {std::pair(&a, &b), std::pair(&b, &a)}) {
    const Box2 box = geometry::bounds(*to);
    const auto meets = [&, to = to](Vec2 p) {
      tick(16);  // it asks all edges of the other, thousands at most
      if (geometry::contains(*to, p)) return true;
      out = std::min(out, geometry::distance_to_boundary(*to, p));
      return false;
    };
    const Vec2* nearest = nullptr;
    double least_gap = 1e300;
    for (const Loop& loop : from->loops) {
      for (const Vec2& p : loop) {
        if (const double d = gap(box, p); d < least_gap) {
          least_gap = d;
          nearest = &p;
        }
      }
    }
    if (nearest == nullptr) continue;
    if (meets(*nearest)) return 0.0;
    for (const Loop& loop : from->loops) {
      for (const Vec2& p : loop) {
        if (gap(box, p) < out && &p != nearest && meets(p)) return 0.0;
      }
    }
  }
  return out;
}

void least(std::optional<double>& to, double v) {
  if (v > kSame) to = to ? std::min(*to, v) : v;
}

/// From the outline straight out to the sides of the raw piece: what stays there. Sides that the area reaches
/// are open: where its outline runs out over one there is no wall, however near its corners come to it.
void to_raw_sides(const FeatureShape& s, const geometry::Box3& raw, std::optional<double>& wall) {
  const std::size_t stride = points_of(s.area) / kMostPoints + 1;
  const Box2 box = geometry::bounds(s.area);
  const bool right = raw.hi.x - box.hi.x > kSame;
  const bool left = box.lo.x - raw.lo.x > kSame;
  const bool back = raw.hi.y - box.hi.y > kSame;
  const bool front = box.lo.y - raw.lo.y > kSame;
  for (const Loop& loop : s.area.loops) {
    for (std::size_t i = 0; i < loop.size(); i += stride) {
      const Vec2 a = loop[i];
      const Vec2 b = loop[(i + 1) % loop.size()];
      const double n = norm(b - a);
      if (n < kSame) continue;
      const Vec2 out{(b.y - a.y) / n, (a.x - b.x) / n};
      const Vec2 p = 0.5 * (a + b);
      double t = 1e300;
      if (right && out.x > kSame) t = std::min(t, (raw.hi.x - p.x) / out.x);
      if (left && out.x < -kSame) t = std::min(t, (raw.lo.x - p.x) / out.x);
      if (back && out.y > kSame) t = std::min(t, (raw.hi.y - p.y) / out.y);
      if (front && out.y < -kSame) t = std::min(t, (raw.lo.y - p.y) / out.y);
      if (t < 1e299) least(wall, t);
    }
  }
}

/// What the shapes of these numbers leave beside and below `s`.
Thickness thickness_among(const Piece& piece, const FeatureShape& s, const Region& own,
                          const std::vector<std::size_t>& others) {
  Thickness out;
  const auto to = inverse(s.frame);
  const geometry::Box3 raw = transformed(piece.plan.stock.box, to);
  const Box2 box = geometry::bounds(own);
  if (model::has(s.kind, model::ShapeTrait::kWalled)) to_raw_sides(s, raw, out.wall_mm);
  double below = s.through ? 0.0 : -s.depth_mm - raw.lo.z;
  for (const std::size_t i : others) {
    const FeatureShape& other = piece.shapes.all[i];
    if (other.feature == s.feature && other.member == s.member) continue;
    if (other.area.empty() || std::abs(std::abs(dot(other.frame.z, s.frame.z)) - 1.0) > kSame) continue;
    const Seen seen = see(other, to);
    const bool same_side = dot(other.frame.z, s.frame.z) > 0.0;
    const bool beside = seen.bottom < -kSame && seen.top > -s.depth_mm + kSame;
    const bool under = !same_side && !s.through && seen.top < -s.depth_mm - kSame && !other.through;
    const double apart = gap(box, seen.box);
    if (under && apart <= 0.0) {
      const auto area = geometry::moved(taken(other), compose(to, other.frame));
      if (!geometry::intersect(own, area).empty()) below = std::min(below, -s.depth_mm - seen.top);
    }
    if (!beside || other.kind == ShapeKind::kFace || other.kind == ShapeKind::kThread) continue;
    if (out.wall_mm && apart >= *out.wall_mm) continue;
    if (const auto d = between(own, geometry::moved(taken(other), compose(to, other.frame))))
      least(out.wall_mm, *d);
  }
  if (below > kSame) out.floor_mm = below;
  return out;
}

bool is_wide(const FeatureShape& s) { return s.kind == ShapeKind::kFace || s.kind == ShapeKind::kOutside; }

std::vector<std::size_t> all_of(const Shapes& shapes) {
  std::vector<std::size_t> out(shapes.all.size());
  std::iota(out.begin(), out.end(), std::size_t{0});
  return out;
}

/// Those that lie no farther than `far` from the axis of `s`, and all that may be open all round. Rising.
std::vector<std::size_t> mouths_about(const Shapes& shapes, const FeatureShape& s, double far) {
  if (shapes.near_all.size() != shapes.all.size()) return all_of(shapes);
  std::vector<std::size_t> out = shapes.near_all.near({s.frame.origin, 0.0}, s.frame.z, far);
  const auto near = static_cast<std::ptrdiff_t>(out.size());
  for (std::size_t i = 0; i < shapes.all.size(); ++i)
    if (is_wide(shapes.all[i])) out.push_back(i);
  std::inplace_merge(out.begin(), out.begin() + near, out.end());
  out.erase(std::unique(out.begin(), out.end()), out.end());
  return out;
}

}  // namespace

Thickness thickness_beside(const Piece& piece, const FeatureShape& s) {
  if (s.area.empty() || s.kind == ShapeKind::kFreeform) return {};
  const Region own = taken(s);
  const Neighbours& index = piece.shapes.near_all;
  if (index.size() != piece.shapes.all.size()) return thickness_among(piece, s, own, all_of(piece.shapes));
  // What lies farther aside than the thinnest wall is neither beside nor under. A wall among the near ones
  // says how far the others can matter; where there is none, more are near.
  const Around here = around(s);
  const double farthest =
      norm(here.centre - (index.size() > 0 ? index.ball(0).centre : here.centre)) + index.span_mm();
  for (double reach = index.spacing_mm();;) {
    const Thickness out = thickness_among(piece, s, own, index.near(here, s.frame.z, reach));
    if ((out.wall_mm && *out.wall_mm <= reach) || !(reach < farthest)) return out;
    constexpr double kWider = 4.0;
    reach = out.wall_mm ? *out.wall_mm : kWider * reach;
  }
}

std::optional<double> clear_beside(const Piece& piece, const FeatureShape& s) {
  constexpr double kFarMm = 50.0;     // no spot drill is as wide as this from its axis
  constexpr double kAwayMm = 1000.0;  // where a face has no walls
  if (s.kind != ShapeKind::kHole) return std::nullopt;
  const auto to = inverse(s.frame);
  geometry::Region free;
  for (const std::size_t i : mouths_about(piece.shapes, s, kFarMm)) {
    const FeatureShape& other = piece.shapes.all[i];
    if (other.area.empty() || dot(other.frame.z, s.frame.z) < 1.0 - kSame) continue;
    const bool wide = is_wide(other);
    const bool walled = other.kind == ShapeKind::kStep || model::has(other.kind, model::ShapeTrait::kWalled);
    if (!wide && !walled) continue;
    if (other.kind == ShapeKind::kHole && other.diameter.nominal_mm <= s.diameter.nominal_mm) continue;
    const Seen seen = see(other, to);
    if (seen.top <= kSame || seen.bottom > kSame) continue;
    if (!wide && gap({{0, 0}, {0, 0}}, seen.box) > kFarMm) continue;
    const auto rel = compose(to, other.frame);
    const bool all_round = wide && !model::stops_at_walls(other);
    geometry::Region open = all_round ? geometry::rectangle({-kAwayMm, -kAwayMm}, {kAwayMm, kAwayMm})
                                      : geometry::moved(other.reach.empty() ? other.area : other.reach, rel);
    for (const model::Island& island : other.islands) {
      if (rel.origin.z + island.top_z_mm > kSame)
        open = geometry::subtract(open, geometry::moved(island.area, rel));
    }
    free = free.empty() ? open : geometry::unite(free, open);
  }
  if (free.empty() || !geometry::contains(free, {0, 0})) return std::nullopt;
  const double clear = geometry::distance_to_boundary(free, {0, 0});
  return clear < kFarMm ? std::optional(clear) : std::nullopt;
}

/// How far the walls are apart at which a step ends on both sides; 0: it runs out on one.
double between_ends(const Piece& piece, const FeatureShape& s) {
  constexpr double kBeyond = 0.5;  // mm
  if (s.kind != ShapeKind::kStep || s.spine.size() < 2) return 0.0;
  const double length = norm(s.spine.back() - s.spine.front());
  if (length < kSame) return 0.0;
  const Vec2 d = (kBeyond / length) * (s.spine.back() - s.spine.front());
  const Vec2 in{d.y, -d.x};  // the step lies on the right of its line
  const geometry::Region beside = stays_beside(piece, s);
  for (const Vec2 p : {s.spine.front() - d + in, s.spine.back() + d + in}) {
    if (!geometry::contains(beside, p)) return 0.0;
  }
  return length;
}

std::string crosses_a_wall(const Piece& piece, const FeatureShape& face) {
  constexpr double kSomeArea = 1.0;  // mm2: less is rounding of outlines
  if (face.kind != ShapeKind::kFace) return {};
  const auto to = inverse(face.frame);
  const geometry::Region own = taken(face);
  for (const FeatureShape& other : piece.shapes.all) {
    // The contour of an outside is the part itself: steps and faces on it are part of its drawing.
    if (other.feature == face.feature || other.islands.empty() || other.kind == ShapeKind::kOutside) continue;
    const auto rel = compose(to, other.frame);
    if (std::abs(rel.z.z - 1.0) > kSame) continue;
    for (const model::Island& island : other.islands) {
      const double top = rel.origin.z + island.top_z_mm;
      if (top <= -face.depth_mm + kSame || rel.origin.z - other.depth_mm >= -kSame) continue;
      const auto boss = geometry::moved(island.area, rel);
      const double inside = geometry::area(geometry::intersect(own, boss));
      const double whole = geometry::area(boss);
      if (inside <= kSomeArea || inside >= whole - kSomeArea) continue;
      return "it crosses a boss in '" + other.name + "', which stands " + trimmed(top + face.depth_mm, 3) +
             " mm above the face's floor; end the face at the boss, or lower the boss to it";
    }
  }
  return {};
}

geometry::Region stays_beside(const Piece& piece, const model::FeatureShape& s) {
  constexpr double kSame = 1e-6;
  const auto to = inverse(s.frame);
  const geometry::Box3 part = transformed(part_box(piece), to);
  geometry::Region out =
      geometry::subtract(geometry::rectangle(geometry::xy(part.lo), geometry::xy(part.hi)), s.area);
  if (out.empty()) return out;
  // Skip a boss that a face lists: its shape surrounds the boss and is not cut beside it.
  for (const model::FeatureShape& other : piece.shapes.whole) {
    const auto rel = compose(to, other.frame);
    if ((other.feature == s.feature && other.member == s.member) || rel.z.z < 1.0 - kSame ||
        other.area.empty())
      continue;
    if (rel.origin.z - other.depth_mm > -s.depth_mm + kSame) continue;
    geometry::Region cut = other.area;
    for (const auto& island : other.islands) cut = geometry::subtract(cut, island.area);
    out = geometry::subtract(out, geometry::moved(cut, rel));
  }
  return out;
}

void stop_at_walls(const Piece& piece, model::FeatureShape& s) {
  // Thinner walls are the rounding of a drawing, and less than what a part's tolerances allow. Default,
  // unsourced.
  constexpr double kThinMm = 0.1;
  constexpr double kSame = 1e-6;
  if (s.kind != ShapeKind::kFace || s.area.empty() || piece.shapes.all.empty() || piece.plan.target_mesh)
    return;
  const geometry::Box3 part = transformed(part_box(piece), inverse(s.frame));
  if (part.hi.z <= -s.depth_mm + kSame) return;
  const geometry::Region beside = stays_beside(piece, s);
  bool walled = false;
  for (const geometry::Region& part_of : geometry::pieces(beside)) {
    if (geometry::offset(part_of, -0.5 * kThinMm).empty()) continue;
    s.reach = geometry::subtract(s.reach, part_of);
    walled = true;
  }
  if (!walled) return;
  // Areas that other features cut as deep behind the walls are no way out of this face; their own cutters
  // must fit there.
  const geometry::Region around =
      geometry::subtract(geometry::rectangle(geometry::xy(part.lo), geometry::xy(part.hi)), s.area);
  const geometry::Region own = geometry::offset_sharp(s.area, kThinMm);
  for (const geometry::Region& part_of : geometry::pieces(geometry::subtract(around, beside))) {
    if (geometry::intersect(part_of, own).empty()) s.reach = geometry::subtract(s.reach, part_of);
  }
}

double stock_above(const Piece& piece, const FeatureShape& s) {
  double top = transformed(piece.plan.stock.box, inverse(s.frame)).hi.z;
  if (s.kind == model::ShapeKind::kFace) return std::max(0.0, top);
  if (s.kind == model::ShapeKind::kFreeform && piece.plan.target_mesh)
    return std::max(0.0, top - lowest_seen_mm(*piece.plan.target_mesh, s.frame).value_or(0.0));
  for (const FeatureShape& face : piece.shapes.faces) {
    const auto rel = compose(inverse(s.frame), face.frame);
    if (std::abs(rel.z.z - 1.0) > kSame) continue;
    const auto here = face.frame.to_local(s.frame.origin);
    if (!geometry::contains(face.area, geometry::xy(here))) continue;
    top = std::min(top, rel.origin.z - face.depth_mm);
  }
  return std::max(0.0, top);
}

Thickness thinnest_beside(const Piece& piece, const std::vector<FeatureShape>& shapes) {
  Thickness out;
  for (const FeatureShape& s : shapes) {
    poll();
    const Thickness t = thickness_beside(piece, s);
    if (t.wall_mm) least(out.wall_mm, *t.wall_mm);
    if (t.floor_mm) least(out.floor_mm, *t.floor_mm);
  }
  return out;
}

std::optional<double> least_clear_beside(const Piece& piece, const std::vector<FeatureShape>& shapes) {
  std::optional<double> out;
  for (const FeatureShape& s : shapes) {
    if (const auto clear = clear_beside(piece, s)) least(out, *clear);
  }
  return out;
}

double raw_above(const geometry::Box3& raw, const geometry::Placement& feature) {
  return std::max(0.0, transformed(raw, inverse(feature)).hi.z);
}

}  // namespace capstan::piece
