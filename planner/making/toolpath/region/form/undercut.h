#pragma once

#include <optional>
#include <vector>

#include "planner/ground/base/result.h"
#include "planner/making/toolpath/path_job.h"

namespace capstan::toolpath {

/// A slot that is wider below than at its mouth: T-slots (upright below a flat overhang) and dovetails. mm.
struct Undercut {
  double mouth_mm = 0.0;   ///< half width at the top
  double widest_mm = 0.0;  ///< half width on the floor
  double height_mm = 0.0;  ///< of the wide part above the floor
  double flank_rad = 0.0;  ///< of a dovetail's flanks against the axis; 0: T-slot
};

/// Nothing for slots that do not narrow upwards, or in a way that neither cutter makes.
[[nodiscard]] std::optional<Undercut> undercut_of(const model::FeatureShape& slot);
/// The same job for the upright slot as wide as the mouth, which is milled first.
[[nodiscard]] PathJob neck_of(const PathJob& task, const Undercut& u);

/// What that pass takes, mm; 0: the head fills the slot, and one pass makes both walls.
[[nodiscard]] double last_side_mm(const PathJob& task, const Undercut& u);
/// Distance that a pass of the head moves aside from the one before, mm.
[[nodiscard]] double side_step(const PathJob& task, double diameter_mm);

/// Largest width that one edge of the head cuts, mm: beside the mouth that was milled before, or the distance
/// that it moves aside in one pass; its diameter if no mouth was milled. Under a dovetail's flank that is the
/// width on the floor, the largest.
[[nodiscard]] double undercut_width_mm(const PathJob& task, const Undercut& u);

/// The course of a slot, set-up frame.
struct SlotRun {
  std::vector<geometry::Vec2> line;
  bool open_first = false, open_last = false;
};

/// Mills under the overhang of a slot whose mouth is milled already: along the middle, then in steps aside to
/// both walls. Where the head is lower than the slot's wide part, it works from above to the floor. It enters
/// and leaves at its height, beyond open ends only, and never rises in the slot. To a closed end the steps go
/// in along one wall, round the end and out along the other.
///
/// Needs   head diameter at most the slot's; neck narrower than the mouth by what the cutter moves aside and
///         0.1 mm on each side; for a T-slot a head no higher than the wide part, for a dovetail flanks of
///         the slot's angle and at least as high.
/// Fails   TPA-NO-FIT, TPA-TOOL, TPA-ENTRY as `generate`.
[[nodiscard]] Result<GeneratedPath> undercut_path(const PathJob& task, const Undercut& u, SlotRun run);

}  // namespace capstan::toolpath
