#include "planner/making/toolpath/kind/kind_path.h"
#include "planner/making/toolpath/region/region_paths.h"

namespace capstan::toolpath {

template <>
Result<GeneratedPath> mill<model::ShapeKind::kPocket>(const PathJob& task, Job& job) {
  return area_path(task, job);
}

}  // namespace capstan::toolpath
