#pragma once

#include <vector>

#include "planner/ground/base/result.h"
#include "planner/making/toolpath/path_job.h"

namespace capstan::toolpath {

/// A 2.5D feature in the set-up's frame, with what a cutter must respect at each height.
struct WorkArea {
  geometry::Region area;   ///< to be removed at the bottom
  geometry::Region reach;  ///< where a cutter may be, islands and `avoid` not yet taken out
  std::vector<model::Island> islands;
  geometry::Region avoid;
  geometry::Region material;  ///< outline of the material before the step; a cutter outside it is in air
  double top_z_mm = 0.0, bottom_z_mm = 0.0;  ///< of the feature; bottom without allowance
  double slope_rad = 0.0, bottom_radius_mm = 0.0;
  bool open = false;  ///< its outline has open sides, or runs over the edge of the piece
};

/// Fails  TPA-FRAME when the feature's axis is not the tool's.
[[nodiscard]] Result<WorkArea> work_area(const PathJob& task);
[[nodiscard]] geometry::Region in_setup(const geometry::Region& r, const geometry::Placement& frame);

/// Shrunk by exactly d (grown when negative), simplified; the wall ring when d is radius and allowance.
/// Straight walls lie at exactly d; chords of arcs come nearer by kWallChord at most, and the arcs fitted to
/// them by less.
[[nodiscard]] geometry::Region inset(const geometry::Region& r, double d_mm, double chord_mm);
inline constexpr double kWallChord = 0.0005;  ///< mm
inline constexpr double kInnerChord = 0.003;  ///< mm, of rings that touch no wall
/// Inner corners of paths that make no wall are rounded by this part of the cutter's radius, so that the
/// machine turns without a stop. Where fronts are followed at a constant arc of contact, one of radius p that
/// advances by k makes an arc of about sqrt(2 k (r + p) / (r p)), which for the layer left to the last pass
/// (clearing.cpp: an eighth of ae) is then 1.06 of the straight cut's. What stays in a square corner is at
/// most a twentieth of the radius deep. In a narrower place a cutter does not turn.
inline constexpr double kLeastTurn = 0.125;

/// Where the cutter's centre may be when its tip is at z and walls keep an allowance.
[[nodiscard]] geometry::Region centres_at(const WorkArea& w, const model::Cutter& cutter, double tip_z_mm,
                                          double allowance_mm, double allowance_bottom_mm);

/// What the cutter's centre keeps off beside what stands in `islands`, with its foot: as `centres_at`.
[[nodiscard]] geometry::Region kept_off(const WorkArea& w, const geometry::Region& islands,
                                        const model::Cutter& cutter, double tip_z_mm, double allowance_mm);

/// Heights of the tip, from above: equal steps of at most `step` between start and end, with every island's
/// top (plus the bottom allowance) among them. step 0: at once.
[[nodiscard]] std::vector<double> levels(const WorkArea& w, double start_z_mm, double end_z_mm,
                                         double step_mm, double allowance_bottom_mm);

}  // namespace capstan::toolpath
