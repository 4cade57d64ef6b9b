#include "planner/ground/geometry/offset/raw_offset.h"

#include <algorithm>
#include <cmath>
#include <vector>

// An offset is the region and, on each edge, a rectangle as high as the offset is far, and a wedge at each
// corner that opens; inwards, it is the region without them. Edge by edge, with every closing corner led
// through its old vertex (a spike), the raw outline turns round a point once for the region and once more, or
// less, for each rectangle and wedge over it. Spikes are as long as the offset is far and lie side by side:
// an outline of n short edges has n edges over one height, and a sweep takes n squared. Without its spike a
// corner of angle a turns once less round the kite between its vertex, the ends of its two moved edges and
// where these cross. Where both its rectangles hold that kite (the edges are R sin a and R tan(a / 2) long at
// least), they count twice there, and one turn stays. Kites that follow each other share rectangles: m of
// them over a point have m + 1 rectangles there, and one turn stays again; but not in a loop whose corners
// are kites all round, which therefore keeps one spike. A curve of radius c, however fine its chords, has
// kites to R = c. Beyond, its spikes all cross: what bounds their number is that chords within a tolerance
// do.

namespace capstan::geometry {
namespace {

/// Of the tolerance: how far a corner that opens may stay sharp beyond the circle round its vertex.
constexpr double kSharpPart = 0.25;

struct Corner {
  Vec2 vertex;
  Vec2 in, out;             ///< unit directions of the edges
  double shorter_mm = 0.0;  ///< of the two
  [[nodiscard]] double turn() const { return cross(in, out); }
  /// Tangent of half the angle between the edges.
  [[nodiscard]] double half() const {
    const double c = 1.0 + dot(in, out);
    return c > 1e-12 ? std::abs(turn()) / c : 1e300;
  }
  /// How far the edges can be moved to the closing side without a spike.
  [[nodiscard]] double reach_mm() const {
    const double most = std::max(half(), std::abs(turn()));
    return most > 0.0 ? shorter_mm / most : 1e300;
  }
};

Vec2 right_of(Vec2 d) { return {d.y, -d.x}; }

/// Corners in turn; equal points in a row are one. None of a loop that is no area.
std::vector<Corner> corners(const Loop& loop) {
  std::vector<Vec2> p;
  p.reserve(loop.size());
  for (const Vec2 v : loop) {
    if (p.empty() || norm(v - p.back()) >= 0.5 * kRegionGrid) p.push_back(v);
  }
  while (p.size() > 1 && norm(p.front() - p.back()) < 0.5 * kRegionGrid) p.pop_back();
  std::vector<Corner> out;
  if (p.size() < 3) return out;
  out.reserve(p.size());
  Vec2 before = p.front() - p.back();
  double before_mm = norm(before);
  for (std::size_t i = 0; i < p.size(); ++i) {
    const Vec2 after = p[i + 1 == p.size() ? 0 : i + 1] - p[i];
    const double after_mm = norm(after);
    out.push_back(
        {p[i], (1.0 / before_mm) * before, (1.0 / after_mm) * after, std::min(before_mm, after_mm)});
    before = after;
    before_mm = after_mm;
  }
  return out;
}

/// Whether the corner's two moved edges part (> 0: to the right): a round corner stands between them.
bool opens(const Corner& c, double delta_mm) {
  const double turn = c.turn();
  return turn == 0.0 ? dot(c.in, c.out) < 0.0 : turn * delta_mm > 0.0;
}

void append_round(Loop& out, const Corner& c, double delta_mm, double tolerance_mm) {
  const double turn = std::copysign(std::atan2(c.turn(), dot(c.in, c.out)), delta_mm);
  out.push_back(c.vertex + delta_mm * right_of(c.in));
  append_arc(out, c.vertex, out.back(), turn, std::min(tolerance_mm, 0.25 * std::abs(delta_mm)));
}

}  // namespace

RawOffset raw_offset(const Loop& loop, double delta_mm, double tolerance_mm) {
  const std::vector<Corner> all = corners(loop);
  const double radius = std::abs(delta_mm);
  const auto kite = [&](const Corner& c) { return !opens(c, delta_mm) && radius <= c.reach_mm(); };
  const bool all_round = std::all_of(all.begin(), all.end(), kite);
  RawOffset out;
  out.loop.reserve(all.size());
  for (const Corner& c : all) {
    const double half = c.half();
    const bool round = opens(c, delta_mm);
    // 1 / cos(angle / 2) - 1 is tan^2(angle / 2) / 2 at most.
    const bool sharp = round ? 0.5 * radius * half * half <= kSharpPart * tolerance_mm
                             : kite(c) && !(all_round && out.loop.empty());
    if (sharp) {
      const Vec2 n = right_of(c.in) + right_of(c.out);
      out.loop.push_back(c.vertex + (delta_mm / (1.0 + dot(c.in, c.out))) * n);
    } else if (round) {
      append_round(out.loop, c, delta_mm, tolerance_mm);
    } else {
      ++out.spikes;
      out.loop.push_back(c.vertex + delta_mm * right_of(c.in));
      out.loop.push_back(c.vertex);
      out.loop.push_back(c.vertex + delta_mm * right_of(c.out));
    }
  }
  return out;
}

double reach_with_spikes(const Region& a, bool outwards, std::size_t spikes) {
  std::vector<double> reach;
  for (const Loop& loop : a.loops) {
    for (const Corner& c : corners(loop)) {
      if (!opens(c, outwards ? 1.0 : -1.0)) reach.push_back(c.reach_mm());
    }
  }
  if (reach.size() <= spikes) return 1e300;
  const auto last = reach.begin() + static_cast<std::ptrdiff_t>(spikes);
  std::nth_element(reach.begin(), last, reach.end());
  return *last;
}

Loop without_small_corners(const Loop& loop, bool outwards, double most_mm) {
  constexpr std::size_t kLongestRun = 32;  // corners that one chord stands for
  const std::vector<Corner> all = corners(loop);
  const std::size_t n = all.size();
  const double side = outwards ? 1.0 : -1.0;
  const auto at = [&](std::size_t i) { return all[i % n].vertex; };
  Loop out;
  for (std::size_t i = 0; i < n;) {
    out.push_back(at(i));
    std::size_t to = i + 1;
    while (to < n && to - i < kLongestRun && !opens(all[to], side)) {
      const Vec2 along = at(to + 1) - at(i);
      const double length = norm(along);
      bool near = length > 0.0;
      for (std::size_t k = i + 1; near && k <= to; ++k) {
        const Vec2 d = at(k) - at(i);
        near = std::abs(cross(along, d)) <= most_mm * length && dot(along, d) > 0.0 &&
               dot(along, d) < length * length;
      }
      if (!near) break;
      ++to;
    }
    i = to;
  }
  return out;
}

}  // namespace capstan::geometry
