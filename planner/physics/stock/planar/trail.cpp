#include "planner/physics/stock/planar/trail.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "planner/ground/vocabulary/unit_factors.h"

namespace capstan::stock {
namespace {

using geometry::Vec2;

constexpr double kStrip = 1e-3;  // mm of height, as far as 16 strips go
constexpr int kMostStrips = 16;

Vec2 turned_left(Vec2 a) { return {-a.y, a.x}; }

/// Angle of p about the arc's centre from its start, in its sense, within (-pi, pi].
double angle_from_start(const Trail& t, Vec2 p) {
  const Vec2 w = p - t.centre;
  const double a = std::atan2(cross(t.along, w), dot(t.along, w));
  return t.turn_rad >= 0.0 ? a : -a;
}

/// On a rising or falling track: where on it, 0 .. 1, the cutter went deepest over p.
double deepest_on_line(const Trail& t, Vec2 p) {
  const Vec2 w = p - t.a;
  const double u = dot(w, t.along);
  const double v = cross(t.along, w);
  const double half = std::sqrt(std::max(0.0, (t.radius_mm - v) * (t.radius_mm + v)));
  const double s = t.zb < t.za ? std::min(t.length_mm, u + half) : std::max(0.0, u - half);
  return std::clamp(s / t.length_mm, 0.0, 1.0);
}

double deepest_on_arc(const Trail& t, Vec2 p) {
  const double turn = std::abs(t.turn_rad);
  const double r = norm(p - t.centre);
  const double rho = t.path_radius_mm;
  double half = std::numbers::pi;  // half of the turn about the centre over which p is covered
  if (r * rho > 0.0) {
    half = std::acos(
        std::clamp((r * r + (rho - t.radius_mm) * (rho + t.radius_mm)) / (2.0 * r * rho), -1.0, 1.0));
  }
  const bool falls = t.zb < t.za;
  const double middle = angle_from_start(t, p);
  double best = falls ? 0.0 : turn;
  for (const double m : {middle - kRadPerTurn, middle, middle + kRadPerTurn}) {
    const double from = std::max(0.0, m - half);
    const double to = std::min(turn, m + half);
    if (from > to) continue;
    best = falls ? std::max(best, to) : std::min(best, from);
  }
  return best / turn;
}

}  // namespace

void Trail::settle() {
  const double lowest_tip = std::min(za, zb);
  lowest_mm = lowest_tip;
  highest_mm = std::max(za, zb);
  if (outline != nullptr) highest_mm = lowest_tip + outline->height(radius_mm);
  if (arc) {
    path_radius_mm = norm(a - centre);
    along = (1.0 / path_radius_mm) * (a - centre);
    last = (1.0 / norm(b - centre)) * (b - centre);
    length_mm = path_radius_mm * std::abs(turn_rad);
    return;
  }
  length_mm = norm(b - a);
  if (length_mm > kTouch) {
    along = (1.0 / length_mm) * (b - a);
  } else {
    b = a;
    length_mm = 0.0;
    za = zb = lowest_mm;
    if (outline == nullptr) highest_mm = lowest_mm;
  }
}

double Trail::distance_to_arc(Vec2 p) const {
  const Vec2 w = p - centre;
  const double side = turn_rad >= 0.0 ? 1.0 : -1.0;
  if (side * cross(along, w) >= 0.0 && side * cross(w, last) >= 0.0)
    return std::abs(std::sqrt(dot(w, w)) - path_radius_mm);
  const Vec2 from_a = p - a;
  const Vec2 from_b = p - b;
  return std::sqrt(std::min(dot(from_a, from_a), dot(from_b, from_b)));
}

bool Trail::covers(const Trail& other) const {
  if (highest_mm > other.lowest_mm) return false;
  const double most = radius_mm - other.radius_mm + kTouch;
  if (most < 0.0 || distance(other.a) > most) return false;
  if (other.length_mm == 0.0) return true;
  if (distance(other.b) > most) return false;
  // Farther from a straight track than both of its ends no straight one goes.
  if (!arc && !other.arc) return true;
  if (!arc || !other.arc || norm(centre - other.centre) > kTouch) return false;
  const double side = turn_rad >= 0.0 ? 1.0 : -1.0;
  const auto turned = [&](Vec2 p) {  // lies in the arc's wedge
    const Vec2 w = p - centre;
    return side * cross(along, w) >= -kTouch && side * cross(w, last) >= -kTouch;
  };
  // About one centre: within an arc of less than a half turn lies what begins, ends and turns like it, or
  // less.
  return std::abs(path_radius_mm - other.path_radius_mm) <= most &&
         std::abs(other.turn_rad) <= std::abs(turn_rad) + kTouch && turned(other.a) && turned(other.b);
}

double Trail::floor_at(Vec2 p) const {
  if (outline != nullptr) return za + outline->height(std::min(distance(p), radius_mm));
  if (za == zb) return za;
  return za + (zb - za) * (arc ? deepest_on_arc(*this, p) : deepest_on_line(*this, p));
}

bool Trail::lower(const Probe& probe, double above_mm, Heights& heights) const {
  Cuts cuts;
  const double reach = radius_mm + probe.radius_mm;
  if (probe.radius_mm > 0.0) {
    const double d = distance(probe.origin);
    if (d >= reach - kTouch) return false;
    if (d <= radius_mm - probe.radius_mm + kTouch && (level() || highest_mm <= above_mm)) {
      return heights.lower(probe.lo, probe.hi, std::max(lowest_mm, above_mm));
    }
  }
  cuts.add(probe.lo);
  cuts.add(probe.hi);
  probe.cross_circle(a, radius_mm, cuts);
  if (length_mm > 0.0) probe.cross_circle(b, radius_mm, cuts);
  if (arc) {
    probe.cross_circle(centre, path_radius_mm + radius_mm, cuts);
    const double inner = std::abs(path_radius_mm - radius_mm);
    if (inner > kTouch) probe.cross_circle(centre, inner, cuts);
  } else if (length_mm > 0.0) {
    const Vec2 n = turned_left(along);
    const double d = dot(n, a);
    probe.cross_line(n, d + radius_mm, cuts);
    probe.cross_line(n, d - radius_mm, cuts);
  }
  cuts.sort();
  const bool even = level() || highest_mm <= above_mm;
  bool any = false;
  for (std::size_t i = 0; i + 1 < cuts.size(); ++i) {
    double x0 = cuts[i];
    double x1 = cuts[i + 1];
    if (!(x1 - x0 > 1e-12)) continue;
    if (distance(probe.at(0.5 * (x0 + x1))) > radius_mm + kTouch) continue;
    if (even) {
      any = heights.lower(x0, x1, std::max(lowest_mm, above_mm)) || any;
      continue;
    }
    if (!heights.narrow(x0, x1, std::max(lowest_mm, above_mm)) || x1 - x0 < kTouch) continue;
    const double z0 = floor_at(probe.at(x0));
    const double z1 = floor_at(probe.at(x1));
    const double zm = floor_at(probe.at(0.5 * (x0 + x1)));
    const double range = std::max({z0, z1, zm}) - std::min({z0, z1, zm});
    const int n = std::clamp(static_cast<int>(std::ceil(range / kStrip)), 1, kMostStrips);
    for (int k = 0; k < n; ++k) {
      const double from = x0 + (x1 - x0) * k / n;
      const double to = x0 + (x1 - x0) * (k + 1) / n;
      const double floor = n == 1 && to == x1 ? zm : floor_at(probe.at(0.5 * (from + to)));
      const double z = std::max(above_mm, floor);
      any = heights.lower(from, to, z) || any;
    }
  }
  return any;
}

void bounds_of(const Trail& t, Vec2& lo, Vec2& hi) {
  lo = {std::min(t.a.x, t.b.x), std::min(t.a.y, t.b.y)};
  hi = {std::max(t.a.x, t.b.x), std::max(t.a.y, t.b.y)};
  if (t.arc) {
    const double side = t.turn_rad >= 0.0 ? 1.0 : -1.0;
    for (const Vec2 d : {Vec2{1, 0}, Vec2{0, 1}, Vec2{-1, 0}, Vec2{0, -1}}) {
      if (side * cross(t.along, d) < 0.0 || side * cross(d, t.last) < 0.0) continue;
      const Vec2 p = t.centre + t.path_radius_mm * d;
      lo = {std::min(lo.x, p.x), std::min(lo.y, p.y)};
      hi = {std::max(hi.x, p.x), std::max(hi.y, p.y)};
    }
  }
  const Vec2 r{t.radius_mm, t.radius_mm};
  lo = lo - r;
  hi = hi + r;
}

std::vector<Trail> trails_of(const model::CutterPath& path, std::size_t i, double radius_mm,
                             const geometry::CutterProfile* outline) {
  std::vector<Trail> out;
  const geometry::Vec3 from = path.point(i - 1);
  const geometry::Vec3 to = path.point(i);
  int n = 1;
  double sweep = 0.0;
  const bool arc = is_arc(path.kind[i]) && std::hypot(to.x - path.cx[i], to.y - path.cy[i]) > kTouch &&
                   std::hypot(from.x - path.cx[i], from.y - path.cy[i]) > kTouch;
  if (arc) {
    sweep = model::arc_sweep(path, i);
    n = std::max(1, static_cast<int>(std::ceil(sweep / (0.5 * std::numbers::pi) - 1e-9)));
  }
  geometry::Vec3 p = from;
  for (int k = 1; k <= n; ++k) {
    const geometry::Vec3 q = k == n ? to : model::point_on_move(path, i, static_cast<double>(k) / n);
    Trail t;
    t.a = xy(p);
    t.b = xy(q);
    t.za = p.z;
    t.zb = q.z;
    t.radius_mm = radius_mm;
    t.outline = outline;
    if (arc) {
      t.arc = true;
      t.centre = {path.cx[i], path.cy[i]};
      t.turn_rad = (path.kind[i] == model::MoveKind::kArcCcw ? sweep : -sweep) / n;
    }
    t.settle();
    out.push_back(t);
    p = q;
  }
  return out;
}

}  // namespace capstan::stock
