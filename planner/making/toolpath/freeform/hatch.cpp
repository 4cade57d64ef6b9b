#include "planner/making/toolpath/freeform/hatch.h"

#include <algorithm>
#include <cmath>

namespace capstan::toolpath::freeform {

using geometry::Vec2;

namespace {
/// Where the boundary crosses the height v; even in number.
std::vector<double> crossings(const std::vector<geometry::Loop>& loops, double v) {
  std::vector<double> out;
  for (const geometry::Loop& loop : loops) {
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const Vec2 a = loop[i];
      const Vec2 b = loop[(i + 1) % loop.size()];
      if ((a.y <= v) == (b.y <= v)) continue;
      out.push_back(a.x + (v - a.y) / (b.y - a.y) * (b.x - a.x));
    }
  }
  std::sort(out.begin(), out.end());
  return out;
}
}  // namespace

Hatch hatch(const geometry::Region& area, double angle_rad, double stepover_mm) {
  Hatch out;
  out.u_axis = {std::cos(angle_rad), std::sin(angle_rad)};
  out.v_axis = {-out.u_axis.y, out.u_axis.x};
  std::vector<geometry::Loop> turned = area.loops;
  double lo = 1e300;
  double hi = -1e300;
  for (auto& loop : turned) {
    for (Vec2& p : loop) {
      p = {dot(p, out.u_axis), dot(p, out.v_axis)};
      lo = std::min(lo, p.y);
      hi = std::max(hi, p.y);
    }
  }
  if (lo > hi) return out;
  constexpr double kInset = 1e-6;  // a line along a side would neither cross it nor miss it
  lo += kInset;
  hi -= kInset;
  const int gaps = std::max(1, static_cast<int>(std::ceil((hi - lo) / stepover_mm - 1e-9)));
  out.spacing_mm = (hi - lo) / gaps;
  for (int line = 0; line <= gaps; ++line) {
    const double v = line == gaps ? hi : lo + line * out.spacing_mm;
    const std::vector<double> at = crossings(turned, v);
    for (std::size_t k = 0; k + 1 < at.size(); k += 2) {
      if (at[k + 1] - at[k] > 1e-6) out.stripes.push_back({line, v, at[k], at[k + 1]});
    }
  }
  return out;
}

}  // namespace capstan::toolpath::freeform
