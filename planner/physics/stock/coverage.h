#pragma once

#include <algorithm>
#include <cmath>

#include "planner/ground/geometry/vec.h"

namespace capstan::stock {

/// The part of a square cell that lies on the inner side of a straight edge, in [0, 1].
/// `inside_mm`: distance of the cell's centre from the edge, positive inside. `normal`: across the edge, of
/// any length and sign.
/// Source  derived: area of a square cut by a line.
[[nodiscard]] inline double coverage(double inside_mm, geometry::Vec2 normal, double cell_mm) {
  const double length = std::sqrt(dot(normal, normal));
  double a = 1.0;
  double b = 0.0;
  if (length > 0.0) {
    a = std::max(std::abs(normal.x), std::abs(normal.y)) / length;
    b = std::min(std::abs(normal.x), std::abs(normal.y)) / length;
  }
  const double s = std::abs(inside_mm) / cell_mm;
  double above = 0.0;  // beyond half of the cell
  if (s >= 0.5 * (a + b)) {
    above = 0.5;
  } else if (s <= 0.5 * (a - b)) {
    above = s / a;
  } else {
    const double rest = 0.5 * (a + b) - s;
    above = 0.5 - rest * rest / (2.0 * a * b);
  }
  return inside_mm >= 0.0 ? 0.5 + above : 0.5 - above;
}

struct Span {
  double lo = 1e300, hi = -1e300;
  void add(double v) {
    lo = std::min(lo, v);
    hi = std::max(hi, v);
  }
};

/// The x values that a disc of this radius, moved from a to b, covers at height y; empty: lo > hi.
[[nodiscard]] inline Span capsule_row(geometry::Vec2 a, geometry::Vec2 b, double radius, double y) {
  Span out;
  for (const geometry::Vec2 c : {a, b}) {
    const double h2 = radius * radius - (y - c.y) * (y - c.y);
    if (h2 < 0.0) continue;
    const double h = std::sqrt(h2);
    out.add(c.x - h);
    out.add(c.x + h);
  }
  const geometry::Vec2 d = b - a;
  const double length = std::sqrt(dot(d, d));
  if (length <= 0.0) return out;
  const geometry::Vec2 n{-d.y / length * radius, d.x / length * radius};
  for (const double side : {-1.0, 1.0}) {
    const double y0 = a.y + side * n.y;
    const double y1 = b.y + side * n.y;
    if (y0 == y1) continue;
    const double t = (y - y0) / (y1 - y0);
    if (t >= 0.0 && t <= 1.0) out.add(a.x + side * n.x + t * d.x);
  }
  return out;
}

}  // namespace capstan::stock
