#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "planner/making/toolpath/region/area/track.h"

// Polygons back to lines and arcs.

namespace capstan::toolpath {

using geometry::Loop;
using geometry::Vec2;

namespace {

constexpr double kLargestRadius = 5'000.0;  // beyond, lines do
constexpr std::size_t kFewestChords = 3;
// Somewhat more than half a turn, so that a circle of any number of chords becomes two arcs.
constexpr double kMostSweep = 1.15 * std::numbers::pi;

/// Keeps, from an anchor, the cone of directions in which all dropped points lie within the tolerance of
/// the ray (Sklansky and Gonzalez, Pattern Recognition 12, 1980).
class Cone {
 public:
  explicit Cone(Vec2 anchor) : anchor_(anchor) {}
  /// Whether the ray to p still passes all points seen; then p narrows the cone.
  bool accept(Vec2 p, double tolerance) {
    const Vec2 d = p - anchor_;
    const double l = norm(d);
    if (l <= tolerance) return !open_;
    if (open_ && (cross(lo_, d) < 0.0 || cross(d, hi_) < 0.0 || dot(d, lo_) <= 0.0)) return false;
    if (open_ && l < farthest_ - tolerance) return false;  // turned back
    const double half = std::asin(std::min(1.0, tolerance / l));
    const double a = std::atan2(d.y, d.x);
    const Vec2 lo{std::cos(a - half), std::sin(a - half)};
    const Vec2 hi{std::cos(a + half), std::sin(a + half)};
    if (!open_ || cross(lo_, lo) > 0.0) lo_ = lo;
    if (!open_ || cross(hi, hi_) > 0.0) hi_ = hi;
    open_ = true;
    farthest_ = std::max(farthest_, l);
    return true;
  }

 private:
  Vec2 anchor_, lo_, hi_;
  double farthest_ = 0.0;
  bool open_ = false;
};

std::vector<Vec2> simplified_line(const std::vector<Vec2>& in, double tolerance) {
  if (in.size() < 3) return in;
  std::vector<Vec2> out = {in.front()};
  Cone cone(in.front());
  for (std::size_t i = 1; i < in.size(); ++i) {
    if (cone.accept(in[i], tolerance)) continue;
    out.push_back(in[i - 1]);
    cone = Cone(in[i - 1]);
    (void)cone.accept(in[i], tolerance);
  }
  out.push_back(in.back());
  return out;
}

struct Circle {
  Vec2 centre;
  double radius = 0.0;
};

std::optional<Circle> through(Vec2 a, Vec2 b, Vec2 c) {
  const Vec2 u = b - a;
  const Vec2 v = c - a;
  const double area2 = cross(u, v);
  if (std::abs(area2) < 1e-12 * (dot(u, u) + dot(v, v))) return std::nullopt;
  const double k = 0.5 / area2;
  const Vec2 to{k * (v.y * dot(u, u) - u.y * dot(v, v)), k * (u.x * dot(v, v) - v.x * dot(u, u))};
  const double r = norm(to);
  if (!(r < kLargestRadius)) return std::nullopt;
  return Circle{a + to, r};
}

/// The circle's arc from p[i] to p[j], if all vertices and chords between keep to it.
std::optional<Circle> arc_through(const std::vector<Vec2>& p, std::size_t i, std::size_t j,
                                  double tolerance) {
  const auto c = through(p[i], p[(i + j) / 2], p[j]);
  if (!c) return std::nullopt;
  const double sign = cross(p[i + 1] - p[i], p[i + 2] - p[i + 1]);
  double sweep = 0.0;
  for (std::size_t k = i; k < j; ++k) {
    const Vec2 r0 = p[k] - c->centre;
    const Vec2 r1 = p[k + 1] - c->centre;
    if (std::abs(norm(r1) - c->radius) > tolerance) return std::nullopt;
    const double turn = cross(r0, r1);
    if (turn * sign <= 0.0) return std::nullopt;
    const double half_chord = 0.5 * norm(r1 - r0);
    if (half_chord >= c->radius) return std::nullopt;
    // Sagitta: a coarse polygon is a polygon, not a circle.
    const double sagitta = c->radius - std::sqrt((c->radius - half_chord) * (c->radius + half_chord));
    if (sagitta > 2.0 * tolerance) return std::nullopt;
    sweep += std::atan2(std::abs(turn), dot(r0, r1));
    if (sweep > kMostSweep) return std::nullopt;
  }
  return c;
}

/// The farthest j for which p[i] ... p[j] is one arc: doubling, then halving.
std::size_t reach_of_arc(const std::vector<Vec2>& p, std::size_t i, double tolerance) {
  const std::size_t last = p.size() - 1;
  std::size_t good = i + kFewestChords;
  if (good > last || !arc_through(p, i, good, tolerance)) return i;
  std::size_t step = kFewestChords;
  std::size_t bad = last + 1;
  while (good < last) {
    const std::size_t next = std::min(good + step, last);
    if (!arc_through(p, i, next, tolerance)) {
      bad = next;
      break;
    }
    good = next;
    step *= 2;
  }
  while (bad <= last && bad - good > 1) {
    const std::size_t middle = good + (bad - good) / 2;
    (arc_through(p, i, middle, tolerance) ? good : bad) = middle;
  }
  return good;
}

Track fitted(const std::vector<Vec2>& p, double tolerance, bool closed) {
  Track out{.start = p.front(), .segments = {}, .closed = closed};
  std::size_t i = 0;
  while (i + 1 < p.size()) {
    const std::size_t j = reach_of_arc(p, i, tolerance);
    if (j == i) {
      out.segments.push_back({.to = p[++i], .centre = {}, .bend = Bend::kStraight});
      continue;
    }
    const Circle c = *arc_through(p, i, j, tolerance);
    if (c.radius < kSmallestArc || norm(p[j] - p[i]) < kSmallestArc) {
      out.segments.push_back({.to = p[j], .centre = {}, .bend = Bend::kStraight});
      i = j;
      continue;
    }
    // The centre is moved onto the bisector of the two ends, so that both radii agree exactly.
    const Vec2 middle = 0.5 * (p[i] + p[j]);
    const Vec2 chord = p[j] - p[i];
    const double l2 = dot(chord, chord);
    const Vec2 normal{-chord.y, chord.x};
    const Vec2 centre = l2 > 0.0 ? middle + (dot(c.centre - middle, normal) / l2) * normal : c.centre;
    const bool left = cross(p[i + 1] - p[i], p[i + 2] - p[i + 1]) > 0.0;
    out.segments.push_back({.to = p[j], .centre = centre, .bend = left ? Bend::kCcw : Bend::kCw});
    i = j;
  }
  return out;
}

}  // namespace

Loop simplified(const Loop& loop, double tolerance_mm) {
  if (loop.size() < 4) return loop;
  Loop line = loop;
  line.push_back(loop.front());
  line = simplified_line(line, tolerance_mm);
  line.pop_back();
  return line;
}

geometry::Region simplified(const geometry::Region& region, double tolerance_mm) {
  geometry::Region out;
  for (const Loop& loop : region.loops) {
    Loop s = simplified(loop, tolerance_mm);
    if (s.size() >= 3) out.loops.push_back(std::move(s));
  }
  return out;
}

Track track_of(const Loop& loop, double tolerance_mm) {
  if (loop.empty()) return {};
  // Begin after the longest edge, so that no arc is cut in two by the loop's own beginning.
  std::size_t begin = 0;
  double longest = -1.0;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const double l = norm(loop[(i + 1) % loop.size()] - loop[i]);
    if (l > longest + 1e-6) {
      longest = l;
      begin = (i + 1) % loop.size();
    }
  }
  std::vector<Vec2> line(loop.begin() + static_cast<std::ptrdiff_t>(begin), loop.end());
  line.insert(line.end(), loop.begin(), loop.begin() + static_cast<std::ptrdiff_t>(begin) + 1);
  return fitted(simplified_line(line, 1e-5), tolerance_mm, true);
}

Track track_of_line(const std::vector<Vec2>& line, double tolerance_mm) {
  if (line.empty()) return {};
  return fitted(simplified_line(line, 1e-5), tolerance_mm, false);
}

}  // namespace capstan::toolpath
