#pragma once

#include <optional>
#include <vector>

#include "planner/ground/base/job.h"
#include "planner/ground/base/result.h"
#include "planner/ground/geometry/mesh.h"
#include "planner/ground/geometry/region.h"
#include "planner/model/plan/cutter/cutter.h"
#include "planner/model/plan/cutter_path.h"
#include "planner/physics/stock/height_map.h"

namespace capstan::toolpath::freeform {

/// Input of a freeform path.
///
/// Frame  everything in the set-up's, z along the tool axis.
/// Units  mm, rad.
struct FreeformJob {
  const geometry::Mesh* surface = nullptr;  ///< the finished surface; kept by the caller
  model::Cutter cutter;                     ///< a mill whose outline bends nowhere inwards
  /// Where the cutter's axis may go; empty: the rectangle around the mesh.
  geometry::Region area;
  /// Whether there is nothing to spare where the cutter, let down, meets no triangle: it may then go down to
  /// bottom_z there. Else it stays away.
  bool beside_is_free = false;
  geometry::Region avoid;  ///< the cutter keeps out of it, at all heights at which it cuts
  const stock::HeightMap* stock =
      nullptr;  ///< the stock before the path; null: solid up to top_z under the area
  /// Rough: heights up to which material may stay, of the stock's cells above its floor; only what stands
  /// higher is cut, where a mill before left it. Null: all is cut.
  const stock::HeightMap* may_stay = nullptr;
  double top_z_mm = 0.0;        ///< of the material
  double bottom_z_mm = -1e300;  ///< the tip goes no lower
  double security_z_mm = 0.0;   ///< rapids in XY happen here
  double clearance_mm = 2.0;    ///< between material and what moves fast above it
  double allowance_mm = 0.0;    ///< left on the surface, along its normal
  double tolerance_mm = 0.01;   ///< largest distance of the cut from surface + allowance, outwards
  double feed_angle_rad = 0.0;  ///< of the passes, against x
  double ramp_angle_rad = 0.0;  ///< rough: of ramps into the solid; 0: the steepest that the cutter may
  double axial_depth_mm = 0.0;  ///< rough: at most, per level
  /// Rough: what levels may leave on a slope beside the allowance, square to it; 0: as much as they do.
  double terrace_mm = 0.0;
  double stepover_mm = 0.0;  ///< between passes; finish: 0 takes it from scallop_mm
  double scallop_mm = 0.0;   ///< finish: height of the ridges between passes
  /// Finish: a wider ball that finished the surface before: only where it left more than scallop and
  /// tolerance, and the stock has it, is finished, in layers where that is much.
  std::optional<model::Cutter> after;
  bool to_and_fro = true;  ///< finish: else all passes in one direction
  /// Rough: heights of the level floors of a surface with walls; the cut goes down to each of them, too, and
  /// follows the borders of levels to a quarter of the margin.
  std::vector<double> floors_z_mm;
  /// Rough: the last cut of walls and floors, of which about this is left: walls are cut along before what
  /// lies within them.
  std::optional<double> left_mm;
};

struct FreeformPath {
  model::CutterPath path;
  /// Rough: heights of the tip, each once, in the order in which they were cut.
  std::vector<double> levels_z_mm;
  double stepover_mm = 0.0;  ///< as used
};

/// Distance between two passes of a ball of radius R that leaves ridges of height h on a plane:
/// 2 sqrt(h (2 R - h)). Across a slope of angle t the ridges are higher (the passes lie 1/cos t further
/// apart). Source  derived: two equal circles.
[[nodiscard]] double scallop_stepover(double ball_radius_mm, double scallop_mm);

/// freeform_rough_milling: levels, axial_depth apart, from above; in each, straight passes over what is free
/// of surface + allowance and still holds material. With terraces, the levels between two of those are cut
/// from below. The cutter's way in: from the side in air, else a ramp along the first pass within the
/// cutter's ramp angle, else straight down where the cutter cuts to its centre (with terraces and a cutter
/// that ramps: `kStraightTerraces` deep at most).
///
/// No gouge   every point of a cut is covered by places where the cutter, grown by the allowance and a
/// margin,
///            was let down on the mesh.
/// Needs      axial_depth, stepover > 0, stepover at most the diameter.
/// Fails      FRF-CUTTER   a drill, a cone, or a hollow outline
///            FRF-VALUE    a number that cannot be
///            FRF-EMPTY    nothing in the area that can be cut
///            TPA-NOTHING  (rough) nothing stands higher than what is left for the finish
///            FRF-STOPPED  the job was stopped
/// Warns      FRF-REST     passes that the cutter can reach but not enter, on each level
/// After the passes of a level the cutter goes once along the border of what is free there (climbing, for a
/// clockwise spindle), so that walls keep the allowance and not half a stepover more.
[[nodiscard]] Result<FreeformPath> rough(const FreeformJob& task, Job& job);

/// freeform_finish_milling: parallel passes that follow the surface. Points as far apart as the tolerance
/// allows; the cut lies between surface + allowance and tolerance above it, never below. Neighbouring passes
/// are joined along the surface, others over the security plane. Where the surface slopes so much across the
/// passes that ridges and tolerance come out higher than asked, passes are put between them, there only; not
/// with a stated stepover, nor as long as all ridges lie within half of the tolerance above scallop_mm.
///
/// Where that is shorter, what is steep (finish.cpp: kSteepRad) is cut at constant heights, from above.
///
/// Needs  a cutter without a corner (MillEnd::ball_mm above 0); stepover or scallop > 0.
/// Fails  as rough; TPA-NOTHING if the wider ball before it left no more than it may.
/// Notes  FRF-SCALLOP  on what share ridges are higher than scallop_mm in the path returned, and how high
[[nodiscard]] Result<FreeformPath> finish(const FreeformJob& task, Job& job);

}  // namespace capstan::toolpath::freeform
