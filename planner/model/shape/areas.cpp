#include <algorithm>
#include <cmath>
#include <numbers>

#include "planner/model/curve_points.h"
#include "planner/model/nouns/geometric_item.h"
#include "planner/model/nouns/support.h"
#include "planner/model/resolve.h"
#include "planner/model/shape/build.h"

// Faces, pockets, slots, steps and outsides.

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

/// A width that changes with the height: the same limits about another nominal size.
Toleranced as_wide(Toleranced t, double nominal_mm) {
  t.nominal_mm = nominal_mm;
  return t;
}

/// A square U. Its width is that of the base line; an angle is that between the base and a side (ISO
/// 10303-214, Square_u_profile): below 90 degrees the sides lean inwards, a dovetail. None, or 0: upright.
Result<std::vector<Vec2>> square_section(const Model& m, const SquareUProfile& q, FeatureShape& s) {
  const auto w = length(m, q.width);
  if (!w) return tl::unexpected(w.error());
  s.width = *w;
  if (q.first_radius.set()) {
    const auto r = length(m, q.first_radius);
    if (!r) return tl::unexpected(r.error());
    s.bottom_radius_mm = r->nominal_mm;
  }
  const auto leaning = [](double a) {
    const double right = std::numbers::pi / 2.0;
    return std::abs(a) < 1e-9 || std::abs(a - right) < 1e-6 ? 0.0 : right - a;
  };
  const double lean = leaning(q.first_angle.value_or(0.0));
  if (std::abs(lean - leaning(q.second_angle.value_or(0.0))) > 1e-6)
    return unsupported(m, s.feature, "its square profile is not symmetric: the angles of its sides differ");
  if (lean == 0.0) return std::vector<Vec2>{};
  if (!(std::abs(lean) < std::numbers::pi / 2.0))
    return unsupported(m, s.feature, "the sides of its square profile lean by 90 degrees or more");
  if (s.bottom_radius_mm > 0.0)
    return unsupported(m, s.feature, "leaning sides with rounded corners need a form cutter of their own");
  const double mouth = w->nominal_mm - 2.0 * s.depth_mm * std::tan(lean);
  if (!(mouth > 0.0))
    return unsupported(m, s.feature, "the sides of its square profile meet below its mouth");
  s.width = as_wide(*w, mouth);
  return std::vector<Vec2>{{0.0, 0.5 * w->nominal_mm}, {s.depth_mm, 0.5 * mouth}};
}

/// The two coordinates that a plane curve varies in: across the slot, and along its height.
std::vector<Vec2> in_its_plane(const std::vector<geometry::Vec3>& points) {
  geometry::Vec3 lo = points.front(), hi = points.front();
  for (const auto& p : points) {
    lo = {std::min(lo.x, p.x), std::min(lo.y, p.y), std::min(lo.z, p.z)};
    hi = {std::max(hi.x, p.x), std::max(hi.y, p.y), std::max(hi.z, p.z)};
  }
  std::vector<Vec2> out;
  for (const auto& p : points) {
    if (hi.z - lo.z < 1e-6) {
      out.push_back({p.x, p.y});
    } else if (hi.y - lo.y < 1e-6) {
      out.push_back({p.x, p.z});
    } else if (hi.x - lo.x < 1e-6) {
      out.push_back({p.y, p.z});
    } else {
      return {};
    }
  }
  return out;
}

/// (height, half width) of one half of a drawn section, from the floor's middle to the mouth: x is across,
/// and the curve's ends are the mouth, on whichever side of the floor they lie.
Result<std::vector<Vec2>> half_of(const Model& m, std::vector<Vec2> p, const FeatureShape& s) {
  constexpr double kSame = 1e-3;  // mm
  const auto refuse = [&](const std::string& why) {
    return unsupported(m, s.feature, "its general profile " + why);
  };
  if (std::abs(p.front().y - p.back().y) > kSame) return refuse("does not end at one height");
  const double mouth = p.front().y;
  double far = 0.0;
  for (const Vec2 q : p) far = std::abs(q.y - mouth) > std::abs(far) ? q.y - mouth : far;
  if (std::abs(far) < kSame) return refuse("has no depth");
  for (Vec2& q : p) q.y = std::abs(far) - (far < 0.0 ? mouth - q.y : q.y - mouth);
  if (p.front().x > p.back().x) std::reverse(p.begin(), p.end());
  const std::size_t n = p.size();
  for (std::size_t i = 0; i < n; ++i) {
    if (std::abs(p[i].x + p[n - 1 - i].x) > kSame || std::abs(p[i].y - p[n - 1 - i].y) > kSame)
      return refuse("is not symmetric about the slot's course");
  }
  std::vector<Vec2> out;
  for (std::size_t i = n / 2; i < n; ++i) {
    const Vec2 q{p[i].y, std::max(p[i].x, 0.0)};
    if (p[i].x < -kSame) return refuse("crosses the middle of the slot");
    if (!out.empty() && q.x < out.back().x - kSame) return refuse("goes down again beside its floor");
    if (!out.empty() && q.x - out.back().x < kSame && std::abs(q.y - out.back().y) < kSame) continue;
    // On a straight line with the two before it: one flank.
    if (out.size() > 1) {
      const Vec2 a = out[out.size() - 2], b = out.back();
      const double off = (b.x - a.x) * (q.y - a.y) - (b.y - a.y) * (q.x - a.x);
      if (std::abs(off) < kSame * norm(q - a)) out.pop_back();
    }
    out.push_back(q);
  }
  if (out.empty() || out.front().x > kSame) return refuse("has its deepest place beside the middle");
  for (Vec2& q : out) q.x = q.x < kSame ? 0.0 : q.x;
  // The floor runs from the middle: its last point is where the side begins.
  while (out.size() > 1 && out[1].x == 0.0) out.erase(out.begin());
  return out;
}

/// A section drawn as a polyline: square, vee, tee, dovetail, or one that rules refuse.
Result<std::vector<Vec2>> drawn_section(const Model& m, const GeneralProfile& g, FeatureShape& s) {
  const auto points = curve_points(m, g.its_profile, kAreaTolerance);
  if (!points) return tl::unexpected(points.error());
  if (points->size() < 3) return unsupported(m, s.feature, "its general profile has fewer than three points");
  auto plane = in_its_plane(*points);
  if (plane.empty())
    return unsupported(m, s.feature, "its general profile does not lie in a plane across the slot");
  auto half = half_of(m, std::move(plane), s);
  if (!half) return half;
  std::vector<Vec2> q = *std::move(half);
  constexpr double kSame = 1e-3;
  const double high = q.back().x;
  if (high < s.depth_mm - kSame)
    return unsupported(m, s.feature, "its general profile is lower than the slot is deep");
  // What is drawn above the slot's top is air.
  while (q.size() > 1 && q[q.size() - 2].x >= s.depth_mm - 1e-9) q.pop_back();
  if (q.back().x > s.depth_mm && q.size() > 1) {
    const Vec2 a = q[q.size() - 2], b = q.back();
    q.back() = {s.depth_mm, a.y + (b.y - a.y) * (s.depth_mm - a.x) / (b.x - a.x)};
  }
  if (q.size() < 2 || !(q.back().y > 0.0))
    return unsupported(m, s.feature, "its general profile has no mouth at the slot's top");
  s.width.nominal_mm = 2.0 * q.back().y;
  if (q.size() == 2 && std::abs(q[0].y - q[1].y) < kSame) return std::vector<Vec2>{};  // square
  if (q.size() == 2 && q[0].y < kSame) {
    s.slot_angle_rad = 2.0 * std::atan(q[1].y / q[1].x);
    q[0].y = 0.0;
  }
  return q;
}

/// (height above the bottom, half width) of the sections that are not square.
Result<std::vector<Vec2>> section_of(const Model& m, Ref<OpenProfile> profile, FeatureShape& s) {
  std::vector<Vec2> out;
  const int n = 16;  // samples of a rounded bottom
  if (const auto* u = m.get<RoundedUProfile>(profile)) {
    const auto w = length(m, u->width);
    if (!w) return tl::unexpected(w.error());
    s.width = *w;
    const double r = s.slot_bottom_radius_mm = 0.5 * w->nominal_mm;
    for (int i = 0; i <= n; ++i) {
      const double a = std::numbers::pi / 2.0 * i / n;
      out.push_back({r * (1.0 - std::cos(a)), r * std::sin(a)});
    }
    if (s.depth_mm > r) out.push_back({s.depth_mm, r});
    return out;
  }
  if (const auto* v = m.get<VeeProfile>(profile)) {
    const double angle = v->profile_angle.value_or(0.0);
    if (!(angle > 0.0 && angle < std::numbers::pi))
      return unsupported(m, s.feature, "its vee profile has no angle between 0 and 180 degrees");
    double r = 0.0;
    if (v->profile_radius.set()) {
      const auto tip = length(m, v->profile_radius);
      if (!tip) return tl::unexpected(tip.error());
      r = tip->nominal_mm;
    }
    s.slot_angle_rad = angle;
    s.slot_bottom_radius_mm = r;
    const double half = 0.5 * angle;
    // The tip's arc touches both flanks at angle (90 deg - half) from the lowest point.
    const double touch = std::numbers::pi / 2.0 - half;
    for (int i = 0; i <= (r > 0.0 ? n : 0); ++i) {
      const double a = touch * i / n;
      out.push_back({r * (1.0 - std::cos(a)), r * std::sin(a)});
    }
    const Vec2 last = out.back();
    if (s.depth_mm > last.x) out.push_back({s.depth_mm, last.y + (s.depth_mm - last.x) * std::tan(half)});
    s.width.nominal_mm = 2.0 * out.back().y;
    return out;
  }
  if (const auto* t = m.get<TeeProfile>(profile)) {
    const auto bar = length(m, t->cross_bar_width);
    const auto bar_depth = length(m, t->cross_bar_depth);
    const auto w = length(m, t->width);
    if (!bar) return missing(m, s.feature, "swept_shape's cross_bar_width", bar.error());
    if (!bar_depth) return missing(m, s.feature, "swept_shape's cross_bar_depth", bar_depth.error());
    if (!w) return missing(m, s.feature, "swept_shape's width", w.error());
    s.width = *w;
    return std::vector<Vec2>{{0.0, 0.5 * bar->nominal_mm},
                             {bar_depth->nominal_mm, 0.5 * bar->nominal_mm},
                             {bar_depth->nominal_mm, 0.5 * w->nominal_mm},
                             {s.depth_mm, 0.5 * w->nominal_mm}};
  }
  if (const auto* q = m.get<SquareUProfile>(profile)) return square_section(m, *q, s);
  if (const auto* g = m.get<GeneralProfile>(profile)) return drawn_section(m, *g, s);
  return unsupported(m, s.feature, "its swept shape is not a square, rounded, vee, tee or general profile");
}

}  // namespace

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
    // A stated corner radius rounds the concave corners of any boundary: opening by it.
    if (s->corner_radius_mm > 0.0 && !m.holds<RectangularClosedProfile>(c->feature_boundary)) {
      s->area = geometry::offset(geometry::offset(s->area, -s->corner_radius_mm), s->corner_radius_mm);
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
  if (auto ok = add_islands(m, f.its_boss, *s); !ok) return tl::unexpected(ok.error());
  // The mouth is passed in the sense of the loop: the outside lies on its right.
  s->reach = without_islands(*s, geometry::unite(s->area, beside(mouth, kOpenReach, !clockwise)));
  return Shapes{*s};
}

Result<Shapes> slot(const Model& m, AnyRef self, const Slot& f) {
  auto s = base(m, self, true);
  if (!s) return tl::unexpected(s.error());
  s->kind = ShapeKind::kSlot;
  const auto line = travel_line(m, f.course_of_travel, *s);
  if (!line) return tl::unexpected(line.error());
  if (line->size() < 2) return unsupported(m, self, "its course of travel has no length");
  s->spine = *line;
  auto section = section_of(m, f.swept_shape, *s);
  if (!section) return tl::unexpected(section.error());
  s->slot_profile = *std::move(section);
  const double half = 0.5 * s->width.nominal_mm;
  if (!(half > 0.0)) return unsupported(m, self, "its swept shape has no width");
  s->area = geometry::stroke(*line, half, false, kAreaTolerance);
  s->reach = s->area;
  if (geometry::norm(line->front() - line->back()) < 1e-6) return Shapes{*s};  // a closed course has no ends
  const auto end = [&](std::size_t i) -> const void* { return i < f.end_conditions.size() ? &f : nullptr; };
  for (const std::size_t i : {std::size_t{0}, std::size_t{1}}) {
    const std::size_t n = line->size();
    const Vec2 at = i == 0 ? line->front() : line->back();
    const Vec2 before = i == 0 ? (*line)[1] : (*line)[n - 2];
    const Vec2 out = (1.0 / norm(at - before)) * (at - before);
    // Without a stated end the slot stops at the path's end with a radius of half its width.
    const bool open = end(i) != nullptr && m.holds<OpenSlotEndType>(f.end_conditions[i]);
    const bool radiused = end(i) == nullptr || m.holds<RadiusedSlotEndType>(f.end_conditions[i]) ||
                          m.holds<LoopSlotEndType>(f.end_conditions[i]) ||
                          m.holds<WoodruffSlotEndType>(f.end_conditions[i]);
    if (open) {
      s->open = true;
      s->reach =
          geometry::unite(s->reach, geometry::stroke({at - 0.01 * out, at + kOpenReach * out}, half, false));
    } else if (radiused) {
      s->area = geometry::unite(s->area, geometry::disc(at, half, kAreaTolerance));
      s->reach = geometry::unite(s->reach, geometry::disc(at, half, kAreaTolerance));
      if (end(i) == nullptr) s->assumptions.push_back("an end condition is missing; taken as radiused");
    }
  }
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
  s->area = beside(*line, kOpenReach, true);
  const Vec2 d = (1.0 / norm(line->back() - line->front())) * (line->back() - line->front());
  const std::vector<Vec2> longer = {line->front() - kOpenReach * d, line->back() + kOpenReach * d};
  s->reach = beside(longer, 2.0 * kOpenReach, true);
  if (auto ok = add_islands(m, f.its_boss, *s); !ok) return tl::unexpected(ok.error());
  s->reach = without_islands(*s, s->reach);
  s->assumptions.push_back(
      "the step's volume lies on the right of its open_boundary, out to the edge of the raw piece");
  return Shapes{*s};
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
  if (!m.holds<ClosedProfile>(profile)) {
    return unsupported(m, self, "an outside profile that is not closed does not say which side is removed");
  }
  auto inner = closed_area(m, Ref<ClosedProfile>(profile), *s);
  if (!inner) return tl::unexpected(inner.error());
  const geometry::Region around = geometry::offset_sharp(*inner, kOpenReach);
  s->islands.push_back({*inner, 0.0});
  s->area = around;
  s->reach = without_islands(*s, geometry::offset_sharp(*inner, 2.0 * kOpenReach));
  return Shapes{*s};
}

Result<Shapes> boss(const Model& m, AnyRef self, const Boss& f) {
  auto s = base(m, self, true);
  if (!s) return tl::unexpected(s.error());
  s->kind = ShapeKind::kOutside;
  s->open = true;
  s->slope_rad = f.slope.value_or(0.0);
  auto inner = closed_area(m, f.its_boundary, *s);
  if (!inner) return tl::unexpected(inner.error());
  s->islands.push_back({*inner, 0.0});
  s->area = geometry::offset_sharp(*inner, kOpenReach);
  s->reach = without_islands(*s, geometry::offset_sharp(*inner, 2.0 * kOpenReach));
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

}  // namespace capstan::model::shape
