#pragma once

#include "planner/ground/vocabulary/noun_kind.h"
#include "planner/making/toolpath/path_job.h"

namespace capstan::toolpath {

/// How an operation moves: one specialisation for each row of operations.inc, in a file of this folder.
/// Fails   as `generate`.
template <model::TypeId operation>
[[nodiscard]] Result<GeneratedPath> cut(const PathJob& task, Job& job);

#define CAPSTAN_OPERATION(Noun, ...) \
  template <>                        \
  Result<GeneratedPath> cut<model::TypeId::k##Noun>(const PathJob& task, Job& job);
#include "planner/ground/vocabulary/operations.inc"
#undef CAPSTAN_OPERATION

/// Whether a cone breaks the upper edge of a feature that is no chamfer.
[[nodiscard]] bool breaks_edge(const PathJob& task);

}  // namespace capstan::toolpath
