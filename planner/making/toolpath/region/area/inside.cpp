#include "planner/making/toolpath/region/area/inside.h"

#include <algorithm>
#include <cmath>

namespace capstan::toolpath {

using geometry::Vec2;

namespace {

/// Whether p lies nearer than a distance to the straight line from a to b.
bool within(Vec2 p, Vec2 a, Vec2 b, double distance_mm) {
  const Vec2 d = b - a;
  const double l2 = dot(d, d);
  const double t = l2 > 0.0 ? std::clamp(dot(p - a, d) / l2, 0.0, 1.0) : 0.0;
  const Vec2 q = p - (a + t * d);
  return dot(q, q) < distance_mm * distance_mm;
}

bool cross_each_other(Vec2 a, Vec2 b, Vec2 c, Vec2 d) {
  const double a1 = cross(b - a, c - a);
  const double a2 = cross(b - a, d - a);
  const double b1 = cross(d - c, a - c);
  const double b2 = cross(d - c, b - c);
  return ((a1 > 0.0) != (a2 > 0.0)) && ((b1 > 0.0) != (b2 > 0.0));
}

}  // namespace

Inside::Inside(const geometry::Region& region) {
  std::size_t n = 0;
  for (const auto& loop : region.loops) n += loop.size();
  if (n == 0) return;
  const auto box = geometry::bounds(region);
  const auto count = static_cast<int>(std::clamp<std::size_t>(n / 2, 1, 4096));
  y0_ = box.lo.y;
  height_ = std::max((box.hi.y - box.lo.y) / count, 1e-9);
  strips_.resize(static_cast<std::size_t>(count));
  for (const auto& loop : region.loops) {
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const Edge e{loop[i], loop[(i + 1) % loop.size()]};
      const int from = strip(std::min(e.a.y, e.b.y));
      const int to = strip(std::max(e.a.y, e.b.y));
      for (int s = from; s <= to; ++s) strips_[static_cast<std::size_t>(s)].push_back(e);
    }
  }
}

int Inside::strip(double y) const {
  const double s = std::floor((y - y0_) / height_);
  return static_cast<int>(std::clamp(s, 0.0, static_cast<double>(strips_.size()) - 1.0));
}

bool Inside::contains(Vec2 p) const {
  if (strips_.empty()) return false;
  int winding = 0;
  for (const Edge& e : strips_[static_cast<std::size_t>(strip(p.y))]) {
    const bool up = e.a.y <= p.y && p.y < e.b.y;
    const bool down = e.b.y <= p.y && p.y < e.a.y;
    if (!up && !down) continue;
    const double side = cross(e.b - e.a, p - e.a);
    if (up && side > 0.0) ++winding;
    if (down && side < 0.0) --winding;
  }
  return winding > 0;
}

bool Inside::contains(Vec2 a, Vec2 b) const {
  if (!contains(a) || !contains(b)) return false;
  const int from = strip(std::min(a.y, b.y));
  const int to = strip(std::max(a.y, b.y));
  const double xlo = std::min(a.x, b.x);
  const double xhi = std::max(a.x, b.x);
  for (int s = from; s <= to; ++s) {
    for (const Edge& e : strips_[static_cast<std::size_t>(s)]) {
      if (std::max(e.a.x, e.b.x) < xlo || std::min(e.a.x, e.b.x) > xhi) continue;
      if (cross_each_other(a, b, e.a, e.b)) return false;
    }
  }
  return true;
}

bool Inside::clear_along(Vec2 a, Vec2 b, double radius_mm) const {
  if (!clear_of(a, radius_mm) || !clear_of(b, radius_mm)) return false;
  if (strips_.empty()) return true;
  // Besides the ends only the edges' corners can be nearest to the way, unless an edge crosses it.
  const int from = strip(std::min(a.y, b.y) - radius_mm);
  const int to = strip(std::max(a.y, b.y) + radius_mm);
  for (int s = from; s <= to; ++s) {
    for (const Edge& e : strips_[static_cast<std::size_t>(s)]) {
      if (within(e.a, a, b, radius_mm) || cross_each_other(a, b, e.a, e.b)) return false;
    }
  }
  return true;
}

bool Inside::boundary_within(Vec2 p, double radius_mm) const {
  if (strips_.empty()) return false;
  const int from = strip(p.y - radius_mm);
  const int to = strip(p.y + radius_mm);
  for (int s = from; s <= to; ++s) {
    for (const Edge& e : strips_[static_cast<std::size_t>(s)]) {
      if (within(p, e.a, e.b, radius_mm)) return true;
    }
  }
  return false;
}

}  // namespace capstan::toolpath
