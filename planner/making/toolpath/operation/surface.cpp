#include "planner/making/toolpath/operation/operation_path.h"

// Surfaces have paths of their own (toolpath/freeform), no 2.5D ones.

namespace capstan::toolpath {

using model::TypeId;

namespace {

Result<GeneratedPath> no_path(const PathJob& task) {
  return fail({.code = "TPA-UNSUPPORTED",
               .message = task.shape.name + ": this operation has no 2.5D path",
               .path = task.shape.name});
}

}  // namespace

template <>
Result<GeneratedPath> cut<TypeId::kFreeformRoughMilling>(const PathJob& task, Job& /*job*/) {
  return no_path(task);
}

template <>
Result<GeneratedPath> cut<TypeId::kFreeformFinishMilling>(const PathJob& task, Job& /*job*/) {
  return no_path(task);
}

}  // namespace capstan::toolpath
