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

/// A strip beside a line, on its right or left, as an area.
geometry::Region beside(const std::vector<Vec2>& line, double width, bool right) {
  geometry::Loop loop(line.begin(), line.end());
  const double side = right ? 1.0 : -1.0;
  for (std::size_t i = line.size(); i-- > 0;) {
    const Vec2 a = line[i == 0 ? 0 : i - 1];
    const Vec2 b = line[i == 0 ? 1 : i];
    const Vec2 d = (1.0 / norm(b - a)) * (b - a);
    loop.push_back(line[i] + (side * width) * Vec2{d.y, -d.x});
  }
  if (geometry::signed_area(loop) < 0.0) std::reverse(loop.begin(), loop.end());
  return geometry::clean({loop});
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
    const auto beyond = geometry::unite(s->area, beside(mouth, kOpenReach, !clockwise));
    auto rounded = rounded_corners(m, self, beyond, s->corner_radius_mm);
    if (!rounded) return tl::unexpected(rounded.error());
    s->area = geometry::intersect(s->area, *rounded);
  }
  if (auto ok = add_islands(m, f.its_boss, *s); !ok) return tl::unexpected(ok.error());
  // The mouth is passed in the sense of the loop: the outside lies on its right.
  s->reach = without_islands(*s, geometry::unite(s->area, beside(mouth, kOpenReach, !clockwise)));
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
