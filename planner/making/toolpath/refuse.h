#pragma once

#include <string>

#include "planner/making/toolpath/path_job.h"

namespace capstan::toolpath {

/// A step has no path: the reason, under the name of its feature.
[[nodiscard]] inline tl::unexpected<Diagnostic> refuse(const PathJob& task, const char* code,
                                                       const std::string& what) {
  return fail({.code = code, .message = task.shape.name + ": " + what, .path = task.shape.name});
}

}  // namespace capstan::toolpath
