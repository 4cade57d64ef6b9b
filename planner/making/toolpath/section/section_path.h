#pragma once

#include "planner/making/toolpath/path_job.h"

namespace capstan::toolpath {

/// Mills a slot whose section is not square with a cutter of another form. A flat end cuts levels, each as
/// wide as the section admits the cutter. A finishing cutter with a corner radius makes passes at the heights
/// at which it touches the section from above.
///
/// Fails  as `generate`.
/// Warns  TPA-REST for material that the cutter's shape leaves; TPA-DEFAULT for a scallop that is not given.
[[nodiscard]] Result<GeneratedPath> form_slot_path(const PathJob& task, Job& job);
/// Mills a hole that narrows downwards in the same way, on circles.
[[nodiscard]] Result<GeneratedPath> tapered_hole_path(const PathJob& task, Job& job);
/// True if the cutter has the hole's own size and bottom.
[[nodiscard]] bool is_hole_cutter(const PathJob& task);
/// Straight down with such a cutter.
[[nodiscard]] Result<GeneratedPath> sunk_path(const PathJob& task, Job& job);

}  // namespace capstan::toolpath
