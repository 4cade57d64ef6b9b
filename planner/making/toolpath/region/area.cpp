#include <algorithm>
#include <cmath>

#include "planner/ground/base/number.h"
#include "planner/making/toolpath/region/adaptive/adaptive.h"
#include "planner/making/toolpath/region/area/rest.h"
#include "planner/making/toolpath/region/patterns.h"
#include "planner/making/toolpath/region/region_paths.h"

namespace capstan::toolpath {

using geometry::Region;
using geometry::Vec2;
using model::StrategyKind;
using model::TypeId;

Vec2 pass_direction(const PathJob& task, const Region& area) {
  if (task.feed_direction) {
    const auto d =
        task.feature_in_setup.direction_to_parent({task.feed_direction->x, task.feed_direction->y, 0.0});
    const double l = norm(xy(d));
    if (l > 1e-9) return (1.0 / l) * xy(d);
  }
  const auto box = geometry::bounds(area);
  return box.hi.y - box.lo.y > box.hi.x - box.lo.x + 1e-9 ? Vec2{0.0, 1.0} : Vec2{1.0, 0.0};
}

namespace {

/// Says what no cutter of this size reaches of the floor: corners, narrow places. mm2. Islands are no floor.
double unreachable(const WorkArea& w, const Region& centres, double reach_mm) {
  Region floor = geometry::intersect(w.area, w.reach);
  for (const auto& i : w.islands) {
    if (i.top_z_mm > w.bottom_z_mm + 1e-6) floor = geometry::subtract(floor, i.area);
  }
  return geometry::area(geometry::subtract(floor, geometry::offset(centres, reach_mm)));
}

/// Whether contours run from the outside in: rotation and cut mode together say so.
bool outside_in(const PathJob& task) {
  if (!task.rotation_ccw) return false;
  return *task.rotation_ccw != walls_on_right(task);
}

Status cut_level(LevelCutter& c, const Level& level, bool leads) {
  const PathJob& task = c.task;
  switch (task.strategy) {
    case StrategyKind::kBidirectional:
    case StrategyKind::kUnidirectional:
    case StrategyKind::kContourBidirectional: {
      RasterOptions o;
      o.direction = pass_direction(task, c.area.area);
      o.one_way = task.strategy == StrategyKind::kUnidirectional;
      // One way, what is still to be cut lies on the right of a climbing cutter.
      o.step_left = o.one_way ? !walls_on_right(task) : task.stepover_left.value_or(true);
      o.walls_first = task.strategy == StrategyKind::kContourBidirectional;
      return cut_raster(c, level, o);
    }
    default: {
      ContourOptions o;
      o.spiral = task.strategy == StrategyKind::kContourSpiral;
      o.outside_in = !leads && outside_in(task);
      o.lead_arcs = leads;
      return cut_contours(c, level, o);
    }
  }
}

/// Finishing: the tops of islands that end at this level, where an earlier step left some.
Status cut_island_tops(LevelCutter& c, const WorkArea& w, const Level& level, double left_mm) {
  for (const auto& i : w.islands) {
    if (std::abs(i.top_z_mm + c.task.allowance_bottom_mm - level.z_mm) > 1e-6 || left_mm <= 0.0) continue;
    Level top = level;
    top.centres = geometry::intersect(level.centres, inset(i.area, -0.5 * c.radius_mm, kInnerChord));
    if (top.centres.empty()) continue;
    top.inside = Inside(inset(top.centres, -kInsideSlack, 0.25 * kInsideSlack));
    top.from_mm = level.z_mm + left_mm;
    if (auto ok = cut_level(c, top, false); !ok) return ok;
  }
  return {};
}

/// Corners and narrow places that a wider cutter left, level by level.
Result<GeneratedPath> rest_path(const PathJob& task, const WorkArea& w, const std::vector<double>& heights,
                                LevelCutter& c) {
  double from = task.start_z_mm;
  double most = 0.0;
  for (const double z : heights) {
    Level level(task, w, z, from, task.allowance_side_mm);
    from = z;
    if (level.centres.empty()) continue;
    const double area = narrow_to_rest(task, w, level);
    if (area == 0.0) continue;
    most = std::max(most, area);
    if (auto ok = cut_contours(c, level, {}); !ok) return tl::unexpected(ok.error());
  }
  if (most == 0.0) {
    return fail({.code = "TPA-NO-REST",
                 .message = task.shape.name + ": nothing remains for " + task.cutter.id + " (" +
                            trimmed(task.cutter.cutting_diameter_mm, 3) + " mm) after the cutter of " +
                            trimmed(task.cleared_by->diameter_mm, 3) + " mm",
                 .path = task.shape.name});
  }
  GeneratedPath out = c.writer.finish();
  out.levels_z_mm = heights;
  return out;
}

/// Warns of material that this cutter leaves on the floor and no later step removes.
void warn_of_rest(LevelCutter& c, const WorkArea& w, const Region& centres) {
  const PathJob& task = c.task;
  if (task.rest_follows) return;
  const double lost =
      unreachable(w, centres, 0.5 * task.cutter.cutting_diameter_mm + task.allowance_side_mm + 0.01);
  if (lost > 0.05) {
    c.warn("TPA-REST", "cutter " + task.cutter.id + " (" + trimmed(task.cutter.cutting_diameter_mm, 3) +
                           " mm) leaves " + trimmed(lost, 1) +
                           " mm2 of the floor uncut in corners or narrow places; use a smaller one, or add "
                           "a step with one");
  }
}

}  // namespace

Result<GeneratedPath> area_path(const PathJob& task, Job& job) {
  const auto w = work_area(task);
  if (!w) return tl::unexpected(w.error());
  if (task.constant_engagement) {
    if (auto ok = may_clear_at_constant_engagement(task, *w); !ok) return tl::unexpected(ok.error());
  }
  PathWriter writer(task);
  LevelCutter c(task, *w, writer, job);
  Clearings clearings;
  const bool finish = model::has(task.operation, model::OperationTrait::kFinishes);
  // A step before may have finished the floor: its last pass goes round the walls alone.
  const bool made =
      task.floor_made && task.left_on_bottom_mm && *task.left_on_bottom_mm <= task.allowance_bottom_mm + 1e-6;
  const bool floor = task.operation != TypeId::kSideFinishMilling && !made;
  const bool plane = model::has(task.operation, model::OperationTrait::kPlane);
  // Side finishing after an earlier step: only a shell is left on the walls.
  const bool shell = finish && !plane && task.left_on_side_mm.has_value();
  double end = w->bottom_z_mm + task.allowance_bottom_mm;
  if (task.shape.through) end -= task.cutter.corner_radius_mm;
  const bool single = task.multiple_passes.has_value() && !*task.multiple_passes;
  const auto heights =
      levels(*w, task.start_z_mm, end, single ? 0.0 : task.axial_depth_mm, task.allowance_bottom_mm);
  if (heights.empty()) {
    return fail({.code = kNothingToCut,
                 .message = task.shape.name + " has nothing to cut between " + trimmed(task.start_z_mm, 3) +
                            " and " + trimmed(end, 3) + " mm",
                 .path = task.shape.name});
  }
  if (task.cleared_by && !plane && w->slope_rad == 0.0) return rest_path(task, *w, heights, c);
  if (!finish) c.floors = heights;
  // Top of the material away from the walls.
  const bool opened = shell || (plane && task.left_on_bottom_mm.has_value());
  const double left_bottom = task.left_on_bottom_mm.value_or(0.0);
  double inner = opened ? std::min(task.start_z_mm, w->bottom_z_mm + left_bottom) : task.start_z_mm;
  double from = task.start_z_mm;
  bool any = false;
  for (std::size_t i = 0; i < heights.size(); ++i) {
    const double z = heights[i];
    const bool last = i + 1 == heights.size();
    const bool whole = !shell || (floor && (last || z < inner - 1e-9));
    if (plane && opened && !last && z >= inner - 1e-9) {
      from = z;
      continue;
    }
    Level level(task, *w, z, std::max(z, inner), task.allowance_side_mm);
    level.above_mm = from;
    from = z;
    if (whole) inner = z;
    // Narrow above an island's top or in a fillet is no fault; nowhere at all is.
    if (level.centres.empty()) continue;
    any = true;
    if (shell) {
      level.cleared.emplace(
          centres_at(*w, task.cutter, z, *task.left_on_side_mm + 0.02, task.allowance_bottom_mm));
    }
    Status ok;
    if (task.constant_engagement) {
      ok = cut_at_constant_engagement(c, level, clearings);
    } else if (whole) {
      ok = cut_level(c, level, finish);
    } else {
      ok = cut_contours(c, level, {.lead_arcs = true, .wall_only = true});
      if (ok && floor) ok = cut_island_tops(c, *w, level, left_bottom);
    }
    if (!ok) return tl::unexpected(ok.error());
    if (last) {
      warn_of_rest(
          c, *w,
          task.constant_engagement ? reached_at_constant_engagement(task, level.centres) : level.centres);
    }
  }
  if (!any) {
    return fail({.code = "TPA-NO-FIT",
                 .message = "the cutter " + task.cutter.id + " of " +
                            trimmed(task.cutter.cutting_diameter_mm, 3) + " mm does not fit into " +
                            task.shape.name,
                 .path = task.shape.name,
                 .hint = "a diameter of at most " +
                         trimmed(2.0 * (deepest(geometry::intersect(w->reach, w->area)).distance_mm -
                                        task.allowance_side_mm),
                                 2) +
                         " mm would"});
  }
  GeneratedPath out = writer.finish();
  out.levels_z_mm = heights;
  return out;
}

}  // namespace capstan::toolpath
