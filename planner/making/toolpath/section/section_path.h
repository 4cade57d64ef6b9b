#pragma once

#include "planner/making/toolpath/path_job.h"

namespace capstan::toolpath {

/// A slot whose section is not square, by a cutter that has not its form: levels for a flat end (as wide at
/// each as the section lets the cutter in), passes at the heights of a cutter dropped onto the section for a
/// finishing cutter with a corner radius.
///
/// Fails  as `generate`.
/// Warns  TPA-REST what the cutter's shape leaves; TPA-DEFAULT the scallop, where nobody gives one.
[[nodiscard]] Result<GeneratedPath> form_slot_path(const PathJob& task, Job& job);
/// A hole that narrows downwards, in the same way, on circles.
[[nodiscard]] Result<GeneratedPath> tapered_hole_path(const PathJob& task, Job& job);
/// Whether the cutter has the hole's own size and bottom.
[[nodiscard]] bool is_hole_cutter(const PathJob& task);
/// Straight down with such a cutter.
[[nodiscard]] Result<GeneratedPath> sunk_path(const PathJob& task, Job& job);

}  // namespace capstan::toolpath
