#include <algorithm>
#include <cmath>

#include "planner/base/number.h"
#include "planner/toolpath/region/patterns.h"
#include "planner/toolpath/region/region_paths.h"

namespace capstan::toolpath {

namespace {
constexpr double kTipBelow =
    0.5;  ///< mm the tip reaches below the chamfer, so that the cone cuts, not its tip
}

Result<GeneratedPath> edge_path(const PathJob& task, Job& job) {
  const auto& s = task.shape;
  const auto refuse = [&](const char* code, const std::string& what) {
    return fail({.code = code, .message = s.name + ": " + what, .path = s.name});
  };
  if (s.open || s.area.empty())
    return refuse("TPA-UNSUPPORTED",
                  "only the upper edges of closed pockets and holes have chamfer paths yet");
  auto w = work_area(task);
  if (!w) return tl::unexpected(w.error());
  // The flank's angle against the axis is the complement of the chamfer's against the plane.
  const double half = 0.5 * task.cutter.point_angle_rad;
  if (std::abs(std::tan(half) - 1.0 / std::tan(s.chamfer_angle_rad)) > 1e-3 || !(half > 0.0))
    return refuse("TPA-TOOL", "the cutter's point angle does not make the chamfer's angle");
  const double tip = 0.5 * task.cutter.tip_diameter_mm;
  const double offset = tip + kTipBelow * std::tan(half);
  const double needed = offset + s.chamfer_width_mm;
  if (2.0 * needed > task.cutter.cutting_diameter_mm + 1e-9)
    return refuse("TPA-NO-FIT", "the chamfer is wider than the cutter's cone; a cutter of " +
                                    trimmed(2.0 * needed, 2) + " mm would do");
  const double z = w->top_z_mm - s.depth_mm - kTipBelow;
  PathJob slim = task;  // at its tip the cone is as wide as this
  slim.cutter.cutting_diameter_mm = 2.0 * offset;
  slim.cutter.corner_radius_mm = 0.0;
  w->bottom_z_mm = z;
  w->slope_rad = w->bottom_radius_mm = 0.0;
  PathWriter writer(task);
  LevelCutter c(slim, *w, writer, job);
  Level level(slim, *w, z, z, 0.0);
  if (level.centres.empty()) return refuse("TPA-NO-FIT", "the cutter's tip does not fit inside the edge");
  level.cleared.emplace(level.centres);
  if (auto ok = cut_contours(c, level, {.lead_arcs = true, .wall_only = true}); !ok)
    return tl::unexpected(ok.error());
  GeneratedPath out = writer.finish();
  out.levels_z_mm = {z};
  return out;
}

}  // namespace capstan::toolpath
