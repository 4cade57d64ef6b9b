#include <cmath>
#include <stdexcept>

#include "planner/ground/vocabulary/operation.h"
#include "planner/ground/vocabulary/thread_mill.h"
#include "planner/making/toolpath/hole/hole_paths.h"
#include "planner/making/toolpath/kind/kind_path.h"
#include "planner/making/toolpath/operation/operation_path.h"
#include "planner/making/toolpath/region/region_paths.h"

// Plane and side milling: a thread mill or a cone along an edge goes its own way, anything else as its kind
// of shape is milled.

namespace capstan::toolpath {

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

}  // namespace

bool breaks_edge(const PathJob& task) {
  const bool cone = is_cone(task.cutter) && !mills_cone(task);
  return cone && model::has(task.shape.kind, model::ShapeTrait::kRim) &&
         task.operation == TypeId::kSideFinishMilling;
}

namespace {

Result<GeneratedPath> milling(const PathJob& task, Job& job) {
  if (model::mills_threads(task.cutter.cutter_class)) return thread_mill_path(task, job);
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

}  // namespace

template <>
Result<GeneratedPath> cut<TypeId::kPlaneRoughMilling>(const PathJob& task, Job& job) {
  return milling(task, job);
}

template <>
Result<GeneratedPath> cut<TypeId::kPlaneFinishMilling>(const PathJob& task, Job& job) {
  return milling(task, job);
}

template <>
Result<GeneratedPath> cut<TypeId::kSideRoughMilling>(const PathJob& task, Job& job) {
  return milling(task, job);
}

template <>
Result<GeneratedPath> cut<TypeId::kSideFinishMilling>(const PathJob& task, Job& job) {
  return milling(task, job);
}

template <>
Result<GeneratedPath> cut<TypeId::kBottomAndSideRoughMilling>(const PathJob& task, Job& job) {
  return milling(task, job);
}

template <>
Result<GeneratedPath> cut<TypeId::kBottomAndSideFinishMilling>(const PathJob& task, Job& job) {
  return milling(task, job);
}

}  // namespace capstan::toolpath
