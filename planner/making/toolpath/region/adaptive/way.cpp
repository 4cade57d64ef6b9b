#include "planner/making/toolpath/region/adaptive/way.h"

#include <algorithm>

#include "planner/ground/base/stopping.h"
#include "planner/making/toolpath/region/area/track.h"

// A shortest way among polygons bends at reflex vertices only (T. Lozano-Perez and M. A. Wesley,
// Communications of the ACM 22, 1979). Dijkstra's search looks at each pair of vertices once at most.

namespace capstan::toolpath {

using geometry::Vec2;

namespace {
constexpr double kAway = 0.1;     // mm between corners of ways and the region's boundary
constexpr double kCoarse = 0.08;  // mm; less than kAway
constexpr std::size_t kMostCorners = 250;
}  // namespace

Ways::Ways(const geometry::Region& free) : free_(free), region_(free) {}

void Ways::find_corners() {
  searched_ = true;
  for (const auto& loop : simplified(region_, kCoarse).loops) {
    const std::size_t n = loop.size();
    for (std::size_t i = 0; i < n; ++i) {
      const Vec2 in = loop[i] - loop[(i + n - 1) % n];
      const Vec2 out = loop[(i + 1) % n] - loop[i];
      const double a = norm(in);
      const double b = norm(out);
      if (a < 1e-9 || b < 1e-9 || cross(in, out) >= 0.0) continue;
      // Away from both edges, to their left.
      const Vec2 normal = (1.0 / a) * Vec2{-in.y, in.x} + (1.0 / b) * Vec2{-out.y, out.x};
      const double l = norm(normal);
      if (l > 0.1) corners_.push_back(loop[i] + (kAway / l) * normal);
    }
  }
}

std::optional<std::vector<Vec2>> Ways::between(Vec2 a, Vec2 b) {
  if (free_.contains(a, b)) return std::vector<Vec2>{a, b};
  if (!searched_) find_corners();
  if (corners_.size() > kMostCorners) return std::nullopt;
  std::vector<Vec2> nodes = {a, b};
  nodes.insert(nodes.end(), corners_.begin(), corners_.end());
  const std::size_t n = nodes.size();
  std::vector<double> length(n, 1e300);
  std::vector<std::size_t> before(n, 0);
  std::vector<bool> done(n, false);
  length[0] = 0.0;
  for (;;) {
    tick();
    std::size_t at = n;
    for (std::size_t i = 0; i < n; ++i) {
      if (!done[i] && length[i] < 1e299 && (at == n || length[i] < length[at])) at = i;
    }
    if (at == n) return std::nullopt;
    if (at == 1) break;
    done[at] = true;
    for (std::size_t i = 1; i < n; ++i) {
      if (done[i]) continue;
      const double l = length[at] + norm(nodes[i] - nodes[at]);
      if (l >= length[i] || !free_.contains(nodes[at], nodes[i])) continue;
      length[i] = l;
      before[i] = at;
    }
  }
  std::vector<Vec2> out = {b};
  for (std::size_t i = before[1]; i != 0; i = before[i]) out.push_back(nodes[i]);
  out.push_back(a);
  std::reverse(out.begin(), out.end());
  return out;
}

}  // namespace capstan::toolpath
