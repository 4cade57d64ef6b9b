#include <algorithm>
#include <cmath>
#include <numbers>

#include "planner/proof/verify/volumes/reading.h"

// Where two readings are compared: on either side of every piece of the own outlines (at the ends of lines,
// at the middle and the quarters of arcs, across the halves of sharp corners), at heights through the
// feature, at its floor and below it, and on a grid. The places depend on the file only.

namespace capstan::verify::volumes {

using geometry::Vec2;
using geometry::Vec3;

namespace {

constexpr std::size_t kMostEdges = 96;  ///< of one outline that are looked at; default, unsourced
constexpr int kGrid = 6;

class Places {
 public:
  Places(const Solid& s, double beside_mm) : beside(beside_mm), s_(s) {}
  const double beside;  ///< how far beside a surface
  void at(double x, double y, double z) { out.push_back(s_.frame.to_parent({x, y, z})); }
  void at(Vec2 p, double z) { at(p.x, p.y, z); }
  std::vector<Vec3> out;

 private:
  const Solid& s_;
};

/// Places beside an outline, on both sides.
std::vector<Vec2> both_sides(const Outline& o, double beside) {
  std::vector<Vec2> out;
  const std::size_t n = o.edges.size(), stride = std::max<std::size_t>(1, n / kMostEdges);
  for (std::size_t i = 0; i < n; i += stride) {
    const Edge& e = o.edges[i];
    for (const double share : {0.25, 0.5, 0.75}) {
      if (!e.arc() && share != 0.5) continue;
      const Vec2 p = e.at(share), d = e.along(share), left{-d.y, d.x};
      for (const double k : {-1.0, 1.0, 40.0, -40.0}) out.push_back(p + (k * beside) * left);
    }
    const Edge& next = o.edges[(i + 1) % n];
    const Vec2 u = e.along(1.0), v = next.along(0.0);
    if (std::abs(cross(u, v)) < 0.1) continue;
    // In a sharp corner, and opposite to it.
    const Vec2 in = v - u;
    const double len = norm(in);
    if (!(len > 1e-6)) continue;
    for (const double k : {-3.0, 3.0, 20.0}) out.push_back(e.to + (k * beside / len) * in);
  }
  return out;
}

void area(const Area& a, const Solid& s, Places& p) {
  const double d = s.depth_mm, beside = p.beside;
  const double low = -d + std::min(beside, 0.25 * d);
  std::vector<Vec2> places = both_sides(a.outline, beside);
  for (const Standing& b : a.standing) {
    const auto more = both_sides(b.outline, beside);
    places.insert(places.end(), more.begin(), more.end());
    const Vec2 middle = 0.5 * (b.outline.lo + b.outline.hi);
    for (const double z : {b.top_mm + beside, b.top_mm - beside, low}) p.at(middle, z);
  }
  for (const Vec2 q : places) {
    for (const double z : {-0.5 * d, low}) p.at(q, z);
  }
  // A step's outline goes on for ever: what is near to its walls is looked at.
  Vec2 lo{1e300, 1e300}, hi{-1e300, -1e300};
  for (const Edge& e : a.outline.edges) {
    if (e.open && a.only_mm > 0.0) continue;
    for (const Vec2 q : {e.from, e.to}) {
      lo = {std::min(lo.x, q.x), std::min(lo.y, q.y)};
      hi = {std::max(hi.x, q.x), std::max(hi.y, q.y)};
    }
  }
  if (a.only_mm > 0.0) {
    const Vec2 by{0.5 * kSaidBeside, 0.5 * kSaidBeside};
    lo = lo - by;
    hi = hi + by;
  }
  const double floor[] = {-d + beside, -d - beside, -beside};
  for (int i = 0; i <= kGrid; ++i) {
    for (int k = 0; k <= kGrid; ++k) {
      const Vec2 q{lo.x + (hi.x - lo.x) * (i + 0.03) / (kGrid + 0.1),
                   lo.y + (hi.y - lo.y) * (k + 0.04) / (kGrid + 0.1)};
      for (const double z : floor) p.at(q, z);
    }
  }
}

void bore(const Bore& b, const Solid& s, Places& p) {
  const double d = s.depth_mm, beside = p.beside;
  const double end = d + (b.bottom == Bore::Bottom::kCone ? b.tip_mm : 0.0);
  for (const double z : {-beside, -0.5 * d, -d + beside, -end + 3.0 * beside, -end - beside, -1.5 * end})
    p.at(0.0, 0.0, z);
  constexpr int kRound = 8;
  for (int i = 0; i < kRound; ++i) {
    const double a = 2.0 * std::numbers::pi * i / kRound, c = std::cos(a), n = std::sin(a);
    for (const double share : {0.02, 0.5, 0.98}) {
      const double z = -d * share;
      const double r = b.top_radius_mm + share * (b.bottom_radius_mm - b.top_radius_mm);
      for (const double k : {r - beside, r + beside}) {
        if (k > 0.0) p.at(k * c, k * n, z);
      }
    }
    if (i % 2 != 0) continue;
    for (const double share : {0.5, 0.95}) {
      const double r = share * b.bottom_radius_mm;
      double z = -d;
      if (b.bottom == Bore::Bottom::kCone) z -= b.tip_mm * (1.0 - share);
      for (const double k : {-2.0, 2.0}) p.at(r * c, r * n, z + k * beside);
    }
  }
}

void groove(const Groove& g, const Solid& s, Places& p) {
  const double beside = p.beside;
  struct InSection {
    double across, height;
  };
  std::vector<InSection> section;
  for (const Vec2 q : both_sides(g.section, beside)) section.push_back({q.x, q.y});
  section.push_back({0.0, beside});
  section.push_back({0.0, -beside});
  section.push_back({0.0, 0.5 * s.depth_mm});
  const std::size_t n = g.course.edges.size(), stride = std::max<std::size_t>(1, n / 24);
  for (std::size_t i = 0; i < n; i += stride) {
    const Edge& e = g.course.edges[i];
    for (const double share : {0.02, 0.5, 0.98}) {
      const Vec2 q = e.at(share), d = e.along(share), left{-d.y, d.x};
      for (const InSection& w : section) p.at(q + w.across * left, w.height - s.depth_mm);
    }
  }
  for (const int end : {0, 1}) {
    const Edge& e = end == 0 ? g.course.edges.front() : g.course.edges.back();
    const Vec2 q = e.at(end), d = (end == 0 ? -1.0 : 1.0) * e.along(end), left{-d.y, d.x};
    for (const double way : {-beside, beside, 0.7 * g.half_mm, g.half_mm - beside, g.half_mm + beside}) {
      for (const double side : {-0.69 * g.half_mm, 0.0, 0.69 * g.half_mm}) {
        for (const double z : {-0.1 * s.depth_mm, -0.5 * s.depth_mm, -s.depth_mm + beside})
          p.at(q + way * d + side * left, z);
      }
    }
  }
}

void bevel(const Bevel& b, Places& p) {
  const double beside = p.beside;
  const std::size_t n = b.outline.edges.size(), stride = std::max<std::size_t>(1, n / kMostEdges);
  for (std::size_t i = 0; i < n; i += stride) {
    const Edge& e = b.outline.edges[i];
    for (const double share : {0.25, 0.75}) {
      const Vec2 q = e.at(share), d = e.along(share), left{-d.y, d.x};
      for (const double side : {-1.0, 1.0}) {
        for (const double across : {beside, 0.5 * b.width_mm, b.width_mm + beside}) {
          const double at = b.depth_mm * std::max(0.0, 1.0 - across / b.width_mm);
          for (const double deep : {0.5 * at, at - 2.0 * beside, at + 2.0 * beside, 0.1 * b.depth_mm})
            p.at(q + (side * across) * left, -deep);
        }
      }
    }
  }
}

}  // namespace

std::vector<Vec3> places_of(const Solid& s, double tolerance_mm) {
  Places p(s, 2.0 * tolerance_mm);
  if (const auto* a = std::get_if<Area>(&s.form)) area(*a, s, p);
  if (const auto* b = std::get_if<Bore>(&s.form)) bore(*b, s, p);
  if (const auto* g = std::get_if<Groove>(&s.form)) groove(*g, s, p);
  if (const auto* v = std::get_if<Bevel>(&s.form)) bevel(*v, p);
  return std::move(p.out);
}

}  // namespace capstan::verify::volumes
