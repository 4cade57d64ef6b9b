#include <algorithm>
#include <cmath>
#include <numbers>

#include "planner/model/nouns/all.h"
#include "planner/proof/verify/volumes/reading.h"

// Slots: a section, drawn exactly in (across, height above the floor), along an exact course.
//
// From the text of ISO 14649-10 (and ISO 10303-214, which says what the sizes of its profiles are): the width
// of a square U is that of its base, an angle is that between base and side; a rounded U is a half circle as
// wide as the slot and upright sides; the flanks of a vee touch the circle of its tip; a tee has its cross
// bar at the bottom. Left open are: how far an open end runs out, the floor before a Woodruff end, the
// corners of flat ends, the outer corner where a course has a kink, the flanks and corners of a tee's bar.

namespace capstan::verify::volumes {

using geometry::Placement;
using geometry::Vec2;
using geometry::Vec3;
using model::AnyRef;
using model::Model;

namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kSame = 1e-6;  ///< mm, rad

std::string polygon(Groove& g, const std::vector<Vec2>& corners) {
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vec2 a = corners[i], b = corners[(i + 1) % corners.size()];
    if (norm(b - a) > 1e-9) g.section.add(straight(a, b));
  }
  return g.section.edges.size() < 3 ? "its section has no area" : "";
}

/// How much a side leans inwards; upright where no angle is stated.
double lean_of(const model::Real& angle) {
  const double a = angle.value_or(0.0);
  return std::abs(a) < kSame || std::abs(a - 0.5 * kPi) < kSame ? 0.0 : 0.5 * kPi - a;
}

std::string square(const Model& m, const model::SquareUProfile& p, double deep, Groove& g) {
  const auto w = size_of(m, p.width);
  if (!w || !(*w > 0.0)) return "its square profile has no width";
  const double lean = lean_of(p.first_angle);
  if (std::abs(lean - lean_of(p.second_angle)) > kSame) return "which of its sides leans nobody says";
  if (std::abs(lean) > 1.4) return "the sides of its square profile lean too much";
  for (const AnyRef r : {AnyRef(p.first_radius), AnyRef(p.second_radius)}) {
    if (r.set()) g.foot_radius_mm = std::max(g.foot_radius_mm, size_of(m, r).value_or(0.0));
  }
  if (lean != 0.0 && g.foot_radius_mm > 0.0) return "its leaning sides have rounded feet";
  const double base = 0.5 * *w, mouth = base - deep * std::tan(lean);
  if (!(mouth > 0.0)) return "the sides of its square profile meet below its mouth";
  return polygon(g, {{-base, 0.0}, {base, 0.0}, {mouth, deep}, {-mouth, deep}});
}

std::string rounded_u(const Model& m, const model::RoundedUProfile& p, double deep, Groove& g) {
  const auto w = size_of(m, p.width);
  if (!w || !(*w > 0.0)) return "its rounded profile has no width";
  const double r = 0.5 * *w;
  const double half = deep < r ? std::acos((r - deep) / r) : 0.5 * kPi;
  const Edge arc = round({0.0, r}, r, -0.5 * kPi - half, 2.0 * half);
  g.section.add(arc);
  const double top = std::max(deep, 0.0);
  const Vec2 right{arc.to.x, top}, left{arc.from.x, top};
  if (norm(right - arc.to) > 1e-9) g.section.add(straight(arc.to, right));
  g.section.add(straight(right, left));
  if (norm(left - arc.from) > 1e-9) g.section.add(straight(left, arc.from));
  return {};
}

std::string vee(const Model& m, const model::VeeProfile& p, double deep, Groove& g) {
  const double angle = p.profile_angle.value_or(0.0), half = 0.5 * angle;
  if (!(angle > 0.0 && angle < kPi)) return "its vee profile has no angle between 0 and 180 degrees";
  const double tilt = p.tilt_angle.value_or(0.0);
  if (std::abs(tilt) > kSame && std::abs(tilt - half) > 1e-4 && std::abs(tilt - (0.5 * kPi - half)) > 1e-4)
    return "its vee profile is tilted, and to which side nobody says";
  const double r = p.profile_radius.set() ? size_of(m, p.profile_radius).value_or(-1.0) : 0.0;
  if (r < 0.0) return "the radius of its vee profile is no length";
  // The arc ends where the flank touches it: its radius there is square to the flank.
  const double turn = 0.5 * kPi - half;
  Vec2 tip{0.0, 0.0};
  if (r > 0.0) {
    const Edge arc = round({0.0, r}, r, -0.5 * kPi - turn, 2.0 * turn);
    g.section.add(arc);
    tip = arc.to;
  }
  if (!(deep > tip.y)) return "its vee profile is shallower than the circle of its tip";
  const Vec2 right{tip.x + (deep - tip.y) * std::tan(half), deep}, left{-right.x, deep};
  g.section.add(straight(tip, right));
  g.section.add(straight(right, left));
  g.section.add(straight(left, {-tip.x, tip.y}));
  return {};
}

std::string tee(const Model& m, const model::TeeProfile& p, double& deep, Groove& g) {
  const auto bar = size_of(m, p.cross_bar_width), high = size_of(m, p.cross_bar_depth),
             w = size_of(m, p.width);
  if (!bar || !high || !w || !(*bar > *w && *w > 0.0 && *high > 0.0))
    return "its tee profile has no bar that is wider than its neck";
  // A bar that does not fit above the depth lies below it: then the depth is that of the neck.
  if (*high >= deep - kSame) deep += *high;
  const double b = 0.5 * *bar, n = 0.5 * *w;
  const double corner = p.radius.set() ? size_of(m, p.radius).value_or(0.0) : 0.0;
  const bool leans = lean_of(p.first_angle) != 0.0 || lean_of(p.second_angle) != 0.0;
  if (leans || corner > 0.0) {
    g.unsaid_height_mm = *high + kSame;
    g.unsaid_half_mm = leans ? n : b - corner;
  }
  return polygon(
      g, {{-b, 0.0}, {b, 0.0}, {b, *high}, {n, *high}, {n, deep}, {-n, deep}, {-n, *high}, {-b, *high}});
}

/// The points of a polyline in whichever plane across the slot it is drawn.
std::vector<Vec2> drawn_points(const Model& m, const model::Polyline& line) {
  std::vector<Vec3> p;
  for (const AnyRef r : line.points.items) {
    const auto q = point_of(m, r);
    if (!q) return {};
    p.push_back(*q);
  }
  const auto level = [&](auto of) {
    return std::all_of(p.begin(), p.end(), [&](const Vec3& q) { return std::abs(of(q) - of(p[0])) < kSame; });
  };
  std::vector<Vec2> out;
  if (p.empty()) return out;
  const bool z = level([](const Vec3&q) { return q.z; }), y = level([](const Vec3&q) { return q.y; });
  const bool x = level([](const Vec3& q) { return q.x; });
  for (const Vec3& q : p) {
    if (z) {
      out.push_back({q.x, q.y});
    } else if (y) {
      out.push_back({q.x, q.z});
    } else if (x) {
      out.push_back({q.y, q.z});
    }
  }
  return out;
}

std::string drawn(const Model& m, const model::GeneralProfile& p, double deep, Groove& g) {
  Course c;
  if (const auto* line = m.get<model::Polyline>(p.its_profile)) {
    const auto points = drawn_points(m, *line);
    for (std::size_t i = 1; i < points.size(); ++i) {
      if (norm(points[i] - points[i - 1]) > 1e-9) c.edges.push_back(straight(points[i - 1], points[i]));
    }
  } else {
    c = edges_of(m, p.its_profile);
    if (!c.fault.empty()) return "its profile: " + c.fault;
  }
  if (c.edges.size() < 2) return "its profile has fewer than three points";
  const double mouth = c.edges.front().from.y;
  if (std::abs(c.edges.back().to.y - mouth) > 1e-3) return "its profile does not end at one height";
  Outline all;
  for (const Edge& e : c.edges) all.add(e);
  const bool down = mouth - all.lo.y >= all.hi.y - mouth;  // the floor lies below the mouth as it is drawn
  const double high = down ? mouth - all.lo.y : all.hi.y - mouth;
  if (high < deep - 1e-3) return "its profile is lower than the slot is deep";
  Placement turn;
  turn.origin = {0.0, down ? -all.lo.y : all.hi.y, 0.0};
  if (!down) turn = {turn.origin, {1.0, 0.0, 0.0}, {0.0, -1.0, 0.0}, {0.0, 0.0, -1.0}};
  c = moved(c, turn);
  if (!c.fault.empty()) return "its profile: " + c.fault;
  for (const Edge& e : c.edges) g.section.add(e);
  g.section.add(straight(c.edges.back().to, c.edges.front().from));
  constexpr int kLook = 24;
  for (int i = 1; i < kLook; ++i) {
    for (int k = 1; k < kLook; ++k) {
      const Vec2 q{g.section.hi.x * i / kLook, high * (k + 0.37) / (kLook + 1)};
      if (inside(g.section, q) != inside(g.section, {-q.x, q.y}) &&
          nearest(g.section, q).distance_mm > 0.01 && nearest(g.section, {-q.x, q.y}).distance_mm > 0.01)
        return "its profile is not the same on both sides, and which is left nobody says";
    }
  }
  return {};
}

std::string section(const Model& m, AnyRef r, Solid& solid, Groove& g) {
  const auto* profile = m.get<model::Profile>(r);
  if (profile == nullptr) return "it has no profile";
  if (profile->placement.set()) {
    // A profile may be drawn at the floor; one that stands beside the course, or lies down, is another slot.
    const auto at = frame_of(m, profile->placement);
    if (!at) return "its profile's placement is none";
    if (std::abs(at->x.z) > 0.5 &&
        m.holds<model::CircularPath>(m.get<model::Slot>(solid.noun)->course_of_travel))
      return "its profile stands upright on a circular course: a groove in a wall";
  }
  double deep = solid.depth_mm;
  std::string fault = "its profile is of a kind that this reading does not know";
  if (const auto* p = m.get<model::SquareUProfile>(r)) fault = square(m, *p, deep, g);
  if (const auto* p = m.get<model::RoundedUProfile>(r)) fault = rounded_u(m, *p, deep, g);
  if (const auto* p = m.get<model::VeeProfile>(r)) fault = vee(m, *p, deep, g);
  if (const auto* p = m.get<model::TeeProfile>(r)) fault = tee(m, *p, deep, g);
  if (const auto* p = m.get<model::GeneralProfile>(r)) fault = drawn(m, *p, deep, g);
  solid.depth_mm = deep;
  g.half_mm = std::max(std::abs(g.section.lo.x), std::abs(g.section.hi.x));
  return fault;
}

void end(const Model& m, AnyRef r, int i, Groove& g) {
  if (m.holds<model::OpenSlotEndType>(r)) g.ends[i] = Groove::End::kOpen;
  if (m.holds<model::RadiusedSlotEndType>(r)) g.ends[i] = Groove::End::kHalfRound;
  if (const auto* w = m.get<model::WoodruffSlotEndType>(r)) {
    g.ends[i] = Groove::End::kOpen;
    g.rising_mm[i] = std::max(size_of(m, w->radius).value_or(1e3), 1e-3);
  }
  if (const auto* f = m.get<model::FlatSlotEndType>(r)) {
    g.ends[i] = Groove::End::kFlat;
    for (const AnyRef c : {AnyRef(f->corner_radius1), AnyRef(f->corner_radius2)}) {
      if (c.set()) g.corner_mm[i] = std::max(g.corner_mm[i], size_of(m, c).value_or(0.0));
    }
  }
}

Reading groove_of(const Source& source, AnyRef self, Solid solid) {
  const Model& m = source.m;
  const auto* f = m.get<model::Slot>(self);
  if (f == nullptr) return unread("it is no slot");
  const Course course = line_of(m, f->course_of_travel);
  if (!course.fault.empty()) return unread("its course: " + course.fault);
  Groove g;
  for (const Edge& e : course.edges) g.course.add(e);
  g.loop = norm(course.edges.back().to - course.edges.front().from) < kJoin;
  if (const std::string why = section(m, f->swept_shape, solid, g); !why.empty()) return unread(why);
  for (std::size_t i = 0; i < 2 && i < f->end_conditions.size(); ++i)
    end(m, f->end_conditions[i], static_cast<int>(i), g);
  solid.form = std::move(g);
  Reading out;
  out.solids.push_back(std::move(solid));
  return out;
}

}  // namespace

std::vector<ReadingRow> grooves_readings() {
  return {
      {model::TypeId::kSlot, model::ShapeKind::kSlot, groove_of},
  };
}

}  // namespace capstan::verify::volumes
