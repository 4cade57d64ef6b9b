#include <string>

#include "planner/making/toolpath/kind/kind_path.h"

// Kinds that no 2.5D path mills: threads have operations of their own, surfaces are toolpath/freeform's.

namespace capstan::toolpath {

namespace {

Result<GeneratedPath> no_path(const PathJob& task) {
  return fail(
      {.code = "TPA-UNSUPPORTED",
       .message = task.shape.name + ": a " + std::string(to_text(task.shape.kind)) + " has no 2.5D path yet",
       .path = task.shape.name});
}

}  // namespace

template <>
Result<GeneratedPath> mill<model::ShapeKind::kThread>(const PathJob& task, Job& /*job*/) {
  return no_path(task);
}

template <>
Result<GeneratedPath> mill<model::ShapeKind::kSphericalCap>(const PathJob& task, Job& /*job*/) {
  return no_path(task);
}

template <>
Result<GeneratedPath> mill<model::ShapeKind::kRoundedEnd>(const PathJob& task, Job& /*job*/) {
  return no_path(task);
}

template <>
Result<GeneratedPath> mill<model::ShapeKind::kFreeform>(const PathJob& task, Job& /*job*/) {
  return no_path(task);
}

template <>
Result<GeneratedPath> mill<model::ShapeKind::kToolpath>(const PathJob& task, Job& /*job*/) {
  return no_path(task);
}

}  // namespace capstan::toolpath
