#include "planner/making/toolpath/region/area/crossing.h"

#include <algorithm>
#include <cmath>

namespace capstan::toolpath {

using geometry::Vec2;

namespace {

/// How far ahead the next ring is met at least, over its distance: two quarters of a circle. Of 1, 1.5 and 2
/// the least takes the least time (pocket of 304: 0.6, 1.1 and 1.3 % more than a straight step), and the
/// cutter's front meets as much of the material in all three.
constexpr double kAhead = 1.0;
/// How far along the next ring a place is looked for, and in what steps, over the distance of the rings;
/// default, unsourced.
constexpr double kFarthest = 6.0, kLook = 0.25;
/// Cosine of the angle by which headings at both ends may differ; default, unsourced.
constexpr double kStraightEnough = 0.94;
/// Chords by which an arc is held against the region.
constexpr int kChords = 8;

/// The arc from a, along `heading` there, to b; a line where it hardly bends.
Segment arc_to(Vec2 a, Vec2 heading, Vec2 b) {
  const Vec2 chord = b - a, aside = left_of(heading);
  const double off = dot(chord, aside), square = dot(chord, chord);
  if (std::abs(off) < kFitTolerance) return {.to = b, .centre = {}, .bend = Bend::kStraight};
  const double radius = 0.5 * square / off;  // to the left when positive
  return {.to = b, .centre = a + radius * aside, .bend = radius > 0.0 ? Bend::kCcw : Bend::kCw};
}

std::optional<Track> biarc(Vec2 a, Vec2 heading_a, Vec2 b, Vec2 heading_b) {
  const Vec2 v = b - a, sum = heading_a + heading_b;
  const double along = dot(v, sum), square = dot(v, v), open = 2.0 * (1.0 - dot(heading_a, heading_b));
  if (!(along > 0.0) || !(square > 0.0)) return std::nullopt;
  // |b - a - d (heading_a + heading_b)| = 2 d
  const double d =
      open > 1e-9 ? (std::sqrt(along * along + open * square) - along) / open : 0.5 * square / along;
  if (!(d > 0.0)) return std::nullopt;
  const Vec2 middle = 0.5 * (a + b + d * (heading_a - heading_b));
  Track out{.start = a, .segments = {}, .closed = false};
  out.segments.push_back(arc_to(a, heading_a, middle));
  // The second from its end backwards: the same circle.
  Segment second = arc_to(b, -1.0 * heading_b, middle);
  second.bend = second.bend == Bend::kCw ? Bend::kCcw : second.bend == Bend::kCcw ? Bend::kCw : second.bend;
  second.to = b;
  out.segments.push_back(second);
  return out;
}

bool stays(const Track& way, const Inside& inside) {
  Vec2 last = way.start, from = way.start;
  for (const Segment& s : way.segments) {
    for (int k = 1; k <= kChords; ++k) {
      const Vec2 p = point_at(from, s, static_cast<double>(k) / kChords);
      if (!inside.contains(last, p)) return false;
      last = p;
    }
    from = s.to;
  }
  return true;
}

}  // namespace

std::optional<Crossing> crossing(Vec2 at, Vec2 heading, const Track& to, const Inside& inside) {
  const Spot near = nearest(to, at);
  if (to.segments.empty() || near.distance_mm < kSmallestArc) return std::nullopt;
  const Track ring = begun_at(to, near);
  const double apart = near.distance_mm, most = std::min(kFarthest * apart, 0.5 * length_of(ring));
  for (double s = 0.0; s <= most; s += kLook * apart) {
    const Spot spot = at_length(ring, s);
    const Vec2 there = direction_at(ring, spot), v = spot.point - at;
    if (dot(heading, there) < kStraightEnough) continue;
    if (dot(heading, v) < kAhead * std::max(apart, std::abs(cross(heading, v)))) continue;
    auto way = biarc(at, heading, spot.point, there);
    if (!way || !stays(*way, inside)) break;
    return Crossing{.way = std::move(*way), .onto = nearest(to, spot.point)};
  }
  return std::nullopt;
}

}  // namespace capstan::toolpath
