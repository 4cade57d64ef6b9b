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

void Heights::push(double x0, double x1, double z_mm) {
  if (!(x1 > x0)) return;
  if (!scratch_.empty() && scratch_.back().z_mm == z_mm) {
    scratch_.back().x1 = x1;
  } else {
    scratch_.push_back({x0, x1, z_mm});
  }
}

bool Heights::lower(double x0, double x1, double z_mm) {
  bool any = false;
  for (const Piece& p : pieces_) any = any || (p.z_mm > z_mm && p.x0 < x1 && p.x1 > x0);
  if (!any) return false;
  scratch_.clear();
  for (const Piece& p : pieces_) {
    if (p.z_mm <= z_mm || p.x1 <= x0 || p.x0 >= x1) {
      push(p.x0, p.x1, p.z_mm);
      continue;
    }
    push(p.x0, x0, p.z_mm);
    push(std::max(p.x0, x0), std::min(p.x1, x1), z_mm);
    push(x1, p.x1, p.z_mm);
  }
  std::swap(pieces_, scratch_);
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
