#include "planner/physics/stock/planar/probe.h"

#include <algorithm>
#include <cmath>

namespace capstan::stock {

using geometry::Vec2;

void Cuts::sort() { std::sort(x_.begin(), x_.begin() + static_cast<std::ptrdiff_t>(size_)); }

Probe Probe::front(Vec2 centre, Vec2 unit_heading, double radius_mm) {
  return {.origin = centre,
          .along = {unit_heading.y, -unit_heading.x},
          .ahead = unit_heading,
          .radius_mm = radius_mm,
          .lo = -radius_mm,
          .hi = radius_mm};
}

Probe Probe::straight(Vec2 origin, Vec2 unit_along, double lo, double hi) {
  return {.origin = origin, .along = unit_along, .ahead = {}, .radius_mm = 0.0, .lo = lo, .hi = hi};
}

Vec2 Probe::at(double x) const {
  const Vec2 p = origin + x * along;
  if (radius_mm <= 0.0) return p;
  return p + std::sqrt(std::max(0.0, (radius_mm - x) * (radius_mm + x))) * ahead;
}

void Probe::cross_line(Vec2 n, double d, Cuts& out) const {
  const double rest = d - dot(n, origin);
  const double nx = dot(n, along);
  if (radius_mm <= 0.0) {
    if (nx == 0.0) return;
    const double x = rest / nx;
    if (x > lo && x < hi) out.add(x);
    return;
  }
  const double square = (radius_mm - rest) * (radius_mm + rest);
  if (square <= 0.0) return;
  const double ny = dot(n, ahead);
  const double half = std::sqrt(square);
  if (rest * ny + half * nx >= 0.0) out.add(rest * nx - half * ny);
  if (rest * ny - half * nx >= 0.0) out.add(rest * nx + half * ny);
}

void Probe::cross_circle(Vec2 centre, double r, Cuts& out) const {
  const Vec2 to = centre - origin;
  if (radius_mm <= 0.0) {
    const double x = dot(to, along);
    const double y = cross(along, to);
    const double square = (r - y) * (r + y);
    if (square <= 0.0) return;
    const double half = std::sqrt(square);
    if (x - half > lo && x - half < hi) out.add(x - half);
    if (x + half > lo && x + half < hi) out.add(x + half);
    return;
  }
  const double distance2 = dot(to, to);
  if (distance2 <= 0.0) return;
  const double distance = std::sqrt(distance2);
  const double k = (distance2 + (radius_mm - r) * (radius_mm + r)) / (2.0 * distance);
  cross_line((1.0 / distance) * to, dot(to, origin) / distance + k, out);
}

void Heights::reset(double lo, double hi, double z_mm) {
  pieces_.clear();
  pieces_.push_back({lo, hi, z_mm});
}

// Neighbours differ in height, so that only those next to what changes can become one with it.
bool Heights::lower(double x0, double x1, double z_mm) {
  const auto begins_after = [](double x, const Piece& p) { return x < p.x1; };
  const auto from = std::upper_bound(pieces_.begin(), pieces_.end(), x0, begins_after);
  auto first = from;
  while (first != pieces_.end() && first->x0 < x1 && !(first->z_mm > z_mm)) ++first;
  if (first == pieces_.end() || !(first->x0 < x1)) return false;
  auto last = first;  // behind the last one that is lowered
  for (auto p = first; p != pieces_.end() && p->x0 < x1; ++p) {
    if (p->z_mm > z_mm) last = p + 1;
  }
  if (first != pieces_.begin()) --first;
  if (last != pieces_.end()) ++last;
  const auto before = last - first;
  const auto most = 3 * static_cast<std::size_t>(before);  // of each piece its middle and what is beside it
  if (changed_.size() < most) changed_.resize(most);
  Piece* const begin = changed_.data();
  Piece* end = begin;
  const auto push = [&](double a, double b, double z) {
    if (!(b > a)) return;
    if (end != begin && end[-1].z_mm == z) {
      end[-1].x1 = b;
    } else {
      *end++ = {a, b, z};
    }
  };
  for (auto p = first; p != last; ++p) {
    if (p->z_mm <= z_mm || p->x1 <= x0 || p->x0 >= x1) {
      push(p->x0, p->x1, p->z_mm);
      continue;
    }
    push(p->x0, x0, p->z_mm);
    push(std::max(p->x0, x0), std::min(p->x1, x1), z_mm);
    push(x1, p->x1, p->z_mm);
  }
  if (end - begin <= before) {
    pieces_.erase(std::copy(begin, end, first), last);
  } else {
    const auto rest = std::copy(begin, begin + before, first);
    pieces_.insert(rest, begin + before, end);
  }
  return true;
}

bool Heights::narrow(double& x0, double& x1, double above_mm) const {
  double from = x1;
  double to = x0;
  for (const Piece& p : pieces_) {
    if (p.z_mm <= above_mm || p.x1 <= x0 || p.x0 >= x1) continue;
    from = std::min(from, std::max(p.x0, x0));
    to = std::max(to, std::min(p.x1, x1));
  }
  x0 = from;
  x1 = to;
  return to > from;
}

Heights::Piece Heights::standing(double above_mm) const {
  Piece out{1e300, -1e300, -1e300};
  for (const Piece& p : pieces_) {
    out.z_mm = std::max(out.z_mm, p.z_mm);
    if (p.z_mm <= above_mm) continue;
    out.x0 = std::min(out.x0, p.x0);
    out.x1 = std::max(out.x1, p.x1);
  }
  return out;
}

}  // namespace capstan::stock
