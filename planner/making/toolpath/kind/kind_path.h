#pragma once

#include "planner/ground/vocabulary/shape_kind.h"
#include "planner/making/toolpath/path_job.h"

namespace capstan::toolpath {

/// Mills a kind of shape: one specialisation for each row of shape_kinds.inc, in a file of this folder.
/// `generate` handles thread mills and cones along edges before it calls this. Fails as `generate`.
template <model::ShapeKind kind>
[[nodiscard]] Result<GeneratedPath> mill(const PathJob& task, Job& job);

#define CAPSTAN_SHAPE_KIND(Kind, name, traits) \
  template <>                                  \
  Result<GeneratedPath> mill<model::ShapeKind::k##Kind>(const PathJob& task, Job& job);
#include "planner/ground/vocabulary/shape_kinds.inc"
#undef CAPSTAN_SHAPE_KIND

}  // namespace capstan::toolpath
