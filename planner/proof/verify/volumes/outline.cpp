#include "planner/proof/verify/volumes/outline.h"

#include <algorithm>
#include <cmath>
#include <numbers>

// Exact boundaries. A point lies inside by the number of turns that the boundary makes about
// it: the turns of the polygon of all ends, counted where edges cross a ray (Sunday's form of the winding
// number), and one turn more or less for each arc whose segment, between arc and chord, holds the point. Only
// edges that reach the height of the point can do either: an outline of many edges has them sorted into bands
// of y.

namespace capstan::verify::volumes {

using geometry::Vec2;

namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kFull = 2.0 * kPi - 1e-9;

Vec2 polar(double angle) { return {std::cos(angle), std::sin(angle)}; }
Vec2 left_of(Vec2 d) { return {-d.y, d.x}; }

/// Share of an arc's sweep at which the direction lies; beyond 1: not on it.
double share_of(const Edge& e, Vec2 p) {
  const Vec2 d = p - e.centre;
  double turn = std::atan2(d.y, d.x) - e.start_rad;
  if (e.sweep_rad < 0.0) turn = -turn;
  turn = std::fmod(turn, 2.0 * kPi);
  if (turn < 0.0) turn += 2.0 * kPi;
  return turn / std::abs(e.sweep_rad);
}

double part_of(const Edge& e, Vec2 p, double& share) {
  if (!e.arc()) {
    const Vec2 d = e.to - e.from;
    const double n = dot(d, d);
    share = n > 0.0 ? std::clamp(dot(p - e.from, d) / n, 0.0, 1.0) : 0.0;
    return norm(p - (e.from + share * d));
  }
  share = share_of(e, p);
  if (share <= 1.0) return std::abs(norm(p - e.centre) - e.radius_mm);
  const double a = norm(p - e.from), b = norm(p - e.to);
  share = a < b ? 0.0 : 1.0;
  return std::min(a, b);
}

/// On which side of a chord p lies: +1 left, -1 right. On it: right of one that rises, left of one that
/// falls, above one that is level, so that every point is on one side for all who ask.
int side_of(Vec2 a, Vec2 b, Vec2 p) {
  const double side = cross(b - a, p - a);
  if (side != 0.0) return side > 0.0 ? 1 : -1;
  if (a.y != b.y) return b.y > a.y ? -1 : 1;
  return b.x > a.x ? 1 : -1;
}

/// Whether p lies between an arc and its chord, which ends at b.
bool in_segment(const Edge& e, Vec2 b, Vec2 p) {
  const Vec2 d = p - e.centre;
  if (dot(d, d) >= e.radius_mm * e.radius_mm) return false;
  if (std::abs(e.sweep_rad) >= kFull) return true;
  return side_of(e.from, b, p) == (e.sweep_rad > 0.0 ? -1 : 1);
}

}  // namespace

double Edge::length() const { return arc() ? radius_mm * std::abs(sweep_rad) : norm(to - from); }
Vec2 Edge::at(double share) const {
  if (!arc()) return from + share * (to - from);
  return centre + radius_mm * polar(start_rad + share * sweep_rad);
}
Vec2 Edge::along(double share) const {
  if (!arc()) {
    const double n = norm(to - from);
    return n > 0.0 ? (1.0 / n) * (to - from) : Vec2{1.0, 0.0};
  }
  const Vec2 left = left_of(polar(start_rad + share * sweep_rad));
  return sweep_rad > 0.0 ? left : -1.0 * left;
}
Edge Edge::reversed() const {
  Edge out = *this;
  std::swap(out.from, out.to);
  out.start_rad = start_rad + sweep_rad;
  out.sweep_rad = -sweep_rad;
  return out;
}

Edge straight(Vec2 from, Vec2 to) {
  Edge e;
  e.from = from;
  e.to = to;
  return e;
}
Edge round(Vec2 centre, double radius_mm, double start_rad, double sweep_rad) {
  Edge e;
  e.centre = centre;
  e.radius_mm = radius_mm;
  e.start_rad = start_rad;
  e.sweep_rad = sweep_rad;
  e.from = e.at(0.0);
  e.to = e.at(1.0);
  return e;
}

void Outline::add(const Edge& e) {
  edges.push_back(e);
  rows.reset();
  const auto hold = [&](Vec2 p) {
    lo = {std::min(lo.x, p.x), std::min(lo.y, p.y)};
    hi = {std::max(hi.x, p.x), std::max(hi.y, p.y)};
  };
  hold(e.from);
  hold(e.to);
  if (!e.arc()) return;
  for (int i = 0; i < 4; ++i) {
    const Vec2 p = e.centre + e.radius_mm * polar(0.5 * kPi * i);
    if (share_of(e, p) <= 1.0) hold(p);
  }
}

Near nearest(const Outline& o, Vec2 p, bool walls_only) {
  Near out;
  for (std::size_t i = 0; i < o.edges.size(); ++i) {
    if (walls_only && o.edges[i].open) continue;
    double share = 0.0;
    const double d = part_of(o.edges[i], p, share);
    if (d < out.distance_mm) out = {d, i, share};
  }
  return out;
}

double mitred(const Outline& o, Vec2 p, bool walls_only) {
  /// A mitre is at most so many times as far from its corner as from the walls.
  constexpr double kMostOut = 2.0;
  double out = 1e300;
  const std::size_t n = o.edges.size();
  for (std::size_t i = 0; i < n; ++i) {
    const Edge& e = o.edges[i];
    if (walls_only && e.open) continue;
    double share = 0.0;
    double d = part_of(e, p, share);
    if (share <= 0.0 || share >= 1.0) {
      const bool begin = share <= 0.0;
      const Edge& other = o.edges[begin ? (i + n - 1) % n : (i + 1) % n];
      const Vec2 corner = e.at(share), off = p - corner;
      const Vec2 into = (begin ? other : e).along(1.0), from = (begin ? e : other).along(0.0);
      const bool wall = !(walls_only && other.open);
      if (wall && dot(off, into) >= 0.0 && dot(off, from) <= 0.0) {
        const double sides = std::max(std::abs(cross(into, off)), std::abs(cross(from, off)));
        if (sides * kMostOut >= d) d = sides;
      }
    }
    out = std::min(out, d);
  }
  return out;
}

namespace {

/// What one edge adds to the turns about p. `b` is where the next edge begins: it ends this one, so that no
/// gap lets the ray through.
int turns_of(const Edge& e, Vec2 b, Vec2 p) {
  int out = 0;
  const Vec2 a = e.from;
  if (a.y <= p.y) {
    if (b.y > p.y && side_of(a, b, p) > 0) ++out;
  } else if (b.y <= p.y && side_of(a, b, p) < 0) {
    --out;
  }
  if (e.arc() && in_segment(e, b, p)) out += e.sweep_rad > 0.0 ? 1 : -1;
  return out;
}

constexpr std::size_t kFewEdges = 32;  ///< are looked at one by one; default, unsourced
constexpr double kEntries = 4.0;       ///< of rows for each edge, about; default, unsourced

std::size_t row_of(const Rows& r, double y) {
  const double row = (y - r.from) * r.per_mm;
  return static_cast<std::size_t>(std::clamp(row, 0.0, static_cast<double>(r.begin.size() - 2)));
}

}  // namespace

void Outline::sort() {
  rows.reset();
  const std::size_t n = edges.size();
  if (n <= kFewEdges || !(hi.y > lo.y)) return;
  struct Span {
    double lo, hi;
  };
  std::vector<Span> spans(n);
  double sum = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    const Edge& e = edges[i];
    const double b = edges[(i + 1) % n].from.y;
    Span s{std::min(e.from.y, b), std::max(e.from.y, b)};
    if (e.arc()) s = {std::min(s.lo, e.centre.y - e.radius_mm), std::max(s.hi, e.centre.y + e.radius_mm)};
    spans[i] = s;
    sum += s.hi - s.lo;
  }
  // Long edges stand in many rows: there are as many rows as keep the entries in proportion to the edges.
  const double most = kEntries * static_cast<double>(n) * (hi.y - lo.y) / std::max(sum, 1e-9);
  const auto count = static_cast<std::size_t>(std::clamp(most, 1.0, static_cast<double>(n)));
  auto out = std::make_shared<Rows>();
  out->from = lo.y;
  out->per_mm = static_cast<double>(count) / (hi.y - lo.y);
  out->of = n;
  out->begin.assign(count + 1, 0);
  for (const Span& s : spans) {
    for (std::size_t r = row_of(*out, s.lo); r <= row_of(*out, s.hi); ++r) ++out->begin[r + 1];
  }
  for (std::size_t r = 0; r < count; ++r) out->begin[r + 1] += out->begin[r];
  out->edges.resize(out->begin.back());
  std::vector<std::uint32_t> next(out->begin.begin(), out->begin.end() - 1);
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t last = row_of(*out, spans[i].hi);
    for (std::size_t r = row_of(*out, spans[i].lo); r <= last; ++r)
      out->edges[next[r]++] = static_cast<std::uint32_t>(i);
  }
  rows = std::move(out);
}

int turns_around(const Outline& o, Vec2 p) {
  int out = 0;
  const std::size_t n = o.edges.size();
  const auto add = [&](std::size_t i) {
    out += turns_of(o.edges[i], o.edges[i + 1 < n ? i + 1 : 0].from, p);
  };
  if (const Rows* r = o.rows.get(); r != nullptr && r->of == n) {
    const std::size_t row = row_of(*r, p.y);
    for (std::uint32_t k = r->begin[row]; k < r->begin[row + 1]; ++k) add(r->edges[k]);
  } else {
    for (std::size_t i = 0; i < n; ++i) add(i);
  }
  return out;
}

double twice_area(const Outline& o) {
  double out = 0.0;
  for (const Edge& e : o.edges) {
    out += cross(e.from, e.to);
    if (e.arc()) out += e.radius_mm * e.radius_mm * (e.sweep_rad - std::sin(e.sweep_rad));
  }
  return out;
}

namespace {

constexpr double kSmoothRad = 0.035;  ///< two edges that turn less are one smooth wall; default, unsourced

/// Where the centre of a circle may be that touches an edge on its left: a line or a circle.
struct Track {
  bool line = true;
  Vec2 from, along;  ///< line
  Vec2 centre;
  double radius_mm = 0.0;  ///< circle; below 0: the circle does not fit into the arc
};
Track beside(const Edge& e, double r) {
  if (!e.arc()) return {true, e.from + r * left_of(e.along(0.0)), e.along(0.0), {}, 0.0};
  // Counter-clockwise round an area the arc bulges outwards, and the circle lies within it.
  return {false, {}, {}, e.centre, e.sweep_rad > 0.0 ? e.radius_mm - r : e.radius_mm + r};
}

std::vector<Vec2> crossings(const Track& a, const Track& b) {
  if (!a.line && b.line) return crossings(b, a);
  if (a.line && b.line) {
    const double turn = cross(a.along, b.along);
    if (std::abs(turn) < 1e-12) return {};
    return {a.from + (cross(b.from - a.from, b.along) / turn) * a.along};
  }
  if (b.radius_mm < 0.0 || (!a.line && a.radius_mm < 0.0)) return {};
  if (a.line) {
    const double t = dot(b.centre - a.from, a.along);
    const Vec2 foot = a.from + t * a.along;
    const double off = norm(b.centre - foot);
    if (off > b.radius_mm) return {};
    const double s = std::sqrt(b.radius_mm * b.radius_mm - off * off);
    return {foot - s * a.along, foot + s * a.along};
  }
  const Vec2 d = b.centre - a.centre;
  const double n = norm(d);
  if (n < 1e-9 || n > a.radius_mm + b.radius_mm || n < std::abs(a.radius_mm - b.radius_mm)) return {};
  const double t = (n * n + a.radius_mm * a.radius_mm - b.radius_mm * b.radius_mm) / (2.0 * n);
  const double s = std::sqrt(std::max(0.0, a.radius_mm * a.radius_mm - t * t));
  const Vec2 u = (1.0 / n) * d;
  return {a.centre + t * u + s * left_of(u), a.centre + t * u - s * left_of(u)};
}

/// Where a circle about c touches an edge, as a share of it; below 0: beyond its ends.
double touching(const Edge& e, Vec2 c) {
  constexpr double kHair = 1e-7;
  double share = 0.0;
  if (e.arc()) {
    share = share_of(e, c);
    if (share > 1.0 && (share - 2.0 * kPi / std::abs(e.sweep_rad)) > -kHair) share = 0.0;
  } else {
    const Vec2 d = e.to - e.from;
    share = dot(c - e.from, d) / std::max(dot(d, d), 1e-300);
  }
  return share < -kHair || share > 1.0 + kHair ? -1.0 : std::clamp(share, 0.0, 1.0);
}

Edge part(const Edge& e, double a, double b) {
  if (!e.arc()) {
    Edge out = e;
    out.from = e.at(a);
    out.to = e.at(b);
    return out;
  }
  Edge out = round(e.centre, e.radius_mm, e.start_rad + a * e.sweep_rad, (b - a) * e.sweep_rad);
  out.open = e.open;
  return out;
}

}  // namespace

Rounded rounded(const Outline& o, double r) {
  std::vector<Edge> edges = o.edges;
  if (twice_area(o) < 0.0) {
    std::reverse(edges.begin(), edges.end());
    for (Edge& e : edges) e = e.reversed();
  }
  const std::size_t n = edges.size();
  struct Corner {
    bool cut = false;
    double before = 1.0, after = 0.0;  ///< shares of the edge that ends here, and of the next one
    Edge arc;
  };
  std::vector<Corner> corners(n);  // corner i: end of edge i
  for (std::size_t i = 0; i < n; ++i) {
    const Edge &a = edges[i], &b = edges[(i + 1) % n];
    if (a.arc() && a.sweep_rad > 0.0 && a.radius_mm < r - 1e-6 && !a.open)
      return {{}, "an inside arc is drawn smaller than the radius that is stated"};
    const Vec2 u = a.along(1.0), v = b.along(0.0);
    const double turn = std::atan2(cross(u, v), dot(u, v));
    if (n < 2 || a.open || b.open || turn < kSmoothRad) continue;
    Corner& c = corners[i];
    double best = 1e300;
    for (const Vec2 centre : crossings(beside(a, r), beside(b, r))) {
      const double s = touching(a, centre), t = touching(b, centre);
      if (s < 0.0 || t < 0.0 || norm(centre - a.to) > best) continue;
      best = norm(centre - a.to);
      const Vec2 p = a.at(s) - centre, q = b.at(t) - centre;
      double sweep = std::atan2(cross(p, q), dot(p, q));
      if (sweep < 0.0) sweep += 2.0 * kPi;
      c = {true, s, t, round(centre, r, std::atan2(p.y, p.x), sweep)};
    }
    if (!c.cut) return {{}, "an inside corner has no room for the radius that is stated"};
  }
  Rounded out;
  for (std::size_t i = 0; i < n; ++i) {
    const double a = corners[(i + n - 1) % n].after, b = corners[i].before;
    if (a > b + 1e-7) return {{}, "two inside corners are too near each other for the radius that is stated"};
    if (b - a > 1e-9) out.outline.add(part(edges[i], a, b));
    if (corners[i].cut) out.outline.add(corners[i].arc);
  }
  return out;
}

}  // namespace capstan::verify::volumes
