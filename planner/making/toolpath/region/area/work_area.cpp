#include "planner/making/toolpath/region/area/work_area.h"

#include <algorithm>
#include <cmath>

#include "planner/making/toolpath/region/area/track.h"
#include "planner/model/features/fillet_slack.h"

namespace capstan::toolpath {

using geometry::Region;
using geometry::Vec2;

namespace {
constexpr double kSameHeight = 1e-6;
}

Region in_setup(const Region& r, const geometry::Placement& frame) {
  Region out = r;
  for (auto& loop : out.loops) {
    for (Vec2& p : loop) p = xy(frame.to_parent({p.x, p.y, 0.0}));
  }
  return out;
}

Region inset(const Region& r, double d_mm, double chord_mm) {
  if (std::abs(d_mm) < 1e-9 || r.empty()) return r;
  const double chord = std::min(chord_mm, 0.5 * std::abs(d_mm));
  // `offset` keeps its chords outside |delta| by growing delta by the chord error; undone here, so that
  // straight walls are met exactly.
  const double delta = std::copysign(std::abs(d_mm) - chord, -d_mm);
  return simplified(geometry::offset(r, delta, chord), 0.2 * chord_mm);
}

Result<WorkArea> work_area(const PathJob& task) {
  const auto& f = task.feature_in_setup;
  if (f.z.z < 1.0 - 1e-9) {
    return fail({.code = "TPA-FRAME",
                 .message = "the feature " + task.shape.name + " is tilted against the tool axis",
                 .path = task.shape.name,
                 .hint = "machine it in a set-up whose z axis is the feature's"});
  }
  WorkArea w;
  const auto& s = task.shape;
  w.area = in_setup(s.area, f);
  w.reach = s.reach.empty() ? w.area : in_setup(s.reach, f);
  for (const auto& i : s.islands) {
    w.islands.push_back({in_setup(i.area, f), f.origin.z + i.top_z_mm});
    // The reach has no hole for islands here: whether one counts depends on the height.
    w.reach = geometry::unite(
        w.reach, s.open ? w.islands.back().area : geometry::intersect(w.islands.back().area, w.area));
  }
  w.avoid = task.avoid;
  w.top_z_mm = f.origin.z;
  w.bottom_z_mm = f.origin.z - s.depth_mm;
  if (s.through) w.bottom_z_mm -= task.break_through_mm;
  w.slope_rad = s.slope_rad;
  w.bottom_radius_mm = s.through ? 0.0 : model::largest_fillet_mm(s);
  // A closed outline that runs over the piece's edge is open there.
  constexpr double kOverMm2 = 1e-3;
  w.open =
      s.open || (!task.stock.empty() && geometry::area(geometry::subtract(w.area, task.stock)) > kOverMm2);
  w.material = task.stock.empty() ? w.area : task.stock;
  if (w.open && !task.stock.empty()) w.area = geometry::intersect(w.area, task.stock);
  return w;
}

namespace {

/// How far a cutter's centre keeps from what stands: in all, and of it what goes straight past sharp corners.
struct Distances {
  double all_mm = 0.0, foot_mm = 0.0;
};

// Past a sharp corner of what stands the fillets at its foot meet in a mitre. The foot's outline, with sharp
// corners, is what the rest of the cutter goes round: so it makes the mitre, and nothing is left at the wall
// above, for what is gone round at one distance from a sharp corner leaves it sharp.
Distances distances(const WorkArea& w, const model::Cutter& cutter, double tip_z_mm, double allowance_mm) {
  const double above = std::max(0.0, tip_z_mm - w.bottom_z_mm);
  // In the fillet between wall and bottom the cutter's own corner must stay inside the larger radius.
  double fillet = 0.0;
  const double spare = w.bottom_radius_mm - cutter.corner_radius_mm;
  if (spare > model::kFilletSlackMm && above < spare) {
    const double rise = spare - above;
    fillet = spare - std::sqrt((spare - rise) * (spare + rise));
  }
  return {0.5 * cutter.cutting_diameter_mm + allowance_mm + fillet,
          fillet + std::min(cutter.corner_radius_mm, w.bottom_radius_mm)};
}

}  // namespace

Region centres_at(const WorkArea& w, const model::Cutter& cutter, double tip_z_mm, double allowance_mm,
                  double allowance_bottom_mm) {
  const double run = std::max(0.0, tip_z_mm - w.bottom_z_mm) * std::tan(w.slope_rad);
  Region keep = w.reach;
  if (w.open) {
    // Beyond an open side a cutter needs room to leave the material, not more.
    const double room = cutter.cutting_diameter_mm + 2.0 + allowance_mm;
    keep = geometry::intersect(keep, geometry::offset_sharp(w.area, room));
  }
  if (run > 0.0) keep = inset(keep, -run, kWallChord);
  for (const auto& i : w.islands) {
    if (i.top_z_mm + allowance_bottom_mm <= tip_z_mm + kSameHeight) continue;
    // An island's flank leans inwards going up.
    keep = geometry::subtract(keep, run > 0.0 ? inset(i.area, run, kWallChord) : i.area);
  }
  if (!w.avoid.empty()) keep = geometry::subtract(keep, w.avoid);
  const Distances d = distances(w, cutter, tip_z_mm, allowance_mm);
  if (d.foot_mm > 0.0 && geometry::has_sharp_inner_corner(keep))
    return inset(geometry::offset_sharp(keep, -d.foot_mm), d.all_mm - d.foot_mm, kWallChord);
  return inset(keep, d.all_mm, kWallChord);
}

Region kept_off(const WorkArea& w, const Region& islands, const model::Cutter& cutter, double tip_z_mm,
                double allowance_mm) {
  if (islands.empty()) return islands;
  const Distances d = distances(w, cutter, tip_z_mm, allowance_mm);
  Region beside = islands;
  for (geometry::Loop& loop : beside.loops) std::reverse(loop.begin(), loop.end());
  if (d.foot_mm > 0.0 && geometry::has_sharp_inner_corner(beside))
    return inset(geometry::offset_sharp(islands, d.foot_mm), -(d.all_mm - d.foot_mm), kWallChord);
  return inset(islands, -d.all_mm, kWallChord);
}

std::vector<double> levels(const WorkArea& w, double start_z_mm, double end_z_mm, double step_mm,
                           double allowance_bottom_mm) {
  std::vector<double> stops;
  for (const auto& i : w.islands) {
    const double z = i.top_z_mm + allowance_bottom_mm;
    if (z < start_z_mm - kSameHeight && z > end_z_mm + kSameHeight) stops.push_back(z);
  }
  stops.push_back(end_z_mm);
  std::sort(stops.begin(), stops.end(), std::greater<>());
  std::vector<double> out;
  double from = start_z_mm;
  for (const double to : stops) {
    const double depth = from - to;
    if (depth <= kSameHeight) continue;
    const int n = step_mm > 0.0 ? std::max(1, static_cast<int>(std::ceil(depth / step_mm - 1e-9))) : 1;
    for (int i = 1; i < n; ++i) out.push_back(from - depth * i / n);
    out.push_back(to);
    from = to;
  }
  return out;
}

}  // namespace capstan::toolpath
