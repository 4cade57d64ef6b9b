#include "planner/making/toolpath/kind/kind_path.h"
#include "planner/making/toolpath/region/region_paths.h"

namespace capstan::toolpath {

template <>
Result<GeneratedPath> mill<model::ShapeKind::kStep>(const PathJob& task, Job& job) {
  if (task.stock.empty()) {
    return fail({.code = "TPA-STOCK",
                 .message = task.shape.name +
                            ": the extent of the step follows from the raw piece; state it (--stock)",
                 .path = task.shape.name});
  }
  return area_path(task, job);
}

}  // namespace capstan::toolpath
