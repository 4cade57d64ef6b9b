#include "planner/making/toolpath/kind/kind_path.h"
#include "planner/making/toolpath/region/region_paths.h"

namespace capstan::toolpath {

template <>
Result<GeneratedPath> mill<model::ShapeKind::kStep>(const PathJob& task, Job& job) {
  if (task.stock.empty()) {
    return fail({.code = "TPA-STOCK",
                 .message = task.shape.name + ": how far a step reaches is known only with the raw outline",
                 .path = task.shape.name});
  }
  return area_path(task, job);
}

}  // namespace capstan::toolpath
