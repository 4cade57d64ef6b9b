#include "planner/making/toolpath/hole/hole_paths.h"
#include "planner/making/toolpath/operation/operation_path.h"

// Threads: tapped, or milled along a helix.

namespace capstan::toolpath {

using model::TypeId;

template <>
Result<GeneratedPath> cut<TypeId::kTapping>(const PathJob& task, Job& job) {
  return tap_path(task, job);
}

template <>
Result<GeneratedPath> cut<TypeId::kThreadDrilling>(const PathJob& task, Job& job) {
  return thread_mill_path(task, job);
}

}  // namespace capstan::toolpath
