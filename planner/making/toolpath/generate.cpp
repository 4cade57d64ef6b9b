#include <cmath>
#include <string>

#include "planner/ground/base/number.h"
#include "planner/ground/vocabulary/thread_mill.h"
#include "planner/making/toolpath/operation/operation_path.h"
#include "planner/making/toolpath/path_job.h"

namespace capstan::toolpath {

using model::TypeId;

namespace {

Status check(const PathJob& task) {
  const auto bad = [&](const std::string& what) {
    return fail({.code = "TPA-INPUT", .message = task.shape.name + ": " + what, .path = task.shape.name});
  };
  if (!(task.cutter.cutting_diameter_mm > 0.0)) return bad("the cutter has no diameter");
  for (const double v : {task.axial_depth_mm, task.radial_depth_mm, task.allowance_side_mm,
                         task.allowance_bottom_mm, task.clearance_mm, task.cutter.corner_radius_mm}) {
    if (!std::isfinite(v) || v < 0.0)
      return bad("a depth, allowance or clearance is negative or not a number");
  }
  for (const double v : {task.start_z_mm, task.security_z_mm, task.retract_z_mm, task.shape.depth_mm}) {
    if (!std::isfinite(v)) return bad("a height is not a number");
  }
  if (task.cutter.corner_radius_mm > 0.5 * task.cutter.cutting_diameter_mm + 1e-9)
    return bad("the cutter's corner radius is larger than its radius");
  if (task.feature_in_setup.z.z < 1.0 - 1e-9) {
    return fail({.code = "TPA-FRAME",
                 .message = "the feature " + task.shape.name + " is tilted against the tool axis",
                 .path = task.shape.name,
                 .hint = "machine it in a set-up whose z axis is the feature's"});
  }
  return {};
}

Result<GeneratedPath> dispatch(const PathJob& task, Job& job) {
  switch (task.operation) {
#define CAPSTAN_OPERATION(Noun, ...) \
  case TypeId::k##Noun:              \
    return cut<TypeId::k##Noun>(task, job);
#include "planner/ground/vocabulary/operations.inc"
#undef CAPSTAN_OPERATION
    default:
      return fail({.code = "TPA-UNSUPPORTED",
                   .message = task.shape.name + ": this operation has no 2.5D path",
                   .path = task.shape.name});
  }
}

}  // namespace

Result<GeneratedPath> generate(const PathJob& task, Job& job) {
  if (auto ok = check(task); !ok) return tl::unexpected(ok.error());
  const bool thread = model::mills_threads(task.cutter.cutter_class) && task.shape.thread_depth_mm > 0.0;
  const double down = breaks_edge(task) ? task.axial_depth_mm
                      : thread          ? task.shape.thread_depth_mm
                                        : task.cutting_depth_mm.value_or(task.shape.depth_mm);
  const double depth = task.start_z_mm - (task.feature_in_setup.origin.z - down);
  if (task.cutter.usable_length_mm > 0.0 && depth > task.cutter.usable_length_mm + 1e-9) {
    job.warn("TPA-REACH", about(task) + "cutter " + task.cutter.id + " reaches " +
                              trimmed(task.cutter.usable_length_mm, 2) + " mm of a depth of " +
                              trimmed(depth, 2) + " mm; use a longer one");
  }
  auto out = dispatch(task, job);
  if (out && out->path.size() < 2) {
    return fail({.code = "TPA-NO-FIT",
                 .message = "the path of " + task.shape.name + " is empty",
                 .path = task.shape.name});
  }
  return out;
}

}  // namespace capstan::toolpath
