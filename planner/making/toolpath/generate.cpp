#include <cmath>
#include <stdexcept>
#include <string>

#include "planner/ground/base/number.h"
#include "planner/ground/vocabulary/operation.h"
#include "planner/making/toolpath/hole/hole_paths.h"
#include "planner/making/toolpath/kind/kind_path.h"
#include "planner/making/toolpath/path_job.h"
#include "planner/making/toolpath/region/region_paths.h"

namespace capstan::toolpath {

using model::CutterClass;
using model::ShapeKind;
using model::TypeId;

namespace {

bool is_cone(const model::Cutter& c) { return model::has(c.cutter_class, model::CutterTrait::kSinks); }

/// The cone of a hole, milled along its wall.
bool mills_cone(const PathJob& task) {
  const auto& s = task.shape;
  if (!is_cone(task.cutter) || task.operation != TypeId::kSideFinishMilling || s.kind != ShapeKind::kHole ||
      !(s.bottom_diameter_mm > 0.0) || !(s.bottom_diameter_mm < s.diameter.nominal_mm - 1e-6))
    return false;
  const double lean = 0.5 * (s.diameter.nominal_mm - s.bottom_diameter_mm) / s.depth_mm;
  return std::abs(std::tan(0.5 * task.cutter.point_angle_rad) - lean) < 1e-3;
}

/// A cone along the side of a feature that is no chamfer.
bool breaks_edge(const PathJob& task) {
  const bool cone = is_cone(task.cutter) && !mills_cone(task);
  return cone && model::has(task.shape.kind, model::ShapeTrait::kRim) &&
         task.operation == TypeId::kSideFinishMilling;
}

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

Result<GeneratedPath> milling(const PathJob& task, Job& job) {
  if (task.cutter.cutter_class == CutterClass::kThreadMill) return thread_mill_path(task, job);
  if (mills_cone(task)) return cone_of_hole_path(task, job);
  if (breaks_edge(task)) return broken_edge_path(task, job);
  switch (task.shape.kind) {
#define CAPSTAN_SHAPE_KIND(Kind, name, traits) \
  case ShapeKind::k##Kind:                     \
    return mill<ShapeKind::k##Kind>(task, job);
#include "planner/ground/vocabulary/shape_kinds.inc"
#undef CAPSTAN_SHAPE_KIND
  }
  throw std::logic_error("there is no such kind of shape");
}

/// A boring tool or reamer is known by its diameter alone: the taper of its flanks is not.
void warn_of_taper(const PathJob& task, Job& job) {
  const auto& s = task.shape;
  const bool tapered = s.kind == ShapeKind::kHole && s.bottom_diameter_mm > 0.0 &&
                       s.bottom_diameter_mm < s.diameter.nominal_mm - 1e-6;
  if (!tapered || !model::has(task.operation, model::OperationTrait::kEnlarges)) return;
  const double depth = task.cutting_depth_mm.value_or(s.depth_mm);
  job.warn("TPA-REST",
           "its wall tapers from " + trimmed(s.diameter.nominal_mm, 3) + " to " +
               trimmed(s.bottom_diameter_mm, 3) + " mm over " + trimmed(s.depth_mm, 3) + " mm; " +
               task.cutter.id + " is taken as upright, " + trimmed(task.cutter.cutting_diameter_mm, 3) +
               " mm wide, and goes " + trimmed(depth, 3) +
               " mm deep as given: that the taper is finished is not shown",
           s.name);
}

Result<GeneratedPath> dispatch(const PathJob& task, Job& job) {
  using model::OperationTrait;
  if (model::has(task.operation, OperationTrait::kAlongAxis)) {
    warn_of_taper(task, job);
    return drill_path(task, job);
  }
  if (task.operation == TypeId::kTapping) return tap_path(task, job);
  if (model::has(task.operation, OperationTrait::kThreads)) return thread_mill_path(task, job);
  if (model::has(task.operation, OperationTrait::kPlane) ||
      model::has(task.operation, OperationTrait::kWalls))
    return milling(task, job);
  return fail({.code = "TPA-UNSUPPORTED",
               .message = task.shape.name + ": this operation has no 2.5D path",
               .path = task.shape.name});
}

}  // namespace

Result<GeneratedPath> generate(const PathJob& task, Job& job) {
  if (auto ok = check(task); !ok) return tl::unexpected(ok.error());
  const double down = breaks_edge(task) ? task.axial_depth_mm : task.shape.depth_mm;
  const double depth = task.start_z_mm - (task.feature_in_setup.origin.z - down);
  if (task.cutter.usable_length_mm > 0.0 && depth > task.cutter.usable_length_mm + 1e-9) {
    job.warn("TPA-REACH",
             "the cutter " + task.cutter.id + " reaches " + trimmed(task.cutter.usable_length_mm, 2) +
                 " mm, the work is " + trimmed(depth, 2) + " mm deep",
             task.shape.name);
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
