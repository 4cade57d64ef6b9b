#include <string>

#include "planner/ground/base/number.h"
#include "planner/ground/vocabulary/operation.h"
#include "planner/making/toolpath/hole/hole_paths.h"
#include "planner/making/toolpath/operation/operation_path.h"

// Down the hole's axis and back: drills, sinks, reamers, boring tools.

namespace capstan::toolpath {

using model::ShapeKind;
using model::TypeId;

namespace {

/// A boring tool or reamer is known by its diameter alone: the taper of its flanks is not.
void warn_of_taper(const PathJob& task, Job& job) {
  const auto& s = task.shape;
  const bool tapered = s.kind == ShapeKind::kHole && s.bottom_diameter_mm > 0.0 &&
                       s.bottom_diameter_mm < s.diameter.nominal_mm - 1e-6;
  if (!tapered || !model::has(task.operation, model::OperationTrait::kEnlarges)) return;
  const double depth = task.cutting_depth_mm.value_or(s.depth_mm);
  job.warn("TPA-REST", about(task) + "the taper from " + trimmed(s.diameter.nominal_mm, 3) + " to " +
                           trimmed(s.bottom_diameter_mm, 3) + " mm over " + trimmed(s.depth_mm, 3) +
                           " mm is not proved: " + task.cutter.id + " is taken as a cylinder of " +
                           trimmed(task.cutter.cutting_diameter_mm, 3) + " mm, " + trimmed(depth, 3) +
                           " mm deep as given; measure the hole");
}

Result<GeneratedPath> along_axis(const PathJob& task, Job& job) {
  warn_of_taper(task, job);
  return drill_path(task, job);
}

}  // namespace

template <>
Result<GeneratedPath> cut<TypeId::kCenterDrilling>(const PathJob& task, Job& job) {
  return along_axis(task, job);
}

template <>
Result<GeneratedPath> cut<TypeId::kDrilling>(const PathJob& task, Job& job) {
  return along_axis(task, job);
}

template <>
Result<GeneratedPath> cut<TypeId::kMultistepDrilling>(const PathJob& task, Job& job) {
  return along_axis(task, job);
}

template <>
Result<GeneratedPath> cut<TypeId::kCounterSinking>(const PathJob& task, Job& job) {
  return along_axis(task, job);
}

template <>
Result<GeneratedPath> cut<TypeId::kBoring>(const PathJob& task, Job& job) {
  return along_axis(task, job);
}

template <>
Result<GeneratedPath> cut<TypeId::kReaming>(const PathJob& task, Job& job) {
  return along_axis(task, job);
}

template <>
Result<GeneratedPath> cut<TypeId::kBackBoring>(const PathJob& task, Job& job) {
  return along_axis(task, job);
}

}  // namespace capstan::toolpath
