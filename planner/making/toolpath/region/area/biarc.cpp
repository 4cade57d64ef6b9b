#include "planner/making/toolpath/region/area/biarc.h"

#include <cmath>

namespace capstan::toolpath {

using geometry::Vec2;

namespace {

/// The arc from p in the direction d to q; false where it turns more than a right angle.
bool append(Track& t, Vec2 p, Vec2 d, Vec2 q) {
  const Vec2 chord = q - p;
  const double along = dot(chord, d);
  const double aside = cross(d, chord);  // left of d: positive
  // An arc turns twice as far as its chord leaves its tangent.
  if (!(along > 0.0) || std::abs(aside) > (1.0 + 1e-9) * along) return false;
  if (std::abs(aside) < kSmallestArc) {
    t.segments.push_back({.to = q, .centre = {}, .bend = Bend::kStraight});
    return true;
  }
  const double radius = 0.5 * dot(chord, chord) / aside;
  t.segments.push_back(
      {.to = q, .centre = p + radius * Vec2{-d.y, d.x}, .bend = aside > 0.0 ? Bend::kCcw : Bend::kCw});
  return true;
}

}  // namespace

std::optional<Track> biarc(Vec2 a, Vec2 leave, Vec2 b, Vec2 meet) {
  // With tangents of length s the arcs meet halfway between a + s leave and b - s meet, which are 2 s apart:
  // |b - a - s (leave + meet)| = 2 s.
  const Vec2 v = b - a;
  const Vec2 both = leave + meet;
  const double second = 4.0 - dot(both, both);
  const double half = dot(v, both);
  double s = 0.0;
  if (second < 1e-9) {
    if (!(half > 0.0)) return std::nullopt;
    s = 0.5 * dot(v, v) / half;
  } else {
    s = (std::sqrt(half * half + second * dot(v, v)) - half) / second;
  }
  if (!(s > kSmallestArc)) return std::nullopt;
  const Vec2 middle = 0.5 * ((a + s * leave) + (b - s * meet));
  const Vec2 way = (b - s * meet) - (a + s * leave);
  Track out{.start = a, .segments = {}, .closed = false};
  if (!append(out, a, leave, middle) || !append(out, middle, (0.5 / s) * way, b)) return std::nullopt;
  return out;
}

}  // namespace capstan::toolpath
