#include <algorithm>
#include <cmath>
#include <optional>

#include "planner/ground/base/number.h"
#include "planner/model/features/raw_piece.h"
#include "planner/model/features/resolve.h"
#include "planner/model/features/shape/build.h"

// Outsides: of a closed contour, of a boss, and beside an open line.
//
// An open line does not say which of its sides is taken away. It is run out straight over its ends and parts
// the raw piece in two: the smaller part is what is taken away, the larger one holds the part. The raw piece
// is the one that the file states; else the box that the other features span, which every raw piece must
// hold.

namespace capstan::model::shape {

using geometry::Box2;
using geometry::Vec2;

namespace {

/// Beyond this share of the raw piece the smaller side is hardly smaller; default, unsourced.
constexpr double kClearlySmaller = 0.4;

Vec2 unit(Vec2 v) { return (1.0 / norm(v)) * v; }

/// Where a ray from within a box leaves it.
Vec2 leaves(const Box2& box, Vec2 from, Vec2 d) {
  double t = 1e300;
  if (d.x > 1e-12) t = std::min(t, (box.hi.x - from.x) / d.x);
  if (d.x < -1e-12) t = std::min(t, (box.lo.x - from.x) / d.x);
  if (d.y > 1e-12) t = std::min(t, (box.hi.y - from.y) / d.y);
  if (d.y < -1e-12) t = std::min(t, (box.lo.y - from.y) / d.y);
  return from + t * d;
}

/// Which side of the box a point of its edge lies on, counter-clockwise from below, and how far along it, 0
/// .. 4.
double round_the_edge(const Box2& box, Vec2 p) {
  const Vec2 size = box.hi - box.lo;
  const double from[4] = {std::abs(p.y - box.lo.y), std::abs(p.x - box.hi.x), std::abs(p.y - box.hi.y),
                          std::abs(p.x - box.lo.x)};
  const auto side = std::min_element(from, from + 4) - from;
  const double along[4] = {(p.x - box.lo.x) / size.x, (p.y - box.lo.y) / size.y, (box.hi.x - p.x) / size.x,
                           (box.hi.y - p.y) / size.y};
  return static_cast<double>(side) + std::clamp(along[side], 0.0, 1.0);
}

/// What of a box lies on one side of a line, which is run out straight over its ends.
geometry::Region side_of(const std::vector<Vec2>& line, const Box2& box, bool right) {
  const std::size_t n = line.size();
  geometry::Loop loop = {leaves(box, line.front(), unit(line[0] - line[1]))};
  loop.insert(loop.end(), line.begin(), line.end());
  loop.push_back(leaves(box, line.back(), unit(line[n - 1] - line[n - 2])));
  const Vec2 corners[4] = {box.lo, {box.hi.x, box.lo.y}, box.hi, {box.lo.x, box.hi.y}};
  const double from = round_the_edge(box, loop.back());
  const double to = round_the_edge(box, loop.front());
  // Clockwise round the edge closes what lies on the right, counter-clockwise what lies on the left.
  if (right) {
    for (double at = std::ceil(from) - 1.0; at > (to < from ? to : to - 4.0); at -= 1.0)
      loop.push_back(corners[static_cast<std::size_t>(at + 8.0) % 4]);
    std::reverse(loop.begin(), loop.end());
  } else {
    for (double at = std::floor(from) + 1.0; at < (to > from ? to : to + 4.0); at += 1.0)
      loop.push_back(corners[static_cast<std::size_t>(at) % 4]);
  }
  return geometry::clean({loop});
}

Box2 grown(Box2 box, double by) { return {box.lo - Vec2{by, by}, box.hi + Vec2{by, by}}; }

void add(Box2& box, Vec2 p) {
  box.lo = {std::min(box.lo.x, p.x), std::min(box.lo.y, p.y)};
  box.hi = {std::max(box.hi.x, p.x), std::max(box.hi.y, p.y)};
}

Box2 bounds_of(const std::vector<Vec2>& line) {
  Box2 out;
  for (const Vec2 p : line) add(out, p);
  return out;
}

/// The box that the other features span: what every raw piece holds. What compounds and patterns hold is left
/// out: where it stands may itself rest on the piece.
std::optional<geometry::Box3> box_of_others(const Model& m) {
  geometry::Box3 out;
  Piece piece(m);
  for (const AnyRef f : m.all_below(TypeId::kMachiningFeature)) {
    const bool area =
        m.holds<PlanarFace>(f) || m.holds<Pocket>(f) || m.holds<Slot>(f) || m.holds<RoundHole>(f);
    if (!area || !holders(m, f).empty()) continue;
    const auto shapes = any(m, f, Within{{}, {}, 0, false, &piece});
    if (!shapes) continue;
    for (const FeatureShape& s : *shapes) {
      if (s.area.empty()) continue;
      const Box2 b = geometry::bounds(s.area);
      for (const Vec2 c : {b.lo, Vec2{b.hi.x, b.lo.y}, b.hi, Vec2{b.lo.x, b.hi.y}})
        out.add(s.frame.to_parent({c.x, c.y, 0.0}));
    }
  }
  if (out.empty()) return std::nullopt;
  return out;
}

/// What of a box in plan lies on the right of the line and on its left, mm2.
struct Sides {
  double right = 0.0, left = 0.0;
  [[nodiscard]] bool clear() const { return std::min(right, left) < kClearlySmaller * (right + left); }
};

Sides parted(const geometry::Box3& raw, const std::vector<Vec2>& line, const geometry::Placement& frame) {
  const Box2 plan = in_plan(raw, frame);
  Box2 all = bounds_of(line);
  add(all, plan.lo);
  add(all, plan.hi);
  const geometry::Region piece = geometry::rectangle(plan.lo, plan.hi);
  const auto on = [&](bool right) {
    return geometry::area(geometry::intersect(side_of(line, grown(all, 1.0), right), piece));
  };
  return {on(true), on(false)};
}

/// Beside an open line, on the side that the smaller part of the raw piece lies on.
Status beside_a_line(const Model& m, AnyRef self, const std::vector<Vec2>& line, FeatureShape& s) {
  if (line.size() < 2 || norm(line.back() - line.front()) < 1e-6)
    return unsupported(m, self, "its open profile has no length");
  const auto raw = stated_raw(m, self);
  const auto others = box_of_others(m);
  if (!raw && !others) {
    return unsupported(m, self,
                       "an outside profile that is not closed says its side by the raw piece, and none is "
                       "stated: state its bounding geometry, or close the profile");
  }
  Sides sides = parted(raw ? *raw : *others, line, s.frame);
  const bool by_raw = raw && (sides.clear() || !others);
  if (raw && !by_raw) sides = parted(*others, line, s.frame);
  const std::string what = by_raw ? "the raw piece" : "the box of the other features";
  if (!sides.clear()) {
    return unsupported(m, self,
                       "its open profile parts " + what + " into " + trimmed(sides.left, 0) + " and " +
                           trimmed(sides.right, 0) +
                           " mm2: which of them is taken away is not clear; close the profile");
  }
  const bool right = sides.right < sides.left;
  s.spine = line;
  if (!right) std::reverse(s.spine.begin(), s.spine.end());
  Box2 near = grown(bounds_of(line), kOpenReach);
  if (raw) {
    // Out to the edge of the raw piece where that is farther.
    const Box2 plan = in_plan(*raw, s.frame);
    Box2 both = near;
    add(both, plan.lo);
    add(both, plan.hi);
    const auto cut = geometry::intersect(side_of(s.spine, both, true), geometry::rectangle(plan.lo, plan.hi));
    if (!cut.empty()) {
      const Box2 b = geometry::bounds(cut);
      add(near, b.lo);
      add(near, b.hi);
    }
  }
  s.area = side_of(s.spine, near, true);
  s.reach = side_of(s.spine, grown(near, kOpenReach), true);
  s.assumptions.push_back("its open profile parts " + what + " in two: the smaller side, on the " +
                          std::string(right ? "right" : "left") +
                          " of the profile as drawn, is taken away, also straight on over its ends");
  return {};
}

/// What is cut around a contour that stays: as far as kOpenReach, and out to the edge of the raw piece that
/// the file states.
void stand_in_its_middle(const Model& m, AnyRef self, const geometry::Region& inner, FeatureShape& s) {
  s.islands.push_back({inner, 0.0, 0.0});
  s.area = geometry::offset_sharp(inner, kOpenReach);
  s.reach = geometry::subtract(geometry::offset_sharp(inner, 2.0 * kOpenReach), inner);
  const auto raw = stated_raw(m, self);
  if (!raw) return;
  const Box2 plan = in_plan(*raw, s.frame);
  const geometry::Region piece = geometry::rectangle(plan.lo, plan.hi);
  if (geometry::subtract(piece, s.area).empty()) return;
  s.area = geometry::unite(s.area, piece);
  s.reach = geometry::subtract(geometry::offset_sharp(s.area, kOpenReach), inner);
}

Result<Shapes> outside(const Model& m, AnyRef self, const ProfileFeature& f) {
  auto s = base(m, self, false);
  if (!s) return tl::unexpected(s.error());
  s->kind = ShapeKind::kOutside;
  s->open = true;
  const auto depth = depth_of(m, self);
  if (depth) {
    s->depth_mm = depth->depth_mm;
    s->depth_tolerance = depth->tolerance;
  } else if (const auto* swept = m.get<LinearPath>(f.profile_swept_shape)) {
    const auto distance = length(m, swept->distance);
    if (!distance) return tl::unexpected(distance.error());
    s->depth_mm = distance->nominal_mm;
    s->depth_tolerance = *distance;
  } else {
    return missing(m, self, "depth or profile_swept_shape", depth.error());
  }
  AnyRef profile;
  if (const auto* g = m.get<GeneralOutsideProfile>(self)) profile = g->feature_boundary;
  if (const auto* g = m.get<GeneralShapeProfile>(self)) profile = g->profile_boundary;
  if (const auto* g = m.get<CircularClosedShapeProfile>(self)) profile = g->closed_boundary;
  if (const auto* g = m.get<RectangularClosedShapeProfile>(self)) profile = g->closed_boundary;
  if (const auto* g = m.get<ShapeProfile>(self))
    s->through = m.holds<ThroughProfileFloor>(g->floor_condition);
  if (m.holds<OpenProfile>(profile)) {
    const auto line = open_line(m, Ref<OpenProfile>(profile));
    if (!line) return tl::unexpected(line.error());
    if (auto ok = beside_a_line(m, self, *line, *s); !ok) return tl::unexpected(ok.error());
    return Shapes{*s};
  }
  auto inner = closed_area(m, Ref<ClosedProfile>(profile), *s);
  if (!inner) return tl::unexpected(inner.error());
  stand_in_its_middle(m, self, *inner, *s);
  return Shapes{*s};
}

Result<Shapes> boss(const Model& m, AnyRef self, const Boss& f) {
  auto s = base(m, self, true);
  if (!s) return tl::unexpected(s.error());
  if (leans(f)) return leaning(m, self);
  s->kind = ShapeKind::kOutside;
  s->open = true;
  auto inner = closed_area(m, f.its_boundary, *s);
  if (!inner) return tl::unexpected(inner.error());
  stand_in_its_middle(m, self, *inner, *s);
  const auto foot = foot_of(m, self);
  if (!foot) return tl::unexpected(foot.error());
  s->islands.front().foot_radius_mm = foot->value_or(0.0);
  return Shapes{*s};
}

}  // namespace

std::vector<ShapeNoun> outsides_nouns() {
  return {
      shape_noun<ProfileFeature, outside>(),
      shape_noun<Boss, boss>(),
  };
}

}  // namespace capstan::model::shape
