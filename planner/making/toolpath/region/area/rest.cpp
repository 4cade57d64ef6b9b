#include "planner/making/toolpath/region/area/rest.h"

#include <algorithm>
#include <cmath>

#include "planner/making/toolpath/defaults.h"

namespace capstan::toolpath {

using geometry::Region;
using geometry::Vec2;

namespace {

constexpr double kCrumb = 1e-3;         ///< mm2 that count as nothing
constexpr std::size_t kMostAir = 4000;  ///< places looked at

/// The area that the wider cutter removed at this height.
Region taken(const PathJob& task, const WorkArea& w, double z_mm) {
  const Cleared& by = *task.cleared_by;
  model::Cutter wide = task.cutter;
  wide.cutting_diameter_mm = by.diameter_mm;
  wide.corner_radius_mm = by.corner_radius_mm;
  const Region stood = centres_at(w, wide, z_mm, by.allowance_side_mm, task.allowance_bottom_mm);
  if (stood.empty()) return {};
  double reach = 0.5 * by.diameter_mm;
  // A larger corner radius than required leaves a fillet along the floor, which counts as rest.
  const double wanted =
      std::max({task.cutter.corner_radius_mm, task.allowance_bottom_mm, w.bottom_radius_mm});
  if (by.corner_radius_mm > wanted + 1e-9) reach -= by.corner_radius_mm;
  return inset(stood, -reach, kInnerChord);
}

Region opened(const Region& r, double by_mm) { return geometry::offset(geometry::offset(r, -by_mm), by_mm); }

std::vector<Vec2> places(const Region& r, double step_mm) {
  std::vector<Vec2> out;
  for (const auto& loop : r.loops) {
    for (std::size_t i = 0; i < loop.size() && out.size() < kMostAir; ++i) {
      const Vec2 a = loop[i];
      const Vec2 d = loop[(i + 1) % loop.size()] - a;
      const int n = std::clamp(static_cast<int>(norm(d) / step_mm), 1, 200);
      for (int k = 0; k < n; ++k) out.push_back(a + (static_cast<double>(k) / n) * d);
    }
  }
  return out;
}

}  // namespace

double narrow_to_rest(const PathJob& task, const WorkArea& w, Level& level) {
  const double radius = 0.5 * task.cutter.cutting_diameter_mm;
  const Region reach = inset(level.centres, -radius, kInnerChord);
  const Region cleared = taken(task, w, level.z_mm);
  const Region left = cleared.empty() ? reach : opened(geometry::subtract(reach, cleared), 0.5 * kFeather);
  const double area = geometry::area(left);
  if (area < kCrumb) return 0.0;
  if (cleared.empty()) return area;
  // As few centres as reach all of it; along the walls at least as far as the feather edge runs out:
  // two arcs part by x^2 / 2R at most.
  const double feather = std::sqrt(2.0 * kFeather * 0.5 * task.cleared_by->diameter_mm) + 0.2;
  const Region all = level.centres;
  for (const double part : {0.25, 0.5, 0.75, 1.0, 1.5}) {
    level.centres = geometry::intersect(all, geometry::offset(left, std::max(part * radius, feather), 0.01));
    const Region got = inset(level.centres, -(radius + 0.5 * kFeather), kInnerChord);
    if (geometry::area(opened(geometry::subtract(left, got), 0.25 * kFeather)) < kCrumb) break;
  }
  level.rest = geometry::intersect(reach, geometry::offset(left, feather, 0.01));
  const Region free =
      geometry::intersect(geometry::intersect(all, inset(cleared, radius + kAirBeside, kInnerChord)),
                          geometry::offset(level.centres, 2.0 * radius, 0.05));
  level.air = places(free, 0.5 * radius);
  return area;
}

}  // namespace capstan::toolpath
