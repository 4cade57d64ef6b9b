#include <algorithm>
#include <cmath>
#include <numbers>

#include "planner/ground/base/number.h"
#include "planner/model/features/curve_points.h"
#include "planner/model/features/resolve.h"
#include "planner/model/features/shape/build.h"
#include "planner/model/nouns/geometric_item.h"
#include "planner/model/nouns/support.h"

// Slots: a section swept along a course.

namespace capstan::model::shape {

using geometry::Vec2;

namespace {

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

/// A tee: a wide bar at the bottom, below a neck. A slot whose bar does not fit above the depth that it
/// states, and whose course runs at that depth, states the depth of its neck (the standard's own example 2):
/// the bar lies below.
Result<std::vector<Vec2>> tee_section(const Model& m, const TeeProfile& t, double course_z, FeatureShape& s) {
  constexpr double kSame = 1e-6;  // mm
  const auto bar = length(m, t.cross_bar_width);
  const auto bar_depth = length(m, t.cross_bar_depth);
  const auto w = length(m, t.width);
  if (!bar) return missing(m, s.feature, "swept_shape's cross_bar_width", bar.error());
  if (!bar_depth) return missing(m, s.feature, "swept_shape's cross_bar_depth", bar_depth.error());
  if (!w) return missing(m, s.feature, "swept_shape's width", w.error());
  s.width = *w;
  const double high = bar_depth->nominal_mm;
  if (high >= s.depth_mm - kSame) {
    if (std::abs(course_z + s.depth_mm) > kSame || !(s.depth_mm > 0.0)) {
      return unsupported(m, s.feature,
                         "its cross bar of " + trimmed(high, 3) + " mm leaves no neck in a slot " +
                             trimmed(s.depth_mm, 3) + " mm deep");
    }
    s.assumptions.push_back("its cross bar of " + trimmed(high, 3) + " mm does not fit into a depth of " +
                            trimmed(s.depth_mm, 3) +
                            " mm, and its course runs at that depth: read as the depth of "
                            "its neck, the floor lies " +
                            trimmed(s.depth_mm + high, 3) + " mm deep");
    s.depth_mm += high;
  }
  if (t.radius.set()) {
    const auto r = length(m, t.radius);
    if (!r) return missing(m, s.feature, "swept_shape's radius", r.error());
    if (r->nominal_mm > kSame)
      s.assumptions.push_back("its tee profile's radius of " + trimmed(r->nominal_mm, 3) +
                              " mm stays as the corners of the cutter leave it");
  }
  // The offsets say again how far the bar stands out of the neck on either side.
  const double out = 0.5 * (bar->nominal_mm - w->nominal_mm);
  for (const auto& [name, ref] :
       {std::pair("first_offset", t.first_offset), std::pair("second_offset", t.second_offset)}) {
    if (!ref.set()) continue;
    const auto offset = length(m, ref);
    if (!offset) return missing(m, s.feature, std::string("swept_shape's ") + name, offset.error());
    if (std::abs(offset->nominal_mm - out) > 0.01)
      s.assumptions.push_back(std::string("its tee profile's ") + name + " of " +
                              trimmed(offset->nominal_mm, 3) + " mm is not what its widths give (" +
                              trimmed(out, 3) + " mm): the widths hold, the bar lies in the middle");
  }
  return std::vector<Vec2>{{0.0, 0.5 * bar->nominal_mm},
                           {high, 0.5 * bar->nominal_mm},
                           {high, 0.5 * w->nominal_mm},
                           {s.depth_mm, 0.5 * w->nominal_mm}};
}

/// (height above the bottom, half width) of the sections that are not square.
Result<std::vector<Vec2>> section_of(const Model& m, Ref<OpenProfile> profile, double course_z,
                                     FeatureShape& s) {
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
  if (const auto* t = m.get<TeeProfile>(profile)) return tee_section(m, *t, course_z, s);
  if (const auto* q = m.get<SquareUProfile>(profile)) return square_section(m, *q, s);
  if (const auto* g = m.get<GeneralProfile>(profile)) return drawn_section(m, *g, s);
  return unsupported(m, s.feature, "its swept shape is not a square, rounded, vee, tee or general profile");
}

/// A profile that stands upright, its width along the feature's axis, runs round in a wall: no slot that is
/// milled from above.
Status lies_down(const Model& m, const Slot& f, const FeatureShape& s) {
  constexpr double kUpright = 0.99;
  const auto* profile = m.get<SquareUProfile>(f.swept_shape);
  const auto* round = m.get<CircularPath>(f.course_of_travel);
  if (profile == nullptr || round == nullptr || !profile->placement.set()) return {};
  const auto frame = placement(m, profile->placement);
  if (!frame || std::abs(frame->x.z) < kUpright) return {};
  const auto width = length(m, profile->width);
  const auto radius = length(m, round->radius);
  const std::string size =
      (width ? trimmed(width->nominal_mm, 3) + " mm wide, " : std::string()) +
      (radius ? "its floor on a radius of " + trimmed(radius->nominal_mm, 3) + " mm" : "");
  return unsupported(
      m, s.feature,
      "its profile stands upright on a circular course: a groove in the wall of a bore, " + size +
          "; it needs a disc-shaped T-slot or grooving cutter no wider than the groove, let down in "
          "the bore and fed round at the groove's height, which is not planned: give the path, or "
          "turn it");
}

/// What stays in the two corners of a flat end: outside the mill of this radius that touches the end and a
/// side of the slot.
Result<geometry::Region> rounding(const Model& m, const FeatureShape& s, Vec2 at, Vec2 out, double radius) {
  const double half = 0.5 * s.width.nominal_mm;
  if (radius > half + 1e-6) {
    return unsupported(m, s.feature,
                       "its flat end states corners of radius " + trimmed(radius, 3) + " mm, and a slot " +
                           trimmed(2.0 * half, 3) + " mm wide has room for " + trimmed(half, 3) +
                           " mm: state that, or end it with a radius");
  }
  // A mill as wide as the slot would leave nothing of it but a line.
  const double r = std::min(radius, half - 5.0 * kAreaTolerance);
  // A straight slot is looked at as if it went on: the other end has corners of its own.
  const auto line = s.spine.size() == 2 ? std::vector<Vec2>{at - (3.0 * radius + half) * out, at} : s.spine;
  const auto drawn = geometry::stroke(line, half, false, kAreaTolerance);
  const auto left = geometry::subtract(drawn, geometry::offset(geometry::offset(drawn, -r), r));
  geometry::Region corners;
  for (const double side : {-half, half}) {
    const Vec2 corner{at.x - side * out.y, at.y + side * out.x};
    corners = geometry::unite(corners, geometry::disc(corner, 1.1 * radius, kAreaTolerance));
  }
  return geometry::intersect(left, corners);
}

}  // namespace

Result<FlatCorners> corners_of(const Model& m, const FlatSlotEndType& end, AnyRef feature) {
  double out[2] = {0.0, 0.0};
  for (const std::size_t i : {std::size_t{0}, std::size_t{1}}) {
    const auto radius = i == 0 ? end.corner_radius1 : end.corner_radius2;
    if (!radius.set()) continue;
    const auto r = length(m, radius);
    if (!r) return missing(m, feature, "corner radius of its flat end", r.error());
    if (r->nominal_mm < 0.0) return unsupported(m, feature, "its flat end has a corner of negative radius");
    out[i] = r->nominal_mm;
  }
  return FlatCorners{out[0], out[1]};
}

namespace {

Result<Shapes> slot(const Model& m, AnyRef self, const Slot& f) {
  auto s = base(m, self, true);
  if (!s) return tl::unexpected(s.error());
  s->kind = ShapeKind::kSlot;
  const auto line = travel_line(m, f.course_of_travel, *s);
  if (!line) return tl::unexpected(line.error());
  if (line->size() < 2) return unsupported(m, self, "its course of travel has no length");
  s->spine = *line;
  if (auto ok = lies_down(m, f, *s); !ok) return tl::unexpected(ok.error());
  const auto* course = m.get<TravelPath>(f.course_of_travel);
  const auto course_frame = placement_or_identity(m, course->placement);
  if (!course_frame) return tl::unexpected(course_frame.error());
  auto section = section_of(m, f.swept_shape, course_frame->origin.z, *s);
  if (!section) return tl::unexpected(section.error());
  s->slot_profile = *std::move(section);
  const double half = 0.5 * s->width.nominal_mm;
  if (!(half > 0.0)) return unsupported(m, self, "its swept shape has no width");
  s->area = geometry::stroke(*line, half, false, kAreaTolerance);
  s->reach = s->area;
  if (geometry::norm(line->front() - line->back()) < 1e-6) return Shapes{*s};  // a closed course has no ends
  double corner = 0.0;    // the smallest that is stated: it limits the mill
  double rounded = 0.0;   // along the course
  geometry::Region left;  // in the corners of flat ends
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
    } else if (const auto* flat = m.get<FlatSlotEndType>(f.end_conditions[i])) {
      const auto r = corners_of(m, *flat, self);
      if (!r) return tl::unexpected(r.error());
      // Two unequal ones: which stands on which side nothing says; `square_corner` refuses them where they
      // matter.
      if (!(r->same() && r->first > 0.0)) continue;
      const auto stays = rounding(m, *s, at, out, r->first);
      if (!stays) return tl::unexpected(stays.error());
      left = geometry::unite(left, *stays);
      rounded += r->first;
      corner = corner > 0.0 ? std::min(corner, r->first) : r->first;
    }
  }
  double travel = 0.0;
  for (std::size_t i = 1; i < line->size(); ++i) travel += norm((*line)[i] - (*line)[i - 1]);
  if (rounded > travel + 1e-6) {
    return unsupported(m, self,
                       "the corners of its flat ends take " + trimmed(rounded, 3) +
                           " mm of its course, which is " + trimmed(travel, 3) + " mm long");
  }
  if (!left.empty()) {
    s->area = geometry::subtract(s->area, left);
    s->reach = geometry::subtract(s->reach, left);
  }
  s->corner_radius_mm = corner;
  return Shapes{*s};
}

}  // namespace

std::vector<ShapeNoun> slots_nouns() {
  return {
      shape_noun<Slot, slot>(),
  };
}

}  // namespace capstan::model::shape
