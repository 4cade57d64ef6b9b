#include <algorithm>
#include <cmath>

#include "planner/base/number.h"
#include "planner/toolpath/region/patterns.h"
#include "planner/toolpath/region/region_paths.h"

namespace capstan::toolpath {

using geometry::Region;
using geometry::Vec2;
using model::MoveRole;

namespace {

/// Once round each outer contour of `kept` at a distance, the kept side where walls belong.
std::vector<Track> rings_around(const Region& grown, const Region& kept, bool natural) {
  std::vector<Track> out;
  for (const auto& loop : grown.loops) {
    if (geometry::signed_area(loop) <= 0.0) continue;
    if (geometry::intersect(Region{{loop}}, kept).empty()) continue;  // round something else
    Track t = track_of(loop);
    out.push_back(natural ? reversed(t) : t);  // clockwise round what stays: it is on the right
  }
  return out;
}

struct Around {
  const PathJob& task;
  WorkArea w;
  Region kept;
  double radius;
};

Region grown_by(const Around& a, double d) {
  Region g = d > 0.0 ? inset(a.kept, -d, kWallChord) : a.kept;
  if (!a.w.avoid.empty()) g = geometry::unite(g, inset(a.w.avoid, -a.radius, kWallChord));
  return g;
}

/// Distances of the rings from what stays, the outermost first.
std::vector<double> ring_distances(const Around& a, double step, bool shell) {
  const double first = a.radius + a.task.allowance_side_mm;
  std::vector<double> out = {first};
  if (shell || a.task.stock.empty()) return out;
  for (double d = first; out.size() < 1000; d += step) {
    // Covered so far: a radius beyond the ring.
    if (geometry::area(geometry::subtract(a.task.stock, inset(a.kept, -(d + a.radius), kInnerChord))) < 1e-3)
      break;
    out.push_back(d + step);
  }
  std::reverse(out.begin(), out.end());
  return out;
}

Status cut_around(const Around& a, LevelCutter& c, double z, double from,
                  const std::vector<double>& distances, bool shell) {
  Level level(c.task, a.w, z, shell ? z : from, a.task.allowance_side_mm);
  level.above_mm = from;
  const double room = 2.0 * a.radius + 2.0;
  const Region edge =
      geometry::offset_sharp(geometry::unite(a.w.material, grown_by(a, distances.front())), room);
  level.centres = geometry::subtract(edge, grown_by(a, distances.back()));
  level.inside = Inside(inset(level.centres, -kInsideSlack, 0.25 * kInsideSlack));
  level.air.clear();
  for (const auto& loop : edge.loops) {
    for (std::size_t i = 0; i < loop.size(); ++i) {
      for (const double t : {0.0, 0.25, 0.5, 0.75}) {
        const Vec2 p = loop[i] + t * (loop[(i + 1) % loop.size()] - loop[i]);
        if (level.material.clear_of(p, a.radius + 0.1) && level.inside.contains(p)) level.air.push_back(p);
      }
    }
  }
  if (shell) {
    level.cleared.emplace(
        geometry::subtract(edge, grown_by(a, a.radius + a.task.left_on_side_mm.value_or(0.0) + 0.02)));
  }
  bool first = true;
  for (const double d : distances) {
    const bool wall = d == distances.back();
    for (const Track& t : rings_around(grown_by(a, d), a.kept, walls_on_right(a.task))) {
      if (wall && shell && cut_with_leads(c, level, t)) continue;
      if (shell) level.from_mm = from;
      const Spot spot = c.writer.begun() ? nearest(t, xy(c.writer.at())) : Spot{};
      if (!first && c.cut_to(level, spot.point)) {
        c.writer.follow(begun_at(t, spot), z, MoveRole::kCut);
        continue;
      }
      auto in = c.enter(level, t, nullptr);
      if (!in) return tl::unexpected(in.error());
      c.writer.follow(*in, z, MoveRole::kCut);
    }
    first = false;
  }
  return {};
}

}  // namespace

Result<GeneratedPath> outside_path(const PathJob& task, Job& job) {
  auto w = work_area(task);
  if (!w) return tl::unexpected(w.error());
  Around a{.task = task, .w = *w, .kept = {}, .radius = 0.5 * task.cutter.cutting_diameter_mm};
  for (const auto& i : a.w.islands) a.kept = geometry::unite(a.kept, i.area);
  if (a.kept.empty()) {
    return fail({.code = "TPA-UNSUPPORTED",
                 .message = task.shape.name + " does not say what stays inside its contour",
                 .path = task.shape.name});
  }
  a.w.islands.clear();
  if (task.stock.empty()) a.w.material = a.w.area = geometry::offset_sharp(a.kept, a.radius);
  PathWriter writer(task);
  LevelCutter c(task, a.w, writer, job);
  const bool shell = is_finish(task.operation) && task.left_on_side_mm.has_value();
  if (task.stock.empty() && !shell)
    c.warn("TPA-REST", "the raw outline is not known: one round is made beside the contour");
  const double step = std::min(c.step_mm, 0.99 * a.radius);
  const double end = a.w.bottom_z_mm + task.allowance_bottom_mm;
  const bool single = task.multiple_passes.has_value() && !*task.multiple_passes;
  const auto heights = levels(a.w, task.start_z_mm, end, single ? 0.0 : task.axial_depth_mm, 0.0);
  if (heights.empty()) {
    return fail(
        {.code = "TPA-DEPTH",
         .message = task.shape.name + " has nothing to cut below " + trimmed(task.start_z_mm, 3) + " mm",
         .path = task.shape.name});
  }
  double from = task.start_z_mm;
  for (const double z : heights) {
    // A sloped flank leans inwards going up.
    Around at = a;
    const double lean = std::max(0.0, z - a.w.bottom_z_mm) * std::tan(a.w.slope_rad);
    if (lean > 0.0) at.kept = inset(a.kept, lean, kWallChord);
    if (at.kept.empty()) at.kept = a.kept;
    if (auto ok = cut_around(at, c, z, from, ring_distances(at, step, shell), shell); !ok)
      return tl::unexpected(ok.error());
    from = z;
  }
  GeneratedPath out = writer.finish();
  out.levels_z_mm = heights;
  return out;
}

}  // namespace capstan::toolpath
