#include "planner/making/toolpath/section/section.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace capstan::toolpath {

using geometry::Vec2;
using model::FeatureShape;

namespace {

constexpr double kTiny = 1e-9;
constexpr double kArcChord = 0.001;  ///< mm between a rounded bottom and its polyline
constexpr double kFar = 1e6;         ///< mm; the part's top goes on from the wall's upper edge

tl::unexpected<Diagnostic> unsupported(const FeatureShape& s, const std::string& what) {
  return fail({.code = "TPA-UNSUPPORTED", .message = s.name + ": " + what, .path = s.name});
}

/// Points of the arc that rounds the bottom, from the middle to where it meets the flanks.
std::vector<Vec2> bottom_arc(double radius, double sweep) {
  const double step = 2.0 * std::acos(std::max(0.0, 1.0 - kArcChord / radius));
  const int n = std::clamp(static_cast<int>(std::ceil(sweep / step)), 8, 512);
  std::vector<Vec2> out;
  for (int i = 0; i <= n; ++i) {
    const double a = sweep * i / n;
    out.push_back({radius * std::sin(a), radius * (1.0 - std::cos(a))});
  }
  return out;
}

/// Cut off at the top, or carried up to it.
void close_at_top(Section& s) {
  auto& w = s.wall;
  while (w.size() > 1 && w[w.size() - 2].y > s.depth_mm) w.pop_back();
  if (w.back().y > s.depth_mm && w.size() > 1) {
    const Vec2 a = w[w.size() - 2];
    const Vec2 b = w.back();
    w.back() = a + ((s.depth_mm - a.y) / (b.y - a.y)) * (b - a);
  }
  if (w.back().y < s.depth_mm - kTiny) w.push_back({w.back().x, s.depth_mm});
}

/// Height of the cutter's end at distance rho from its axis.
double end_at(const Tip& t, double rho) {
  const double x = rho - (t.radius_mm - t.corner_mm);
  if (x <= 0.0) return 0.0;
  const double c = t.corner_mm;
  return c - std::sqrt(std::max(0.0, c * c - x * x));
}

/// Distance from the axis at which the cutter's end has a slope.
double place_of_slope(const Tip& t, double slope) {
  return t.radius_mm - t.corner_mm + t.corner_mm * slope / std::hypot(1.0, slope);
}

}  // namespace

Result<Section> slot_section(const FeatureShape& f) {
  Section s;
  s.depth_mm = f.depth_mm;
  const auto& q = f.slot_profile;
  if (q.empty()) return unsupported(f, "it has no section of its own");
  double from = -1.0;
  if (const double r = f.slot_bottom_radius_mm; r > 0.0) {
    const double sweep = 0.5 * (std::numbers::pi - f.slot_angle_rad);
    s.wall = bottom_arc(r, sweep);
    from = s.wall.back().y;
  } else if (q.front().y > kTiny || q.front().x > kTiny) {
    s.wall.push_back({0.0, 0.0});
  }
  for (const Vec2 p : q) {
    if (p.x > from + kTiny || from < 0.0) s.wall.push_back({p.y, p.x});
  }
  for (std::size_t i = 1; i < s.wall.size(); ++i) {
    if (s.wall[i].x < s.wall[i - 1].x - kTiny || s.wall[i].y < s.wall[i - 1].y - kTiny)
      return unsupported(f, "its section narrows upwards: that needs a T-slot or dovetail cutter");
  }
  close_at_top(s);
  return s;
}

Result<Section> hole_section(const FeatureShape& f, double below_mm) {
  using model::HoleBottom;
  if (f.bottom_diameter_mm > f.diameter.nominal_mm + kTiny)
    return unsupported(f, "it is wider below than above: that is not milled from above");
  if (f.bottom != HoleBottom::kFlat && f.bottom != HoleBottom::kThrough)
    return unsupported(f, "only flat and open bottoms are milled under a taper");
  Section s;
  const double below = f.bottom == HoleBottom::kThrough ? std::max(0.0, below_mm) : 0.0;
  s.floor = f.bottom != HoleBottom::kThrough;
  s.depth_mm = f.depth_mm + below;
  // Both diameters carry the tolerance of the upper one.
  const double shift = f.diameter.given ? f.diameter.middle() - f.diameter.nominal_mm : 0.0;
  const double bottom = 0.5 * (f.bottom_diameter_mm + shift);
  s.wall = {{0.0, 0.0}, {bottom, 0.0}};
  if (below > 0.0) s.wall.push_back({bottom, below});
  s.wall.push_back({0.5 * (f.diameter.nominal_mm + shift), s.depth_mm});
  return s;
}

double drop(const Section& s, const Tip& tip, double u) {
  const double reach = u + tip.radius_mm;
  double best = 0.0;
  const auto& w = s.wall;
  for (std::size_t i = 0; i < w.size(); ++i) {
    const Vec2 a = w[i];
    const Vec2 b = i + 1 < w.size() ? w[i + 1] : Vec2{a.x + kFar, a.y};
    if (a.x >= reach - kTiny) break;  // a is beside the flank
    if (b.x < u) continue;
    const double run = b.x - a.x;
    if (run < kTiny) {
      best = std::max(best, b.y - end_at(tip, std::max(0.0, b.x - u)));
      continue;
    }
    const double slope = (b.y - a.y) / run;
    const double d = std::clamp(u + place_of_slope(tip, slope), std::max(a.x, u), std::min(b.x, reach));
    best = std::max(best, a.y + slope * (d - a.x) - end_at(tip, d - u));
  }
  return best;
}

double widest_at(const Section& s, const Tip& tip, double height) {
  const double h = std::min(height, s.depth_mm - 1e-6);  // above the top it is as wide as at the top
  if (drop(s, tip, 0.0) > h + kTiny) return -1.0;
  double lo = 0.0;
  double hi = s.half_width_mm();
  if (drop(s, tip, hi) <= h + kTiny) return hi;
  for (int i = 0; i < 60; ++i) {
    const double mid = 0.5 * (lo + hi);
    (drop(s, tip, mid) <= h + kTiny ? lo : hi) = mid;
  }
  return lo;
}

double gap_to(const Tip& t, const SectionPass& at, Vec2 p) {
  const double x = std::abs(p.x - at.u_mm);
  const double y = p.y - at.height_mm;
  const double flat = t.radius_mm - t.corner_mm;
  if (y >= t.corner_mm) return x - t.radius_mm;
  if (x <= flat) return -y;
  return std::hypot(x - flat, y - t.corner_mm) - t.corner_mm;
}

}  // namespace capstan::toolpath
