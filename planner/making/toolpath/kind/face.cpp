#include "planner/making/toolpath/kind/kind_path.h"
#include "planner/making/toolpath/region/region_paths.h"
#include "planner/model/features/in_piece.h"

namespace capstan::toolpath {

template <>
Result<GeneratedPath> mill<model::ShapeKind::kFace>(const PathJob& task, Job& job) {
  return model::stops_at_walls(task.shape) ? area_path(task, job) : face_path(task, job);
}

}  // namespace capstan::toolpath
