#include "planner/proof/verify/sweep/apart.h"

#include <algorithm>

namespace capstan::verify {

using geometry::Vec2;

namespace {

double to_segment(Vec2 p, Vec2 a, Vec2 b) {
  const Vec2 d = b - a;
  const double n = dot(d, d);
  const double t = n > 0.0 ? std::clamp(dot(p - a, d) / n, 0.0, 1.0) : 0.0;
  return norm(p - (a + t * d));
}

bool crosses(Vec2 a, Vec2 b, Vec2 c, Vec2 d) {
  const double s1 = cross(b - a, c - a), s2 = cross(b - a, d - a);
  const double s3 = cross(d - c, a - c), s4 = cross(d - c, b - c);
  return ((s1 > 0.0) != (s2 > 0.0)) && ((s3 > 0.0) != (s4 > 0.0));
}

bool inside(const std::vector<Vec2>& polygon, Vec2 p) {
  bool in = false;
  for (std::size_t i = 0, k = polygon.size() - 1; i < polygon.size(); k = i++) {
    const Vec2 a = polygon[i], b = polygon[k];
    if ((a.y > p.y) != (b.y > p.y) && p.x < (b.x - a.x) * (p.y - a.y) / (b.y - a.y) + a.x) in = !in;
  }
  return in;
}

}  // namespace

double apart(const std::vector<Vec2>& a, const std::vector<Vec2>& b) {
  if (b.size() > 2 && inside(b, a.front())) return 0.0;
  if (a.size() > 2 && inside(a, b.front())) return 0.0;
  double best = 1e300;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const Vec2 a0 = a[i], a1 = a[(i + 1) % a.size()];
    for (std::size_t k = 0; k < b.size(); ++k) {
      const Vec2 b0 = b[k], b1 = b[(k + 1) % b.size()];
      if (crosses(a0, a1, b0, b1)) return 0.0;
      best = std::min({best, to_segment(a0, b0, b1), to_segment(a1, b0, b1), to_segment(b0, a0, a1),
                       to_segment(b1, a0, a1)});
    }
  }
  return best;
}

}  // namespace capstan::verify
