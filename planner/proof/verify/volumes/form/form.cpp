#include "planner/proof/verify/volumes/form/form.h"

#include <algorithm>
#include <cmath>

#include "planner/model/nouns/all.h"
#include "planner/proof/verify/volumes/nouns.h"

// From exact solids to what heights and walls are judged by: arcs as chords for the areas (the floor itself
// is asked of the exact outlines, height.cpp), the section of a slot as half widths by height, and what the
// file allows each size.

namespace capstan::verify::volumes {

using geometry::Box3;
using geometry::Region;
using geometry::Vec2;
using geometry::Vec3;
using model::AnyRef;
using model::Model;
using model::ShapeKind;

namespace {

constexpr double kChord = 0.001;        ///< mm: chords of areas stray by no more from their arcs
constexpr double kSectionChord = 1e-4;  ///< mm: the same of a slot's section
constexpr double kUpright = 1e-6;       ///< rad

geometry::Loop points_of(const Outline& o, double chord) {
  geometry::Loop out;
  for (const Edge& e : o.edges) {
    if (out.empty() || norm(out.back() - e.from) > 1e-9) out.push_back(e.from);
    if (e.arc()) {
      geometry::append_arc(out, e.centre, e.from, e.sweep_rad, chord);
    } else if (norm(out.back() - e.to) > 1e-9) {
      out.push_back(e.to);
    }
  }
  return out;
}

Region region_of(const Outline& o) {
  geometry::Loop loop = points_of(o, kChord);
  if (loop.size() > 1 && norm(loop.front() - loop.back()) < 1e-9) loop.pop_back();
  if (loop.size() < 3) return {};
  if (geometry::signed_area(loop) < 0.0) std::reverse(loop.begin(), loop.end());
  return geometry::clean({loop});
}

/// What is drawn of an area that has no outer wall: the raw piece and its walls in plan, and some more.
Region drawn_within(const Outline& o, const Solid& s, const Box3& raw) {
  Vec2 lo{1e300, 1e300}, hi{-1e300, -1e300};
  const auto add = [&](Vec2 p) {
    lo = {std::min(lo.x, p.x), std::min(lo.y, p.y)};
    hi = {std::max(hi.x, p.x), std::max(hi.y, p.y)};
  };
  for (const Edge& e : o.edges) {
    if (e.open) continue;
    for (const double share : {0.0, 0.25, 0.5, 0.75, 1.0}) add(e.at(share));
  }
  if (!raw.empty()) {
    for (int i = 0; i < 8; ++i)
      add(xy(s.frame.to_local({(i & 1) != 0 ? raw.hi.x : raw.lo.x, (i & 2) != 0 ? raw.hi.y : raw.lo.y,
                               (i & 4) != 0 ? raw.hi.z : raw.lo.z})));
  }
  const Vec2 more{kDrawnBeyondMm, kDrawnBeyondMm};
  return geometry::rectangle(lo - more, hi + more);
}

/// What lies before the open edges of an area, seen from it.
Region before_open_edges(const Area& a, const Region& area) {
  Region out = area;
  const bool anticlockwise = twice_area(a.outline) > 0.0;
  for (const Edge& e : a.outline.edges) {
    if (!e.open || e.arc()) continue;
    const Vec2 along = e.along(0.5), right{along.y, -along.x};
    const Vec2 away = (anticlockwise ? kDrawnBeyondMm : -kDrawnBeyondMm) * right;
    geometry::Loop loop{e.from, e.from + away, e.to + away, e.to};
    if (geometry::signed_area(loop) < 0.0) std::reverse(loop.begin(), loop.end());
    out = geometry::unite(out, geometry::clean({loop}));
  }
  return out;
}

/// The widest that a section reaches from the middle at a height; its outline as chords.
double half_width(const geometry::Loop& section, double height) {
  double out = 0.0;
  for (std::size_t i = 0; i < section.size(); ++i) {
    const Vec2 a = section[i], b = section[(i + 1) % section.size()];
    if ((a.y <= height) == (b.y <= height)) continue;
    out = std::max(out, std::abs(a.x + (height - a.y) / (b.y - a.y) * (b.x - a.x)));
  }
  return out;
}

/// (height, half width) by rising height, jumps as two; up to the slot's top.
std::vector<Vec2> half_section_of(const Groove& g, double deep) {
  constexpr double kAside = 1e-6;
  const geometry::Loop section = points_of(g.section, kSectionChord);
  std::vector<double> heights{0.0, deep};
  for (const Vec2 p : section) {
    if (p.y > kAside && p.y < deep - kAside) heights.push_back(p.y);
  }
  std::sort(heights.begin(), heights.end());
  heights.erase(
      std::unique(heights.begin(), heights.end(), [](double a, double b) { return b - a < 2.0 * kAside; }),
      heights.end());
  std::vector<Vec2> out;
  for (const double h : heights) {
    for (const double at : {h - kAside, h + kAside}) {
      if (at < 0.0 || at > deep) continue;
      const Vec2 next{h, half_width(section, at)};
      if (!out.empty() && next.x == out.back().x && std::abs(next.y - out.back().y) < 1e-5) continue;
      out.push_back(next);
    }
  }
  return out;
}

bool same_width(const std::vector<Vec2>& half) {
  return std::all_of(half.begin(), half.end(), [&](Vec2 q) { return std::abs(q.y - half.front().y) < 1e-5; });
}

void area_form(const Source& source, const Area& a, Form& f) {
  const bool endless = a.around || a.only_mm > 0.0;
  const Region outline = region_of(a.outline);
  const bool closed =
      std::none_of(a.outline.edges.begin(), a.outline.edges.end(), [](const Edge& e) { return e.open; });
  if (!endless) {
    f.area = outline;
  } else {
    const Region all = drawn_within(a.outline, f.solid, source.raw);
    if (a.around && closed) {
      f.area = all;
      f.islands.push_back({outline, 0.0});
    } else {
      f.area = a.around ? geometry::subtract(all, outline) : geometry::intersect(all, outline);
    }
  }
  for (const Standing& s : a.standing) {
    Region stays = region_of(s.outline);
    if (s.leaning_mm > 0.0) stays = geometry::offset(stays, s.leaning_mm);
    f.islands.push_back({std::move(stays), s.top_mm});
  }
  if (f.kind == ShapeKind::kPocket && !closed) f.before_mouth = before_open_edges(a, f.area);
}

/// A flat end has its own radius in both corners; those of the other end may have another.
Region rounded_at(const Region& area, Vec2 end, double half, double radius) {
  if (!(radius > 0.0)) return area;
  constexpr double kMore = 0.01;  // mm: the corner piece ends where its radius touches the side
  const Region rounded = geometry::offset(geometry::offset(area, -radius, kChord), radius, kChord);
  const Region corners = geometry::disc(end, std::hypot(half, radius) + kMore, kChord);
  return geometry::subtract(area, geometry::intersect(geometry::subtract(area, rounded), corners));
}

void groove_form(const Groove& g, Form& f) {
  f.half_section = half_section_of(g, f.solid.depth_mm);
  const double half = f.half_section.back().y;
  if (same_width(f.half_section)) f.half_section.clear();
  for (const Vec2 p : points_of(g.course, kChord)) f.course.push_back(p);
  f.width.nominal_mm = 2.0 * half;
  if (!(half > 0.0) || f.course.size() < 2) return;
  f.area = geometry::stroke(f.course, half, false, kChord);
  for (const int end : {0, 1}) {
    if (g.corner_mm[end] > 0.0)
      f.corner_radius_mm =
          f.corner_radius_mm > 0.0 ? std::min(f.corner_radius_mm, g.corner_mm[end]) : g.corner_mm[end];
    if (g.loop) continue;
    const Vec2 at = end == 0 ? f.course.front() : f.course.back();
    if (g.ends[end] == Groove::End::kFlat) {
      f.area = rounded_at(f.area, at, half, g.corner_mm[end]);
      continue;
    }
    if (g.ends[end] == Groove::End::kOpen && !(g.rising_mm[end] > 0.0)) continue;
    f.area = geometry::unite(f.area, geometry::disc(at, half, kChord));
  }
}

/// The sizes across that a closed profile, or a path, states.
void sizes_of(const Model& m, AnyRef r, Form& f) {
  if (const auto* p = m.get<model::RectangularClosedProfile>(r)) {
    f.width = limits_of(m, p->profile_width);
    f.length = limits_of(m, p->profile_length);
  }
  if (const auto* p = m.get<model::CircularClosedProfile>(r)) f.width = f.length = limits_of(m, p->diameter);
  if (const auto* p = m.get<model::LinearPath>(r)) f.length = limits_of(m, p->distance);
}

Limits width_of(const Model& m, AnyRef section) {
  if (const auto* p = m.get<model::SquareUProfile>(section)) return limits_of(m, p->width);
  if (const auto* p = m.get<model::RoundedUProfile>(section)) return limits_of(m, p->width);
  if (const auto* p = m.get<model::TeeProfile>(section)) return limits_of(m, p->width);
  return {};
}

/// The hole that a thread is in, what an edge is on; of anything else itself.
AnyRef bearer_of(const Model& m, AnyRef noun) {
  if (const auto* t = m.get<model::TransitionFeature>(noun)) return t->first_feature;
  const auto* t = m.get<model::Thread>(noun);
  return t == nullptr || t->applied_shape.empty() ? noun : AnyRef(t->applied_shape[0]);
}

double lean_of(double rad) { return std::abs(rad) > kUpright ? std::abs(rad) : 0.0; }

/// What the noun says of tolerances, radii and walls.
void stated_of(const Model& m, Form& f) {
  const AnyRef noun = bearer_of(m, f.solid.noun);
  // How deep an edge is broken is not how deep the feature is.
  const auto* machined = m.get<model::MachiningFeature>(noun);
  if (machined != nullptr && f.bevel() == nullptr) f.depth = limits_of(m, machined->depth);
  if (const auto* h = m.get<model::RoundHole>(noun)) f.diameter = limits_of(m, h->diameter);
  if (const auto* p = m.get<model::Pocket>(noun)) {
    f.corner_stated = p->orthogonal_radius.set();
    f.corner_radius_mm = size_of(m, p->orthogonal_radius).value_or(0.0);
    f.slope_rad = lean_of(p->slope.value_or(0.0));
  }
  if (const auto* p = m.get<model::ClosedPocket>(noun)) sizes_of(m, p->feature_boundary, f);
  if (const auto* p = m.get<model::PlanarFace>(noun)) {
    sizes_of(m, p->course_of_travel, f);
    sizes_of(m, p->face_boundary, f);
  }
  if (const auto* s = m.get<model::Step>(noun)) {
    sizes_of(m, s->open_boundary, f);
    const auto* wall = m.get<model::VeeProfile>(s->wall_boundary);
    constexpr double kRight = 1.5707963267948966;
    if (wall != nullptr) f.slope_rad = lean_of(wall->profile_angle.value_or(kRight) - kRight);
  }
  if (const auto* s = m.get<model::Slot>(noun)) {
    const double mouth = f.width.nominal_mm;
    f.width = width_of(m, s->swept_shape);
    f.width.nominal_mm = mouth;
    sizes_of(m, s->course_of_travel, f);
  }
  if (const auto* p = m.get<model::ProfileFeature>(noun)) {
    const auto* way = m.get<model::LinearPath>(p->profile_swept_shape);
    if (way != nullptr && f.bevel() == nullptr && !p->depth.set()) f.depth = limits_of(m, way->distance);
  }
  if (const auto* p = m.get<model::GeneralOutsideProfile>(noun)) sizes_of(m, p->feature_boundary, f);
  if (const auto* p = m.get<model::GeneralShapeProfile>(noun)) sizes_of(m, p->profile_boundary, f);
  if (const auto* p = m.get<model::CircularClosedShapeProfile>(noun)) sizes_of(m, p->closed_boundary, f);
  if (const auto* p = m.get<model::RectangularClosedShapeProfile>(noun)) sizes_of(m, p->closed_boundary, f);
  if (const auto* p = m.get<model::Boss>(noun)) sizes_of(m, p->its_boundary, f);
}

ShapeKind kind_of(const Model& m, AnyRef noun) {
  if (m.holds<model::Thread>(noun)) return ShapeKind::kThread;
  if (m.holds<model::Chamfer>(noun)) return ShapeKind::kChamfer;
  if (m.holds<model::EdgeRound>(noun)) return ShapeKind::kEdgeRound;
  if (m.holds<model::ToolpathFeature>(noun)) return ShapeKind::kToolpath;
  if (const ReadingRow* row = reading_of(noun)) return row->kind;
  return ShapeKind::kFreeform;
}

/// How far the point of a conical bottom reaches below the depth.
double tip_of(const Model& m, const Solid& s, const Bore& b) {
  if (b.bottom != Bore::Bottom::kCone) return 0.0;
  if (b.tip_mm > 0.0) return b.tip_mm;
  const auto* h = m.get<model::RoundHole>(bearer_of(m, s.noun));
  const auto* c = h == nullptr ? nullptr : m.get<model::ConicalHoleBottom>(h->bottom_condition);
  const double angle = c == nullptr ? 0.0 : c->tip_angle.value_or(0.0);
  return angle > 0.0 ? b.bottom_radius_mm / std::tan(0.5 * angle) : 0.0;
}

Form form_of(const Source& source, AnyRef feature, Solid solid) {
  Form f;
  f.feature = feature;
  f.solid = std::move(solid);
  f.kind = kind_of(source.m, f.solid.noun);
  if (const auto* a = std::get_if<Area>(&f.solid.form)) area_form(source, *a, f);
  if (const auto* g = std::get_if<Groove>(&f.solid.form)) groove_form(*g, f);
  if (const auto* b = f.bore()) {
    f.area = geometry::disc({0.0, 0.0}, b->top_radius_mm, kChord);
    f.tip_mm = tip_of(source.m, f.solid, *b);
  }
  if (const auto* b = f.bevel()) {
    f.area = region_of(b->outline);
    if (b->within) f.area = geometry::subtract(drawn_within(b->outline, f.solid, source.raw), f.area);
  }
  stated_of(source.m, f);
  return f;
}

std::string name_of(const Model& m, AnyRef feature) {
  const auto* named = m.get<model::ManufacturingFeature>(feature);
  return named == nullptr ? "" : named->its_id.value_or("");
}

}  // namespace

double Form::foot_radius_mm() const {
  if (const auto* a = std::get_if<Area>(&solid.form)) return a->foot_radius_mm;
  if (const auto* g = std::get_if<Groove>(&solid.form)) return g->foot_radius_mm;
  return 0.0;
}

bool Form::open() const {
  if (const auto* g = std::get_if<Groove>(&solid.form))
    return g->ends[0] == Groove::End::kOpen || g->ends[1] == Groove::End::kOpen;
  const auto* a = std::get_if<Area>(&solid.form);
  return a != nullptr && (a->around || a->overhead ||
                          std::any_of(a->outline.edges.begin(), a->outline.edges.end(),
                                      [](const Edge& e) { return e.open; }));
}

std::vector<Form> forms_of(const Source& source, AnyRef feature, const Reading& reading) {
  std::vector<Form> out;
  if (!reading.unread.empty()) return out;
  const std::string name = name_of(source.m, feature);
  for (const Solid& s : reading.solids) {
    out.push_back(form_of(source, feature, s));
    out.back().name = name.empty() ? name_of(source.m, s.noun) : name;
  }
  for (std::size_t i = 0; out.size() > 1 && i < out.size(); ++i)
    out[i].name += "[" + std::to_string(i + 1) + "]";
  if (!out.empty() || !reading.nothing) return out;
  Form f;
  f.feature = f.solid.noun = feature;
  f.name = name;
  f.kind = kind_of(source.m, feature);
  if (const auto* placed = source.m.get<model::Two5dManufacturingFeature>(feature))
    f.solid.frame = frame_or_same(source.m, placed->feature_placement).value_or(geometry::Placement{});
  out.push_back(std::move(f));
  return out;
}

std::vector<Form> broken_edges(const Form& f, double depth_mm, double width_mm) {
  std::vector<std::pair<Outline, bool>> edges;  // and whether the material lies within
  if (const auto* b = f.bore()) {
    constexpr double kFull = 6.283185307179586;
    Outline circle;
    circle.add(round({0.0, 0.0}, b->top_radius_mm + 0.5 * f.diameter.upper_mm, 0.0, kFull));
    edges.emplace_back(std::move(circle), false);
  }
  if (const auto* a = std::get_if<Area>(&f.solid.form)) {
    edges.emplace_back(a->outline, a->around);
    for (const Standing& s : a->standing) edges.emplace_back(s.outline, true);
  }
  std::vector<Form> out;
  for (auto& [outline, within] : edges) {
    Form e;
    e.feature = f.feature;
    e.kind = ShapeKind::kChamfer;
    e.name = f.name;
    e.solid.noun = f.solid.noun;
    e.solid.frame = f.solid.frame;
    e.solid.depth_mm = depth_mm;
    e.area = within ? geometry::subtract(f.area, region_of(outline)) : region_of(outline);
    Bevel b;
    b.outline = std::move(outline);
    b.within = within;
    b.width_mm = b.other_width_mm = width_mm;
    b.depth_mm = b.other_depth_mm = depth_mm;
    e.solid.form = std::move(b);
    out.push_back(std::move(e));
  }
  return out;
}

}  // namespace capstan::verify::volumes
