#pragma once

#include "planner/ground/vocabulary/shape_kind.h"
#include "planner/making/toolpath/path_job.h"

namespace capstan::toolpath {

/// How a kind of shape is milled: one specialisation for each row of shape_kinds.inc, in a file of this
/// folder. What a thread mill or a cone along an edge does in it is chosen before, by `generate`. Fails   as
/// `generate`.
template <model::ShapeKind kind>
[[nodiscard]] Result<GeneratedPath> mill(const PathJob& task, Job& job);

#define CAPSTAN_SHAPE_KIND(Kind, name, traits) \
  template <>                                  \
  Result<GeneratedPath> mill<model::ShapeKind::k##Kind>(const PathJob& task, Job& job);
#include "planner/ground/vocabulary/shape_kinds.inc"
#undef CAPSTAN_SHAPE_KIND

}  // namespace capstan::toolpath
