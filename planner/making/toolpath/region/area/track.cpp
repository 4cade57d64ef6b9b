#include "planner/making/toolpath/region/area/track.h"

#include <algorithm>
#include <cmath>

#include "planner/ground/vocabulary/unit_factors.h"

namespace capstan::toolpath {

using geometry::Loop;
using geometry::Vec2;

namespace {

double angle_of(Vec2 v) { return std::atan2(v.y, v.x); }

/// Angle swept by an arc segment, (0, 2 pi].
double sweep_of(Vec2 from, const Segment& s) {
  const double a = angle_of(from - s.centre);
  const double b = angle_of(s.to - s.centre);
  double sweep = s.bend == Bend::kCcw ? b - a : a - b;
  if (sweep <= 1e-12) sweep += kRadPerTurn;
  return sweep;
}

double distance_to_segment(Vec2 p, Vec2 a, Vec2 b, double& t) {
  const Vec2 d = b - a;
  const double l2 = dot(d, d);
  t = l2 > 0.0 ? std::clamp(dot(p - a, d) / l2, 0.0, 1.0) : 0.0;
  return norm(p - (a + t * d));
}

}  // namespace

double length_of(Vec2 from, const Segment& s) {
  if (s.bend == Bend::kStraight) return norm(s.to - from);
  return norm(from - s.centre) * sweep_of(from, s);
}

double length_of(const Track& t) {
  double sum = 0.0;
  Vec2 at = t.start;
  for (const Segment& s : t.segments) {
    sum += length_of(at, s);
    at = s.to;
  }
  return sum;
}

Vec2 point_at(Vec2 from, const Segment& s, double t) {
  if (t <= 0.0) return from;
  if (t >= 1.0) return s.to;
  if (s.bend == Bend::kStraight) return from + t * (s.to - from);
  const double sign = s.bend == Bend::kCcw ? 1.0 : -1.0;
  const double a = angle_of(from - s.centre) + sign * t * sweep_of(from, s);
  const double r = norm(from - s.centre);
  return s.centre + Vec2{r * std::cos(a), r * std::sin(a)};
}

Vec2 direction_at(Vec2 from, const Segment& s, double t) {
  if (s.bend == Bend::kStraight) {
    const double l = norm(s.to - from);
    return l > 0.0 ? (1.0 / l) * (s.to - from) : Vec2{1.0, 0.0};
  }
  const Vec2 r = point_at(from, s, t) - s.centre;
  const double k = 1.0 / norm(r);
  return s.bend == Bend::kCcw ? Vec2{-k * r.y, k * r.x} : Vec2{k * r.y, -k * r.x};
}

Track reversed(const Track& t) {
  Track out{.start = t.end(), .segments = {}, .closed = t.closed};
  out.segments.reserve(t.segments.size());
  for (std::size_t i = t.segments.size(); i-- > 0;) {
    Segment s = t.segments[i];
    s.to = i == 0 ? t.start : t.segments[i - 1].to;
    if (s.bend != Bend::kStraight) s.bend = s.bend == Bend::kCw ? Bend::kCcw : Bend::kCw;
    out.segments.push_back(s);
  }
  return out;
}

Spot nearest(const Track& t, Vec2 p) {
  Spot best{.segment = 0, .t = 0.0, .point = t.start, .distance_mm = norm(p - t.start)};
  Vec2 from = t.start;
  for (std::size_t i = 0; i < t.segments.size(); ++i) {
    const Segment& s = t.segments[i];
    double at = 0.0;
    double d = 0.0;
    if (s.bend == Bend::kStraight) {
      d = distance_to_segment(p, from, s.to, at);
    } else {
      const double sweep = sweep_of(from, s);
      const double a = angle_of(from - s.centre);
      const double b = angle_of(p - s.centre);
      double ahead = s.bend == Bend::kCcw ? b - a : a - b;
      while (ahead < 0.0) ahead += kRadPerTurn;
      while (ahead >= kRadPerTurn) ahead -= kRadPerTurn;
      // Beyond the arc's end the nearer of its two ends counts.
      if (ahead > sweep) ahead = ahead - sweep < kRadPerTurn - ahead ? sweep : 0.0;
      at = ahead / sweep;
      d = norm(p - point_at(from, s, at));
    }
    if (d < best.distance_mm - 1e-9) {
      best = {.segment = i, .t = at, .point = point_at(from, s, at), .distance_mm = d};
    }
    from = s.to;
  }
  return best;
}

Spot at_length(const Track& t, double s_mm) {
  Vec2 from = t.start;
  for (std::size_t i = 0; i < t.segments.size(); ++i) {
    const double l = length_of(from, t.segments[i]);
    if (s_mm <= l || i + 1 == t.segments.size()) {
      const double at = l > 0.0 ? std::clamp(s_mm / l, 0.0, 1.0) : 0.0;
      return {.segment = i, .t = at, .point = point_at(from, t.segments[i], at), .distance_mm = 0.0};
    }
    s_mm -= l;
    from = t.segments[i].to;
  }
  return {.segment = 0, .t = 0.0, .point = t.start, .distance_mm = 0.0};
}

Vec2 direction_at(const Track& t, const Spot& s) {
  const Vec2 from = s.segment == 0 ? t.start : t.segments[s.segment - 1].to;
  return direction_at(from, t.segments[s.segment], s.t);
}

Track begun_at(const Track& t, const Spot& s) {
  if (t.segments.empty()) return t;
  Track out{.start = s.point, .segments = {}, .closed = t.closed};
  const std::size_t n = t.segments.size();
  out.segments.reserve(n + 1);
  constexpr double kEnd = 1e-9;
  const Vec2 from = s.segment == 0 ? t.start : t.segments[s.segment - 1].to;
  const double l = length_of(from, t.segments[s.segment]);
  if ((1.0 - s.t) * l > kEnd) out.segments.push_back(t.segments[s.segment]);
  for (std::size_t k = 1; k < n; ++k) out.segments.push_back(t.segments[(s.segment + k) % n]);
  if (s.t * l > kEnd) {
    Segment last = t.segments[s.segment];
    last.to = s.point;
    out.segments.push_back(last);
  }
  if (!out.segments.empty()) out.segments.back().to = out.start;
  return out;
}

Track part_of(const Track& t, double from_mm, double to_mm) {
  Track out;
  Vec2 at = t.start;
  double s = 0.0;
  bool begun = false;
  for (const Segment& seg : t.segments) {
    const double l = length_of(at, seg);
    if (l > 0.0 && s + l > from_mm - 1e-12 && s < to_mm + 1e-12) {
      const double a = std::clamp((from_mm - s) / l, 0.0, 1.0);
      const double b = std::clamp((to_mm - s) / l, 0.0, 1.0);
      if (!begun) out.start = point_at(at, seg, a);
      begun = true;
      if ((b - a) * l > 1e-9) {
        Segment piece = seg;
        piece.to = point_at(at, seg, b);
        out.segments.push_back(piece);
      }
    }
    s += l;
    at = seg.to;
  }
  if (!begun) out.start = from_mm <= 0.0 ? t.start : t.end();
  return out;
}

std::vector<Vec2> points_of(const Track& t, double tolerance_mm) {
  std::vector<Vec2> out = {t.start};
  Vec2 from = t.start;
  for (const Segment& s : t.segments) {
    if (s.bend == Bend::kStraight) {
      out.push_back(s.to);
    } else {
      const double sign = s.bend == Bend::kCcw ? 1.0 : -1.0;
      geometry::append_arc(out, s.centre, from, sign * sweep_of(from, s), tolerance_mm);
      out.back() = s.to;
    }
    from = s.to;
  }
  return out;
}

}  // namespace capstan::toolpath
