#include "planner/making/toolpath/kind/kind_path.h"
#include "planner/making/toolpath/region/region_paths.h"

namespace capstan::toolpath {

template <>
Result<GeneratedPath> mill<model::ShapeKind::kChamfer>(const PathJob& task, Job& job) {
  return edge_path(task, job);
}

template <>
Result<GeneratedPath> mill<model::ShapeKind::kEdgeRound>(const PathJob& task, Job& job) {
  return edge_path(task, job);
}

}  // namespace capstan::toolpath
