#include "planner/proof/verify/volumes/solid.h"

#include "planner/ground/base/stopping.h"

#include <algorithm>
#include <cmath>

// Solids by section and depth: a place lies in a solid when the section of the feature at the height of the
// place holds it. Whether a section holds a place follows from the distance to an exact outline.

namespace capstan::verify::volumes {

using geometry::Box3;
using geometry::Vec2;
using geometry::Vec3;

namespace {

constexpr double kHair = 1e-9;

/// How far a quarter round of this radius stands out of a wall at a height above the floor.
double fillet(double radius, double height) {
  if (!(height < radius)) return 0.0;
  const double up = radius - std::max(height, 0.0);
  return radius - std::sqrt(std::max(0.0, radius * radius - up * up));
}

/// Whether the nearest place of an outline's walls is where they end in the open.
bool past_the_end(const Outline& o, const Near& n, Vec2 q) {
  const Edge& e = o.edges[n.edge];
  if (n.share > 0.0 && n.share < 1.0) return false;
  const std::size_t size = o.edges.size();
  const Edge& next = o.edges[n.share <= 0.0 ? (n.edge + size - 1) % size : (n.edge + 1) % size];
  return next.open && std::abs(dot(e.along(n.share), q - e.at(n.share))) > 1e-6;
}

PointState in_area(const Area& a, const Solid& s, Vec3 p) {
  const Vec2 q = xy(p);
  const double height = p.z + s.depth_mm;
  if (height < -kHair && !s.through) return PointState::kStays;
  if (q.x < a.outline.lo.x - kSaidBeside || q.x > a.outline.hi.x + kSaidBeside ||
      q.y < a.outline.lo.y - kSaidBeside || q.y > a.outline.hi.y + kSaidBeside)
    return a.around ? PointState::kNotStated : PointState::kStays;
  const bool taken = inside(a.outline, q) != a.around;
  const bool radiused = a.foot_radius_mm > 0.0 && height < a.foot_radius_mm;
  if (!taken && !(a.leaning_mm > 0.0 || a.only_mm > 0.0)) return PointState::kStays;
  if (a.leaning_mm > 0.0 || a.only_mm > 0.0 || radiused) {
    const Near near = nearest(a.outline, q, true);
    if (a.only_mm > 0.0 && (near.distance_mm > a.only_mm || past_the_end(a.outline, near, q)))
      return taken ? PointState::kNotStated : a.around ? PointState::kNotStated : PointState::kStays;
    if (a.leaning_mm > 0.0 && near.distance_mm < a.leaning_mm) return PointState::kNotStated;
    if (!taken) return PointState::kStays;
    if (radiused && mitred(a.outline, q, true) < fillet(a.foot_radius_mm, height)) return PointState::kStays;
  }
  for (const Standing& b : a.standing) {
    if (p.z > b.top_mm) continue;
    if (inside(b.outline, q)) return PointState::kStays;
    const double open = std::max(b.leaning_mm, height < b.foot_radius_mm ? b.foot_radius_mm : 0.0);
    if (open > 0.0 && mitred(b.outline, q) < open) return PointState::kNotStated;
  }
  if (p.z > 0.0) return a.overhead ? PointState::kNotStated : PointState::kStays;
  return PointState::kRemoved;
}

PointState in_bore(const Bore& b, const Solid& s, Vec3 p) {
  const double r = std::hypot(p.x, p.y);
  const double below = -p.z - s.depth_mm;
  if (below <= 0.0) {
    const double share = s.depth_mm > 0.0 ? std::clamp(-p.z / s.depth_mm, 0.0, 1.0) : 0.0;
    const double wide = b.top_radius_mm + share * (b.bottom_radius_mm - b.top_radius_mm);
    if (r > wide || p.z > 0.0) return PointState::kStays;
    if (b.bottom == Bore::Bottom::kRounded && r > wide - fillet(b.radius_mm, -below))
      return PointState::kStays;
    if (b.bottom == Bore::Bottom::kBall) {
      // Whether the depth is that of the ball's lowest place or of its middle plane nobody says.
      const double up = b.radius_mm + below;  // of the lowest place's centre above p
      if (up > 0.0 && r * r + up * up > b.radius_mm * b.radius_mm) return PointState::kNotStated;
    }
    return PointState::kRemoved;
  }
  if (r > b.bottom_radius_mm) return PointState::kStays;
  switch (b.bottom) {
    case Bore::Bottom::kThrough:
      return PointState::kRemoved;
    case Bore::Bottom::kCone: {
      if (!(b.tip_mm > 0.0))
        return below < 4.0 * b.bottom_radius_mm ? PointState::kNotStated : PointState::kStays;
      if (r < b.blunt_mm && below < b.tip_mm) return PointState::kNotStated;
      return below < b.tip_mm * (1.0 - r / b.bottom_radius_mm) ? PointState::kRemoved : PointState::kStays;
    }
    case Bore::Bottom::kBall:
      return below < b.radius_mm ? PointState::kNotStated : PointState::kStays;
    default:
      return PointState::kStays;
  }
}

PointState in_groove(const Groove& g, const Solid& s, Vec3 p) {
  const double height = p.z + s.depth_mm;
  if (height < 0.0 || p.z > 0.0) return PointState::kStays;
  const Vec2 q = xy(p);
  const double far = g.half_mm + 1.0;
  if (q.x < g.course.lo.x - far || q.x > g.course.hi.x + far || q.y < g.course.lo.y - far ||
      q.y > g.course.hi.y + far)
    return PointState::kStays;
  const Near near = nearest(g.course, q);
  if (near.distance_mm > g.half_mm) return PointState::kStays;
  // Also round an end that is half round.
  if (g.foot_radius_mm > 0.0 && height < g.foot_radius_mm && g.half_mm - near.distance_mm < g.foot_radius_mm)
    return PointState::kNotStated;
  const std::size_t last = g.course.edges.size() - 1;
  const Edge& e = g.course.edges[near.edge];
  const Vec2 along = e.along(near.share);
  const Vec2 off = q - e.at(near.share);
  const double side = cross(along, off);
  const double across = side >= 0.0 ? near.distance_mm : -near.distance_mm;
  const bool held = inside(g.section, {across, height});
  const double beyond = dot(along, off);
  for (const int end : {0, 1}) {
    if (g.loop) break;
    if (near.edge != (end == 0 ? 0 : last)) continue;
    const double share = end == 0 ? near.share : 1.0 - near.share;
    const double past = end == 0 ? -beyond : beyond;
    const double way = share * e.length();  // before the end
    if (share <= 0.0 && past > kHair) {
      if (g.rising_mm[end] > 0.0) return PointState::kNotStated;
      switch (g.ends[end]) {
        case Groove::End::kFlat:
          return PointState::kStays;
        case Groove::End::kHalfRound:
          // A profile that is not the same on both sides has no half round that is said.
          return inside(g.section, {-across, height}) == held
                     ? (held ? PointState::kRemoved : PointState::kStays)
                     : PointState::kNotStated;
        default:
          return PointState::kNotStated;
      }
    }
    if (way < g.rising_mm[end]) return PointState::kNotStated;
    if (way < g.corner_mm[end] && g.half_mm - near.distance_mm < g.corner_mm[end])
      return PointState::kNotStated;
  }
  // In the outer corner of a course with a kink nobody says whether the slot is round or sharp.
  const bool at_vertex = (near.share <= 0.0 || near.share >= 1.0) && std::abs(beyond) > 1e-6;
  if (at_vertex && !held) return PointState::kStays;
  if (at_vertex) return PointState::kNotStated;
  if (height < g.unsaid_height_mm && near.distance_mm > g.unsaid_half_mm) return PointState::kNotStated;
  return held ? PointState::kRemoved : PointState::kStays;
}

PointState in_bevel(const Bevel& b, Vec3 p) {
  const Vec2 q = xy(p);
  if (p.z > 0.0) return PointState::kStays;
  if (inside(b.outline, q) != b.within) return PointState::kStays;
  const double d = nearest(b.outline, q).distance_mm;
  if (b.round) {
    if (d >= b.width_mm || -p.z >= b.width_mm) return PointState::kStays;
    return std::hypot(b.width_mm - d, b.width_mm + p.z) > b.width_mm ? PointState::kRemoved
                                                                     : PointState::kStays;
  }
  const auto holds = [&](double width, double depth) {
    return d < width && -p.z < depth * (1.0 - d / width);
  };
  const bool one = holds(b.width_mm, b.depth_mm), other = holds(b.other_width_mm, b.other_depth_mm);
  if (one != other) return PointState::kNotStated;
  return one ? PointState::kRemoved : PointState::kStays;
}

void grow(Box3& box, Vec2 lo, Vec2 hi, double by) {
  box.lo.x = lo.x - by;
  box.lo.y = lo.y - by;
  box.hi.x = hi.x + by;
  box.hi.y = hi.y + by;
}

}  // namespace

PointState Solid::at(Vec3 p) const {
  tick();
  if (const auto* a = std::get_if<Area>(&form)) return in_area(*a, *this, p);
  if (const auto* b = std::get_if<Bore>(&form)) return in_bore(*b, *this, p);
  if (const auto* g = std::get_if<Groove>(&form)) return in_groove(*g, *this, p);
  return in_bevel(std::get<Bevel>(form), p);
}

Box3 Solid::box() const {
  Box3 out;
  out.lo.z = -depth_mm;
  out.hi.z = 0.0;
  if (const auto* a = std::get_if<Area>(&form)) {
    grow(out, a->outline.lo, a->outline.hi, a->around ? kSaidBeside : a->leaning_mm);
    if (a->overhead) out.hi.z = 1e6;
  } else if (const auto* b = std::get_if<Bore>(&form)) {
    grow(out, {}, {}, std::max(b->top_radius_mm, b->bottom_radius_mm));
    if (b->bottom == Bore::Bottom::kCone) out.lo.z -= b->tip_mm > 0.0 ? b->tip_mm : 4.0 * b->bottom_radius_mm;
    if (b->bottom == Bore::Bottom::kBall) out.lo.z -= b->radius_mm;
  } else if (const auto* g = std::get_if<Groove>(&form)) {
    grow(out, g->course.lo, g->course.hi, g->half_mm);
  } else {
    const auto& v = std::get<Bevel>(form);
    grow(out, v.outline.lo, v.outline.hi, v.within ? 0.0 : std::max(v.width_mm, v.other_width_mm));
    out.lo.z = -std::max(v.depth_mm, v.other_depth_mm);
  }
  if (through) out.lo.z = -1e6;
  return out;
}

}  // namespace capstan::verify::volumes
