#include <algorithm>
#include <cmath>
#include <numbers>

#include "planner/model/features/curve_points.h"
#include "planner/model/features/raw_piece.h"
#include "planner/model/features/resolve.h"
#include "planner/model/features/shape/build.h"
#include "planner/model/nouns/geometric_item.h"
#include "planner/model/nouns/support.h"

// Faces, pockets, steps, caps and ends.

namespace capstan::model::shape {

using geometry::Vec2;

namespace {

/// A strip beside a line, on its right or left, as an area. Where the line turns away from that side, the
/// strip goes round the corner to where the outer lines of both pieces meet; round a turn sharper than a
/// right angle that far corner is cut off.
geometry::Region beside(const std::vector<Vec2>& line, double width, bool right) {
  const double side = right ? width : -width;
  const auto out_of = [&](std::size_t i) {  // of the piece after point i
    const Vec2 d = (1.0 / norm(line[i + 1] - line[i])) * (line[i + 1] - line[i]);
    return side * Vec2{d.y, -d.x};
  };
  std::vector<geometry::Loop> loops;
  const auto add = [&](geometry::Loop loop) {
    if (geometry::signed_area(loop) < 0.0) std::reverse(loop.begin(), loop.end());
    loops.push_back(std::move(loop));
  };
  for (std::size_t i = 0; i + 1 < line.size(); ++i) {
    const Vec2 out = out_of(i);
    add({line[i], line[i + 1], line[i + 1] + out, line[i] + out});
    if (i + 2 >= line.size()) break;
    const Vec2 next = out_of(i + 1);
    if (!(side * cross(out, next) > 0.0)) continue;
    const double along = std::max(0.0, dot(out, next)) / (width * width);
    add({line[i + 1], line[i + 1] + out, line[i + 1] + (1.0 / (1.0 + along)) * (out + next),
         line[i + 1] + next});
  }
  return geometry::clean(loops);
}

/// What a mill may run out into beyond a mouth: the strip beside it, and where a wall meets it at an acute
/// angle, as far as the wall would go on, so that the wall is made to its end. Both lines pass the mouth's
/// two ends.
geometry::Region before_mouth(const std::vector<Vec2>& walls, const std::vector<Vec2>& mouth, bool right) {
  const auto unit = [](Vec2 v) { return norm(v) > 0.0 ? (1.0 / norm(v)) * v : Vec2{}; };
  geometry::Region out = beside(mouth, kOpenReach, right);
  const std::size_t w = walls.size(), m = mouth.size();
  const auto flare = [&](Vec2 end, Vec2 wall, Vec2 inwards, Vec2 along) {
    const Vec2 square = right ? Vec2{along.y, -along.x} : Vec2{-along.y, along.x};
    const double sine = dot(wall, square);
    if (!(dot(wall, inwards) < -1e-6) || sine < kLeastMouthSine) return;
    geometry::Loop loop = {end, end + kOpenReach * square, end + (kOpenReach / sine) * wall};
    if (geometry::signed_area(loop) < 0.0) std::reverse(loop.begin(), loop.end());
    out = geometry::unite(out, geometry::clean({loop}));
  };
  const Vec2 first = unit(mouth[1] - mouth[0]), last = unit(mouth[m - 1] - mouth[m - 2]);
  flare(mouth[0], unit(walls[w - 1] - walls[w - 2]), first, first);
  flare(mouth[m - 1], unit(walls[0] - walls[1]), -1.0 * last, last);
  return out;
}

geometry::Region without_islands(const FeatureShape& s, geometry::Region r) {
  for (const Island& i : s.islands) r = geometry::subtract(r, i.area);
  return r;
}

Status fillets(const Model& m, const Pocket& f, FeatureShape& s) {
  if (f.orthogonal_radius.set()) {
    const auto r = length(m, f.orthogonal_radius);
    if (!r) return tl::unexpected(r.error());
    s.corner_radius_mm = r->nominal_mm;
  }
  if (f.planar_radius.set()) {
    const auto r = length(m, f.planar_radius);
    if (!r) return tl::unexpected(r.error());
    s.bottom_radius_mm = r->nominal_mm;
  }
  s.slope_rad = f.slope.value_or(0.0);
  if (!(s.corner_radius_mm >= 0.0 && s.bottom_radius_mm >= 0.0))
    return unsupported(m, s.feature, "has a negative radius");
  return {};
}

Result<Shapes> face(const Model& m, AnyRef self, const PlanarFace& f) {
  auto s = base(m, self, true);
  if (!s) return tl::unexpected(s.error());
  s->kind = ShapeKind::kFace;
  s->open = true;
  if (f.face_boundary.set()) {
    auto area = closed_area(m, f.face_boundary, *s);
    if (!area) return tl::unexpected(area.error());
    s->area = *std::move(area);
  } else {
    const auto line = travel_line(m, f.course_of_travel, *s);
    if (!line) return tl::unexpected(line.error());
    const auto across = open_line(m, f.removal_boundary);
    if (!across) return tl::unexpected(across.error());
    const Vec2 t = line->back() - line->front();
    const Vec2 w = across->back() - across->front();
    geometry::Loop loop = {line->front(), line->front() + w, line->front() + w + t, line->front() + t};
    if (geometry::signed_area(loop) < 0.0) std::reverse(loop.begin(), loop.end());
    if (!(std::abs(geometry::signed_area(loop)) > 0.0))
      return unsupported(m, self, "its boundary spans no area");
    s->area = geometry::clean({loop});
    s->width.nominal_mm = norm(w);
  }
  if (auto ok = add_islands(m, f.its_boss, *s); !ok) return tl::unexpected(ok.error());
  s->reach = without_islands(*s, geometry::offset_sharp(s->area, kOpenReach));
  return Shapes{*s};
}

Result<Shapes> pocket(const Model& m, AnyRef self, const Pocket& f) {
  auto s = base(m, self, true);
  if (!s) return tl::unexpected(s.error());
  s->kind = ShapeKind::kPocket;
  if (auto ok = fillets(m, f, *s); !ok) return tl::unexpected(ok.error());
  s->through = m.holds<ThroughPocketBottomCondition>(f.bottom_condition);
  if (m.holds<GeneralPocketBottomCondition>(f.bottom_condition) ||
      m.holds<RadiusedPocketBottomCondition>(f.bottom_condition)) {
    return unsupported(m, self, "a bottom that is not planar is not planned yet");
  }
  if (const auto* c = m.get<ClosedPocket>(self)) {
    auto area = closed_area(m, c->feature_boundary, *s);
    if (!area) return tl::unexpected(area.error());
    s->area = *std::move(area);
    // A stated corner radius rounds the inside corners of any boundary.
    if (s->corner_radius_mm > 0.0 && !m.holds<RectangularClosedProfile>(c->feature_boundary)) {
      auto rounded = rounded_corners(m, self, s->area, s->corner_radius_mm);
      if (!rounded) return tl::unexpected(rounded.error());
      s->area = *std::move(rounded);
    }
    if (auto ok = add_islands(m, f.its_boss, *s); !ok) return tl::unexpected(ok.error());
    s->reach = without_islands(*s, s->area);
    return Shapes{*s};
  }
  const auto* o = m.get<OpenPocket>(self);
  const auto walls = open_line(m, o->open_boundary);
  if (!walls) return tl::unexpected(walls.error());
  if (walls->size() < 2) return unsupported(m, self, "its open_boundary is a single point");
  geometry::Loop loop = *walls;
  std::vector<Vec2> mouth = {walls->back(), walls->front()};
  if (o->wall_boundary.set()) {
    auto line = open_line(m, o->wall_boundary);
    if (!line) return tl::unexpected(line.error());
    if (norm(line->front() - walls->back()) > norm(line->back() - walls->back()))
      std::reverse(line->begin(), line->end());
    mouth = *line;
    for (std::size_t i = 1; i + 1 < mouth.size(); ++i) loop.push_back(mouth[i]);
  }
  if (const auto at = crosses_itself(loop)) return crossed(m, self, "boundary", *at);
  const bool clockwise = geometry::signed_area(loop) < 0.0;
  if (clockwise) std::reverse(loop.begin(), loop.end());
  s->area = geometry::clean({loop});
  s->open = true;
  // A stated corner radius rounds the inside corners between walls; where a wall meets the mouth there is
  // none.
  if (s->corner_radius_mm > 0.0) {
    const auto beyond = geometry::unite(s->area, before_mouth(*walls, mouth, !clockwise));
    auto rounded = rounded_corners(m, self, beyond, s->corner_radius_mm);
    if (!rounded) return tl::unexpected(rounded.error());
    s->area = geometry::intersect(s->area, *rounded);
  }
  if (auto ok = add_islands(m, f.its_boss, *s); !ok) return tl::unexpected(ok.error());
  // The mouth is passed in the sense of the loop: the outside lies on its right.
  s->reach = without_islands(*s, geometry::unite(s->area, before_mouth(*walls, mouth, !clockwise)));
  return Shapes{*s};
}

Result<Shapes> step(const Model& m, AnyRef self, const Step& f) {
  auto s = base(m, self, true);
  if (!s) return tl::unexpected(s.error());
  s->kind = ShapeKind::kStep;
  s->open = true;
  const auto line = travel_line(m, f.open_boundary, *s);
  if (!line) return tl::unexpected(line.error());
  if (line->size() < 2) return unsupported(m, self, "its open_boundary has no length");
  if (f.wall_boundary.set()) {
    if (const auto* v = m.get<VeeProfile>(f.wall_boundary)) {
      const double angle = v->profile_angle.value_or(std::numbers::pi / 2.0);
      s->slope_rad = angle - std::numbers::pi / 2.0;
      if (v->profile_radius.set()) {
        const auto r = length(m, v->profile_radius);
        if (!r) return tl::unexpected(r.error());
        s->bottom_radius_mm = r->nominal_mm;
      }
    }
  }
  // The wall runs along the path; what is taken away lies on its right, out to the edge of the raw piece.
  s->spine = *line;
  const Vec2 d = (1.0 / norm(line->back() - line->front())) * (line->back() - line->front());
  double width = kOpenReach;
  if (const auto raw = stated_raw(m, self)) {
    const geometry::Box2 plan = in_plan(*raw, s->frame);
    for (const double x : {plan.lo.x, plan.hi.x}) {
      for (const double y : {plan.lo.y, plan.hi.y})
        width = std::max(width, dot(Vec2{x, y} - line->front(), Vec2{d.y, -d.x}));
    }
  }
  s->area = beside(*line, width, true);
  const std::vector<Vec2> longer = {line->front() - kOpenReach * d, line->back() + kOpenReach * d};
  s->reach = beside(longer, width + kOpenReach, true);
  if (auto ok = add_islands(m, f.its_boss, *s); !ok) return tl::unexpected(ok.error());
  s->reach = without_islands(*s, s->reach);
  s->assumptions.push_back(
      "the step's volume lies on the right of its open_boundary, out to the edge of the raw piece");
  return Shapes{*s};
}

Result<Shapes> spherical_cap(const Model& m, AnyRef self, const SphericalCap& f) {
  auto s = base(m, self, false);
  if (!s) return tl::unexpected(s.error());
  s->kind = ShapeKind::kSphericalCap;
  const auto* r = m.get<NumericParameter>(f.radius);
  if (r == nullptr || !r->its_parameter_value) return missing(m, self, "radius");
  s->sphere_radius_mm = *r->its_parameter_value;
  if (!(s->sphere_radius_mm > 0.0)) return unsupported(m, self, "has no radius above 0");
  s->area = s->reach = geometry::disc({0.0, 0.0}, s->sphere_radius_mm, kAreaTolerance);
  s->depth_mm = s->sphere_radius_mm;
  return Shapes{*s};
}

Result<Shapes> rounded_end(const Model& m, AnyRef self, const RoundedEnd& f) {
  auto s = base(m, self, true);
  if (!s) return tl::unexpected(s.error());
  s->kind = ShapeKind::kRoundedEnd;
  s->open = true;
  const auto line = open_line(m, f.partial_circular_boundary);
  if (!line) return tl::unexpected(line.error());
  s->spine = *line;
  return Shapes{*s};
}

Result<Shapes> toolpath(const Model& m, AnyRef self, const ToolpathFeature& /*f*/) {
  auto s = base(m, self, false);
  if (!s) return tl::unexpected(s.error());
  s->kind = ShapeKind::kToolpath;
  return Shapes{*s};
}

Result<Shapes> freeform(const Model& m, AnyRef self, const Region& f) {
  auto s = base(m, self, false);
  if (!s) return tl::unexpected(s.error());
  s->kind = ShapeKind::kFreeform;
  const auto frame = placement_or_identity(m, f.feature_placement);
  if (!frame) return tl::unexpected(frame.error());
  s->frame = *frame;
  return Shapes{*s};
}

}  // namespace

std::vector<ShapeNoun> areas_nouns() {
  return {
      shape_noun<PlanarFace, face>(),
      shape_noun<Pocket, pocket>(),
      shape_noun<Step, step>(),
      shape_noun<SphericalCap, spherical_cap>(),
      shape_noun<RoundedEnd, rounded_end>(),
      shape_noun<ToolpathFeature, toolpath>(),
      shape_noun<Region, freeform>(),
  };
}

}  // namespace capstan::model::shape
