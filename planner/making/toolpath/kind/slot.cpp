#include "planner/making/toolpath/kind/kind_path.h"
#include "planner/making/toolpath/region/region_paths.h"

namespace capstan::toolpath {

template <>
Result<GeneratedPath> mill<model::ShapeKind::kSlot>(const PathJob& task, Job& job) {
  return slot_path(task, job);
}

}  // namespace capstan::toolpath
