#include <algorithm>
#include <cmath>
#include <numbers>

#include "planner/model/nouns/all.h"
#include "planner/proof/verify/volumes/reading.h"

// Faces, pockets, steps, outsides and bosses: an exact outline in the feature's plane, cut down to its depth.
//
// From the text of ISO 14649-10: profiles lie in the feature's local xy plane, in their own placement; a
// planar face without a boundary is its removal_boundary swept along its course; open_boundary and
// wall_boundary together close an open pocket; a step lies on the right of its open_boundary. Left open are:
// where a leaning wall stands between top and floor, how far out outsides and steps go, what lies past the
// ends of an open profile. Such places are undecided.

namespace capstan::verify::volumes {

using geometry::Placement;
using geometry::Vec2;
using geometry::Vec3;
using model::AnyRef;
using model::Model;

namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kUpright = 1e-6;  ///< rad: walls that lean less are upright
constexpr double kSteep = 1.4;     ///< rad: what leans more is no wall; default, unsourced
constexpr double kFar = 1e4;       ///< mm: beyond every raw piece; default, unsourced

struct Closed {
  Outline outline;
  std::string fault;
  double unsaid_mm = 0.0;  ///< so near to it all is undecided
};

Closed joined(const Course& c) {
  if (!c.fault.empty()) return {{}, c.fault};
  Closed out;
  for (const Edge& e : c.edges) out.outline.add(e);
  const Vec2 first = c.edges.front().from, last = c.edges.back().to;
  if (norm(last - first) > kJoin) out.outline.add(straight(last, first));
  return out;
}

Course polygon(const std::vector<Vec2>& corners) {
  Course out;
  for (std::size_t i = 0; i < corners.size(); ++i)
    out.edges.push_back(straight(corners[i], corners[(i + 1) % corners.size()]));
  return out;
}

/// A closed profile's edges, in its own system; the corner radius that it states for itself; how near to it
/// all is undecided.
Course profile_edges(const Model& m, AnyRef r, double& corner_mm, double& unsaid_mm) {
  if (const auto* p = m.get<model::RectangularClosedProfile>(r)) {
    const auto along = size_of(m, p->profile_length), across = size_of(m, p->profile_width);
    if (!along || !across || !(*along > 0.0 && *across > 0.0)) return {{}, 0.0, "a rectangle has no size"};
    if (p->corner_radius.set()) corner_mm = size_of(m, p->corner_radius).value_or(0.0);
    const double x = 0.5 * *along, y = 0.5 * *across;
    return polygon({{-x, -y}, {x, -y}, {x, y}, {-x, y}});
  }
  if (const auto* p = m.get<model::CircularClosedProfile>(r)) {
    const auto d = size_of(m, p->diameter);
    if (!d || !(*d > 0.0)) return {{}, 0.0, "a circle has no diameter"};
    return {{round({0.0, 0.0}, 0.5 * *d, 0.0, 2.0 * kPi)}, 0.0, ""};
  }
  if (const auto* p = m.get<model::NgonClosedProfile>(r)) {
    const auto d = size_of(m, p->diameter);
    const auto n = p->number_of_sides.value_or(0);
    if (!d || !(*d > 0.0) || n < 3 || n > 1000) return {{}, 0.0, "a polygon has no size, or no sides"};
    // ISO 14649 and ISO 10303 differ on how it is turned, and on whether the flag's truth means corners or
    // flats: between the polygons inside and about the circle it is undecided.
    if (p->corner_radius.set()) corner_mm = size_of(m, p->corner_radius).value_or(0.0);
    const double half = kPi / static_cast<double>(n);
    const double radius = 0.5 * *d / (p->circumscribed.value_or(false) ? std::cos(half) : 1.0);
    unsaid_mm = 0.5 * *d * (1.0 / std::cos(half) - std::cos(half));
    std::vector<Vec2> corners;
    for (std::int64_t i = 0; i < n; ++i) {
      const double a = 2.0 * half * static_cast<double>(i);
      corners.push_back({radius * std::cos(a), radius * std::sin(a)});
    }
    return polygon(corners);
  }
  if (const auto* p = m.get<model::GeneralClosedProfile>(r)) return edges_of(m, p->closed_profile_shape);
  return {{}, 0.0, "a closed profile is missing, or of a kind that this reading does not know"};
}

/// The outline of a closed profile in its feature's frame; `at`: the feature's placement as stated.
Closed outline_of(const Model& m, AnyRef r, double radius_mm, const Placement& at) {
  const auto* p = m.get<model::ClosedProfile>(r);
  if (p == nullptr) return {{}, "it has no closed profile"};
  auto frame = frame_or_same(m, p->placement);
  if (!frame) return {{}, "its profile's placement is none"};
  // Files repeat the feature's placement as the profile's; relative to the feature it would stand twice as
  // far.
  if (p->placement.set() && norm(at.origin) > 0.0 && norm(frame->origin - at.origin) < 1e-9)
    frame = Placement{};
  double corner = 0.0, unsaid = 0.0;
  const Course drawn = profile_edges(m, r, corner, unsaid);
  Closed out = joined(moved(drawn, *frame));
  if (!out.fault.empty()) return out;
  out.unsaid_mm = unsaid;
  if (!(std::abs(twice_area(out.outline)) > 1e-6)) return {{}, "its profile bounds no area"};
  double radius = radius_mm > 0.0 ? radius_mm : corner;
  // Nothing rounder fits into a rectangle than half circles at its ends.
  if (const auto* box = m.get<model::RectangularClosedProfile>(r))
    radius = std::min(radius, 0.5 * std::min(size_of(m, box->profile_length).value_or(0.0),
                                             size_of(m, box->profile_width).value_or(0.0)));
  if (!(radius > 0.0)) return out;
  Rounded arcs = rounded(out.outline, radius);
  return {std::move(arcs.outline), std::move(arcs.fault), unsaid};
}

std::optional<double> radius_of(const Model& m, AnyRef r) {
  if (!r.set()) return 0.0;
  const auto v = size_of(m, r);
  return v && *v >= 0.0 ? v : std::nullopt;
}

/// What stands in an area: the bosses that its feature lists, in its frame.
std::string stand(const Model& m, const model::RefList<model::Boss>& bosses, const Solid& in, Area& area) {
  const Placement& at = in.frame;
  for (const AnyRef r : bosses.items) {
    const auto* b = m.get<model::Boss>(r);
    const auto frame = b == nullptr ? std::nullopt : frame_or_same(m, b->feature_placement);
    if (!frame) return "a boss that it lists has no placement";
    const Placement rel = compose(inverse(at), *frame);
    if (rel.z.z < 1.0 - kUpright) return "a boss that it lists does not stand upright in it";
    Closed drawn = outline_of(m, b->its_boundary, 0.0, *frame);
    if (!drawn.fault.empty()) return "a boss that it lists: " + drawn.fault;
    const double open = drawn.unsaid_mm;
    Course c;
    c.edges = drawn.outline.edges;
    c = moved(c, rel);
    Standing s;
    s.boss = r;
    for (const Edge& e : c.edges) s.outline.add(e);
    s.top_mm = rel.origin.z;
    s.leaning_mm = open;
    const double lean = std::abs(b->slope.value_or(0.0));
    if (lean > kSteep) return "the walls of a boss that it lists lean too much";
    // Its contour is its top; its foot, on the floor, is wider.
    if (lean > kUpright) s.leaning_mm += std::max(0.0, s.top_mm + in.depth_mm) * std::tan(lean);
    s.foot_radius_mm =
        b->fillet_radius.set() ? radius_of(m, b->fillet_radius).value_or(0.0) : area.foot_radius_mm;
    area.standing.push_back(std::move(s));
  }
  return {};
}

Reading done(Solid solid, Area area) {
  solid.form = std::move(area);
  Reading out;
  out.solids.push_back(std::move(solid));
  return out;
}

Reading face(const Model& m, const model::PlanarFace& f, Solid solid) {
  Area area;
  area.overhead = true;
  if (f.face_boundary.set()) {
    Closed drawn = outline_of(m, f.face_boundary, 0.0, solid.frame);
    if (!drawn.fault.empty()) return unread(drawn.fault);
    area.outline = std::move(drawn.outline);
    area.leaning_mm = drawn.unsaid_mm;
  } else {
    const Course way = line_of(m, f.course_of_travel), across = line_of(m, f.removal_boundary);
    if (!way.fault.empty()) return unread("its course: " + way.fault);
    if (!across.fault.empty()) return unread("its removal_boundary: " + across.fault);
    const Vec2 from = way.edges.front().from;
    const Vec2 beside = across.edges.front().from;
    if (norm(beside) > 1e-9 && norm(beside - from) > 1e-9)
      return unread("its removal_boundary does not begin where its course does");
    const Vec2 t = way.edges.back().to - from, w = across.edges.back().to - beside;
    const Course c = polygon({from, from + w, from + w + t, from + t});
    for (const Edge& e : c.edges) area.outline.add(e);
    if (!(std::abs(twice_area(area.outline)) > 1e-6)) return unread("its boundary spans no area");
  }
  if (const std::string why = stand(m, f.its_boss, solid, area); !why.empty()) return unread(why);
  return done(std::move(solid), std::move(area));
}

Reading pocket(const Model& m, AnyRef self, const model::Pocket& f, Solid solid) {
  const auto foot = radius_of(m, f.planar_radius), corner = radius_of(m, f.orthogonal_radius);
  if (!foot || !corner) return unread("one of its radii is no length");
  solid.through = m.holds<model::ThroughPocketBottomCondition>(f.bottom_condition);
  if (!solid.through && f.bottom_condition.set() &&
      !m.holds<model::PlanarPocketBottomCondition>(f.bottom_condition))
    return unread("its bottom is not planar");
  const double slope = std::abs(f.slope.value_or(0.0));
  if (slope > kSteep) return unread("its walls lean too much");
  Area area;
  area.foot_radius_mm = *foot;
  if (slope > kUpright) area.leaning_mm = solid.depth_mm * std::tan(slope);
  if (const auto* c = m.get<model::ClosedPocket>(self)) {
    Closed drawn = outline_of(m, c->feature_boundary, *corner, solid.frame);
    if (!drawn.fault.empty()) return unread(drawn.fault);
    area.outline = std::move(drawn.outline);
    area.leaning_mm = std::max(area.leaning_mm, drawn.unsaid_mm);
  } else {
    const auto* o = m.get<model::OpenPocket>(self);
    const Course walls = line_of(m, o->open_boundary);
    if (!walls.fault.empty()) return unread("its open_boundary: " + walls.fault);
    for (const Edge& e : walls.edges) area.outline.add(e);
    const Vec2 first = walls.edges.front().from, last = walls.edges.back().to;
    Course mouth;
    mouth.edges = {straight(last, first)};
    if (o->wall_boundary.set()) {
      mouth = line_of(m, o->wall_boundary);
      if (!mouth.fault.empty()) return unread("its wall_boundary: " + mouth.fault);
      if (norm(mouth.edges.front().from - last) > norm(mouth.edges.back().to - last)) {
        std::reverse(mouth.edges.begin(), mouth.edges.end());
        for (Edge& e : mouth.edges) e = e.reversed();
      }
      if (norm(mouth.edges.front().from - last) > kJoin || norm(mouth.edges.back().to - first) > kJoin)
        return unread("its two boundaries do not close an area");
    }
    for (Edge& e : mouth.edges) {
      e.open = true;
      area.outline.add(e);
    }
    if (!(std::abs(twice_area(area.outline)) > 1e-6)) return unread("its boundaries bound no area");
    // Nobody says whether the radius rounds corners that are drawn sharp on purpose: those at the mouth stay.
    if (*corner > 0.0) {
      Rounded arcs = rounded(area.outline, *corner);
      if (!arcs.fault.empty()) return unread(arcs.fault);
      area.outline = std::move(arcs.outline);
    }
  }
  if (const std::string why = stand(m, f.its_boss, solid, area); !why.empty()) return unread(why);
  return done(std::move(solid), std::move(area));
}

Reading step(const Model& m, const model::Step& f, Solid solid) {
  const Course line = line_of(m, f.open_boundary);
  if (!line.fault.empty()) return unread("its open_boundary: " + line.fault);
  const Vec2 a = line.edges.front().from, b = line.edges.back().to;
  if (!(norm(b - a) > 1e-6)) return unread("its open_boundary has no length");
  const Vec2 d = (1.0 / norm(b - a)) * (b - a), right{d.y, -d.x};
  Area area;
  area.only_mm = kSaidBeside;
  const std::vector<Vec2> corners = {a, b, b + kFar * right, a + kFar * right};
  for (std::size_t i = 0; i < 4; ++i) {
    Edge e = straight(corners[i], corners[(i + 1) % 4]);
    e.open = i != 0;
    area.outline.add(e);
  }
  if (const auto* v = m.get<model::VeeProfile>(f.wall_boundary)) {
    const double lean = std::abs(v->profile_angle.value_or(0.5 * kPi) - 0.5 * kPi);
    if (lean > kSteep) return unread("its wall leans too much");
    if (lean > kUpright) area.leaning_mm = solid.depth_mm * std::tan(lean);
    const auto foot = radius_of(m, v->profile_radius);
    if (!foot) return unread("the radius of its wall is no length");
    area.foot_radius_mm = *foot;
  }
  if (const std::string why = stand(m, f.its_boss, solid, area); !why.empty()) return unread(why);
  return done(std::move(solid), std::move(area));
}

/// What an open line parts the raw piece into: the smaller part is taken away.
Reading beside(const Source& source, const Course& line, Solid solid) {
  const std::size_t n = line.edges.size();
  const Vec2 out0 = -1.0 * line.edges.front().along(0.0), out1 = line.edges[n - 1].along(1.0);
  const Vec2 first = line.edges.front().from + kFar * out0, last = line.edges[n - 1].to + kFar * out1;
  Outline right;
  const auto shut = [&](Vec2 from, Vec2 to) {
    Edge e = straight(from, to);
    e.open = true;
    right.add(e);
  };
  shut(first, line.edges.front().from);
  for (const Edge& e : line.edges) right.add(e);
  shut(line.edges[n - 1].to, last);
  // Clockwise round, far out, what lies on the right is enclosed.
  double a = std::atan2(last.y, last.x);
  const double b = std::atan2(first.y, first.x);
  double turn = a - b;
  turn -= 2.0 * kPi * std::floor(turn / (2.0 * kPi));
  Vec2 at = last;
  const double far = std::max(norm(first), norm(last));
  for (int i = 1; i < 8; ++i) {
    const double c = a - turn * i / 8.0;
    const Vec2 to{2.0 * far * std::cos(c), 2.0 * far * std::sin(c)};
    shut(at, to);
    at = to;
  }
  shut(at, first);
  const Placement in = inverse(solid.frame);
  constexpr int kGrid = 32;
  long on_right = 0, on_left = 0;
  const Vec3 size = source.raw.size();
  // Columns of the raw piece in plan: the feature looks along one of its sides, or each side is searched.
  Vec2 lo{1e300, 1e300}, hi{-1e300, -1e300};
  for (int i = 0; i < 8; ++i) {
    const Vec3 c = in.to_parent(source.raw.lo + Vec3{(i & 1) != 0 ? size.x : 0.0, (i & 2) != 0 ? size.y : 0.0,
                                                     (i & 4) != 0 ? size.z : 0.0});
    lo = {std::min(lo.x, c.x), std::min(lo.y, c.y)};
    hi = {std::max(hi.x, c.x), std::max(hi.y, c.y)};
  }
  for (int i = 0; i < kGrid; ++i) {
    for (int k = 0; k < kGrid; ++k) {
      const Vec2 p{lo.x + (hi.x - lo.x) * (i + 0.5) / kGrid, lo.y + (hi.y - lo.y) * (k + 0.5) / kGrid};
      ++(turns_around(right, p) != 0 ? on_right : on_left);
    }
  }
  constexpr double kNearlyHalf = 0.45;  // of the raw piece; default, unsourced
  if (static_cast<double>(std::min(on_right, on_left)) > kNearlyHalf * kGrid * kGrid)
    return unread("its open profile parts the raw piece into halves");
  Area area;
  area.outline = std::move(right);
  area.around = on_right > on_left;
  area.only_mm = kSaidBeside;
  return done(std::move(solid), std::move(area));
}

Reading around(const Model& m, AnyRef profile, Solid solid) {
  Closed drawn = outline_of(m, profile, 0.0, solid.frame);
  if (!drawn.fault.empty()) return unread(drawn.fault);
  Area area;
  area.outline = std::move(drawn.outline);
  area.leaning_mm = drawn.unsaid_mm;
  area.around = true;
  area.only_mm = kSaidBeside;
  return done(std::move(solid), std::move(area));
}

Reading outside(const Source& source, AnyRef self, Solid solid) {
  const Model& m = source.m;
  AnyRef profile;
  if (const auto* g = m.get<model::GeneralOutsideProfile>(self)) profile = g->feature_boundary;
  if (const auto* g = m.get<model::GeneralShapeProfile>(self)) profile = g->profile_boundary;
  if (const auto* g = m.get<model::CircularClosedShapeProfile>(self)) profile = g->closed_boundary;
  if (const auto* g = m.get<model::RectangularClosedShapeProfile>(self)) profile = g->closed_boundary;
  if (const auto* g = m.get<model::PartialCircularShapeProfile>(self)) profile = g->open_boundary;
  if (const auto* g = m.get<model::ShapeProfile>(self))
    solid.through = m.holds<model::ThroughProfileFloor>(g->floor_condition);
  if (m.holds<model::ClosedProfile>(profile)) return around(m, profile, std::move(solid));
  const Course line = line_of(m, profile);
  if (!line.fault.empty()) return unread("its profile: " + line.fault);
  if (norm(line.edges.back().to - line.edges.front().from) < kJoin)
    return unread("its open profile closes an area");
  return beside(source, line, std::move(solid));
}

}  // namespace

Course line_of(const Model& m, AnyRef r) {
  AnyRef at;
  if (const auto* p = m.get<model::Profile>(r)) at = p->placement;
  if (const auto* p = m.get<model::TravelPath>(r)) at = p->placement;
  const auto frame = frame_or_same(m, at);
  if (!frame) return {{}, 0.0, "its placement is none"};
  const auto line = [&](Vec3 a, Vec3 b) -> Course {
    a = frame->to_parent(a);
    b = frame->to_parent(b);
    if (std::abs(a.z - b.z) > 1e-6) return {{}, 0.0, "it leaves the feature's plane"};
    if (!(norm(b - a) > 1e-9)) return {{}, 0.0, "it has no length"};
    return {{straight(xy(a), xy(b))}, a.z, ""};
  };
  const auto arc = [&](std::optional<double> radius, double sweep) -> Course {
    if (!radius || !(*radius > 0.0) || !(std::abs(sweep) > 1e-9)) return {{}, 0.0, "it has no size"};
    const double most = std::clamp(sweep, -2.0 * kPi, 2.0 * kPi);
    return moved({{round({0.0, 0.0}, *radius, 0.0, most)}, 0.0, ""}, *frame);
  };
  if (const auto* l = m.get<model::LinearPath>(r)) {
    const auto length = size_of(m, l->distance);
    const auto d = unit_of(m, l->its_direction);
    if (!length || !d) return {{}, 0.0, "it has no length or no direction"};
    return line({}, *length * *d);
  }
  if (const auto* l = m.get<model::LinearProfile>(r)) {
    const auto length = number_of(m, l->profile_length);
    if (!length) return {{}, 0.0, "it has no length"};
    return line({}, {*length, 0.0, 0.0});
  }
  if (const auto* c = m.get<model::PartialCircularProfile>(r))
    return arc(size_of(m, c->radius), c->sweep_angle.value_or(0.0));
  if (const auto* c = m.get<model::PartialCircularPath>(r))
    return arc(size_of(m, c->radius), c->sweep_angle.value_or(0.0));
  if (const auto* c = m.get<model::CompleteCircularPath>(r)) return arc(size_of(m, c->radius), 2.0 * kPi);
  if (const auto* g = m.get<model::GeneralProfile>(r)) return moved(edges_of(m, g->its_profile), *frame);
  if (const auto* g = m.get<model::GeneralPath>(r)) return moved(edges_of(m, g->swept_path), *frame);
  return {{}, 0.0, "it is missing, or of a kind that this reading does not know"};
}

namespace {

Reading area_of(const Source& source, AnyRef self, Solid solid) {
  const Model& m = source.m;
  if (const auto* f = m.get<model::PlanarFace>(self)) return face(m, *f, std::move(solid));
  if (const auto* f = m.get<model::Pocket>(self)) return pocket(m, self, *f, std::move(solid));
  if (const auto* f = m.get<model::Step>(self)) return step(m, *f, std::move(solid));
  if (m.holds<model::ProfileFeature>(self)) return outside(source, self, std::move(solid));
  const auto* b = m.get<model::Boss>(self);
  if (b == nullptr) return unread("it is of a kind that this reading does not know");
  const double lean = std::abs(b->slope.value_or(0.0)), height = solid.depth_mm;
  if (lean > kSteep) return unread("its walls lean too much");
  const auto foot = radius_of(m, b->fillet_radius);
  if (!foot) return unread("its fillet_radius is no length");
  Reading out = around(m, b->its_boundary, std::move(solid));
  if (out.unread.empty()) std::get<Area>(out.solids.front().form).foot_radius_mm = *foot;
  if (lean > kUpright && out.unread.empty()) {
    double& open = std::get<Area>(out.solids.front().form).leaning_mm;
    open = std::max(open, height * std::tan(lean));
  }
  return out;
}

}  // namespace

std::vector<ReadingRow> areas_readings() {
  return {
      {model::TypeId::kPlanarFace, model::ShapeKind::kFace, area_of},
      {model::TypeId::kPocket, model::ShapeKind::kPocket, area_of},
      {model::TypeId::kStep, model::ShapeKind::kStep, area_of},
      {model::TypeId::kProfileFeature, model::ShapeKind::kOutside, area_of},
      {model::TypeId::kBoss, model::ShapeKind::kOutside, area_of},
  };
}

}  // namespace capstan::verify::volumes
