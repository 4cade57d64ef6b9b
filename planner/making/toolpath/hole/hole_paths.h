#pragma once

#include "planner/making/toolpath/path_job.h"

namespace capstan::toolpath {

// One function per kind of work on a hole; `generate` chooses. All fail as `generate` does.

/// Drilling, centre and spot drilling, drilling in steps, countersinking, counterboring, reaming, boring.
[[nodiscard]] Result<GeneratedPath> drill_path(const PathJob& task, Job& job);
/// Tapping with a synchronised spindle: down, and up with the spindle reversed (speed factor -1).
[[nodiscard]] Result<GeneratedPath> tap_path(const PathJob& task, Job& job);
/// An inner thread milled along a helix, one turn per pitch, entered and left on half-circles.
[[nodiscard]] Result<GeneratedPath> thread_mill_path(const PathJob& task, Job& job);
/// Mills a round hole along a helix. Needs a cutter that leaves no core.
[[nodiscard]] Result<GeneratedPath> helix_path(const PathJob& task, Job& job);
/// True if a helix leaves no core, so that helix_path can mill the hole.
[[nodiscard]] bool helix_suits(const PathJob& task);
/// Mills below a narrower hole (`hole_above_mm`), through which the cutter goes down and up in the middle.
/// The head of a T-slot cutter mills a ring on full circles from below. A back countersink mills its cone,
/// which ends at its neck, at the top of its head. The spindle needs no orientation.
///
/// Needs   head 0.2 mm clear of the narrow hole on each side; neck 0.1 mm clear of it while the head is out.
/// Fails   TPA-NO-FIT (it says which head and neck would do), TPA-TOOL, as `generate`.
[[nodiscard]] Result<GeneratedPath> back_path(const PathJob& task, Job& job);
/// Largest cut of such a circle: its height, and the width of a straight cut with the same contact angle, mm.
struct BackCut {
  double ap_mm = 0.0, ae_mm = 0.0;
};
[[nodiscard]] BackCut back_cut(const PathJob& task);
/// Width of the last circle of such a path, which makes the wall, as that of a straight cut with the same
/// contact angle, mm. `bent_mm`: how far off the wall the neck was bent in the circles before. Needs a head
/// smaller than what it mills; else 0.
[[nodiscard]] double last_circle_mm(const PathJob& task, double bent_mm);
/// True if the cutter has a head that cuts above itself, on a neck.
[[nodiscard]] bool cuts_from_below(const PathJob& task);

}  // namespace capstan::toolpath
