#pragma once

#include "planner/toolpath/path_job.h"

namespace capstan::toolpath {

// One function per kind of work on a hole; `generate` chooses. All fail as `generate` does.

/// Drilling, centre and spot drilling, drilling in steps, countersinking, counterboring, reaming, boring.
[[nodiscard]] Result<GeneratedPath> drill_path(const PathJob& task, Job& job);
/// Tapping with a synchronised spindle: down, and up with the spindle reversed (speed factor -1).
[[nodiscard]] Result<GeneratedPath> tap_path(const PathJob& task, Job& job);
/// An inner thread milled along a helix, one turn per pitch, entered and left on half-circles.
[[nodiscard]] Result<GeneratedPath> thread_mill_path(const PathJob& task, Job& job);
/// A round hole milled along a helix. Needs a cutter that leaves no core.
[[nodiscard]] Result<GeneratedPath> helix_path(const PathJob& task, Job& job);
/// Whether a helix leaves no core, so that helix_path does it.
[[nodiscard]] bool helix_suits(const PathJob& task);

}  // namespace capstan::toolpath
