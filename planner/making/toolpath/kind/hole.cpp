#include "planner/making/toolpath/hole/hole_paths.h"
#include "planner/making/toolpath/kind/kind_path.h"
#include "planner/making/toolpath/region/region_paths.h"
#include "planner/making/toolpath/section/section_path.h"

namespace capstan::toolpath {

template <>
Result<GeneratedPath> mill<model::ShapeKind::kHole>(const PathJob& task, Job& job) {
  if (cuts_from_below(task)) return back_path(task, job);
  PathJob hole = task;
  if (task.cutting_depth_mm) hole.shape.depth_mm = *task.cutting_depth_mm;
  // The hole that an earlier step left counts as a pilot hole.
  if (!task.previous_diameter_mm && task.left_on_side_mm)
    hole.previous_diameter_mm = task.shape.diameter.middle() - 2.0 * *task.left_on_side_mm;
  if (task.shape.bottom_diameter_mm > 0.0 &&
      task.shape.bottom_diameter_mm < task.shape.diameter.nominal_mm - 1e-6 &&
      model::has(task.cutter.cutter_class, model::CutterTrait::kLayers))
    return tapered_hole_path(hole, job);
  if (is_hole_cutter(hole)) return sunk_path(hole, job);
  if (helix_suits(hole)) return helix_path(hole, job);
  hole.shape.area = hole.shape.reach = geometry::disc({0.0, 0.0}, 0.5 * task.shape.diameter.middle());
  return area_path(hole, job);
}

}  // namespace capstan::toolpath
