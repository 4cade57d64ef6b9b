#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "planner/ground/base/job.h"
#include "planner/ground/base/result.h"
#include "planner/ground/geometry/placement.h"
#include "planner/ground/geometry/region.h"
#include "planner/ground/vocabulary/noun_kind.h"
#include "planner/model/features/shape.h"
#include "planner/model/plan/cutter/cutter.h"
#include "planner/model/plan/cutter_path.h"
#include "planner/model/plan/proposal.h"

namespace capstan::toolpath {

/// Code of a refusal because there is no material above the bottom of the step.
inline constexpr const char* kNothingToCut = "TPA-NOTHING";

/// The way into the material that the file states (ISO 14649-11, approach_retract_strategy).
struct Approach {
  enum class Kind : std::uint8_t {
    kFree,     ///< not given: the path chooses
    kPlunge,   ///< plunge_toolaxis
    kRamp,     ///< plunge_ramp: angle
    kHelix,    ///< plunge_helix: radius, angle
    kZigzag,   ///< plunge_zigzag: angle, width
    kTangent,  ///< ap_retract_tangent: radius
    kAngle,    ///< ap_retract_angle: angle, length
  };
  Kind kind = Kind::kFree;
  double angle_rad = 0.0;
  double radius_mm = 0.0;
  double width_mm = 0.0;   ///< of a zigzag
  double length_mm = 0.0;  ///< travel length of kAngle
};

/// Drilling in steps (multistep_drilling).
struct Peck {
  double first_mm = 0.0;    ///< depth of the first step below the material's top, > 0
  double step_mm = 0.0;     ///< of each further step, > 0
  double retract_mm = 0.0;  ///< up after each step, to break the chip; 0: out of the hole, to clear it
  double dwell_s = 0.0;     ///< at the bottom of each step
};

/// Reduced speed and feed at the start and the end of drilling (drilling_type_strategy).
struct DrillPhases {
  double speed_at_start = 1.0, feed_at_start = 1.0;  ///< fractions
  double depth_of_start_mm =
      0.0;  ///< length of the start phase, full diameter below the feature's top; 0: none
  double speed_at_end = 1.0, feed_at_end = 1.0;
  double depth_of_end_mm = 0.0;  ///< of the end phase; 0: none
  /// true: depth_of_end is the depth at which the end phase begins (as NIST's interpreter of 2002 reads the
  /// standard). false: it is the length above the bottom.
  bool end_counts_from_top = false;
};

/// A wider cutter that milled the same area before, to the same floor.
struct Cleared {
  double diameter_mm = 0.0;
  double corner_radius_mm = 0.0;
  double allowance_side_mm = 0.0;
};

/// What the last pass of a head under an overhang takes from the walls, mm: the neck may bend within it
/// before. Default, unsourced.
inline constexpr double kLastSide = 0.25;
/// Largest factor of the feed of such a thin pass against a whole one; default, unsourced.
inline constexpr double kMostQuicker = 3.0;

/// Input of one workingstep's path.
///
/// Frame  everything named `_z_` is in the set-up's frame, z along the tool axis, away from the work.
///        `shape` is in its feature's frame, which `feature_in_setup` puts into the set-up's.
/// Units  mm, rad, s.
struct PathJob {
  std::string step;  ///< name of the workingstep, for messages; empty: none
  model::FeatureShape shape;
  geometry::Placement feature_in_setup;            ///< a turn about z and a shift; anything else is refused
  model::TypeId operation = model::TypeId::kNone;  ///< concrete operation, e.g. kBottomAndSideRoughMilling
  model::Cutter cutter;
  model::StrategyKind strategy = model::StrategyKind::kNone;  ///< kNone: what suits the shape
  bool climb = true;
  /// Not rings: passes that engage by `radial_depth_mm`, over less than 0.5 mm up to 1.35 times its arc (as
  /// measured), in corners too. Roughing between upright walls; where no such path is known: TPA-UNSUPPORTED.
  bool constant_engagement = false;

  double axial_depth_mm = 0.0;   ///< at most, per level; 0: the whole depth at once
  double radial_depth_mm = 0.0;  ///< stepover; 0: from `overlap`, else half the diameter
  double allowance_side_mm = 0.0, allowance_bottom_mm = 0.0;  ///< to be left
  /// Allowance that an earlier step left on walls and floor; unset: the feature is still solid.
  std::optional<double> left_on_side_mm, left_on_bottom_mm;
  /// An earlier step finished the floor: where it left no more, it is not cut again.
  bool floor_made = false;

  /// Rest machining of areas between upright walls: only the area that this cutter did not reach is cut.
  std::optional<Cleared> cleared_by;
  bool rest_follows = false;  ///< a later step cuts what this cutter cannot reach: no warning of it

  double start_z_mm = 0.0;     ///< top of the material over the feature
  double security_z_mm = 0.0;  ///< where the path begins and ends
  double retract_z_mm = 0.0;   ///< rapids go no lower; raised to start_z + clearance when below
  double clearance_mm = 2.0;   ///< between material and what moves fast above it

  // Given things; all optional.
  std::optional<geometry::Vec2> feed_direction;  ///< of straight passes, feature frame
  std::optional<bool> stepover_left;             ///< of bidirectional passes, seen along the feed
  std::optional<double> overlap;                 ///< fraction of the diameter that passes share
  std::optional<bool> rotation_ccw;              ///< of contours; with `climb` it says in-out or out-in
  std::optional<geometry::Vec2> start_point;     ///< feature frame: begin near here
  std::optional<bool> multiple_passes;           ///< false: one level only
  Approach approach, retract;
  /// Slope of the ways into the solid where `approach` states none, rad; 0: model::kUsualRampRad. Never
  /// steeper than the cutter may.
  double ramp_angle_rad = 0.0;
  double digit_mm = 0.0001;  ///< to which the program rounds coordinates
  /// Deepest bore along a helix, mm: levels below the first are entered through it. 0: as deep as a level.
  double ramp_depth_mm = 0.0;

  std::optional<double> cutting_depth_mm;      ///< drilling: of the full diameter (centre drill: of the tip)
  std::optional<double> previous_diameter_mm;  ///< hole already there
  double hole_above_mm =
      0.0;  ///< diameter of the narrower hole above, through which a wider one below is reached; 0: none
  double hole_below_mm =
      0.0;  ///< diameter of the narrower hole that continues below a cone or a shoulder; 0: none
  std::optional<Peck> peck;
  std::optional<DrillPhases> phases;
  std::optional<double> feed_on_retract;  ///< fraction of the feed; nothing: as usual for the operation
  double dwell_s = 0.0;                   ///< at the bottom
  bool spindle_stop_at_bottom = false;    ///< boring, reaming
  double break_through_mm = 0.0;          ///< below the bottom of what is through

  /// Under an overhang, by the feed of one edge beside the mouth: where both edges of the head cut in the
  /// middle, and where the whole front does, at most.
  double both_edges_share = 0.5, front_share = 1.0;
  /// There too: feed of the thin last pass along the walls; nothing: that of a chip as thick as the others'.
  std::optional<double> last_share;

  geometry::Region avoid;  ///< set-up frame: other walls, clamps; at every depth
  geometry::Region stock;  ///< set-up frame: outline of the raw material; empty: where the feature is
};

/// A path with what belongs to its moves. All columns have path.size() entries.
struct GeneratedPath {
  model::CutterPath path;
  std::vector<double> feed_factor;   ///< times the step's feed
  std::vector<double> speed_factor;  ///< times the step's speed; 0: stopped, -1: reversed (tapping out)
  std::vector<double> dwell_s;       ///< of kDwell moves, 0 elsewhere
  std::vector<double> levels_z_mm;   ///< heights of the tip, in the order in which they were cut
};

/// What a message about the path begins with: "step 'POCKET rough': ", or the feature's name.
[[nodiscard]] inline std::string about(const PathJob& task) {
  if (!task.step.empty()) return "step '" + task.step + "': ";
  return task.shape.name.empty() ? std::string() : task.shape.name + ": ";
}

/// The path of one workingstep: begins at the security plane above the entry, rapids down to the retract
/// plane and no further, enters, cuts, and ends at the security plane. Lines with role kApproach and kLink
/// run in air.
///
/// Needs   no state; the same job gives the same path.
/// Fails   TPA-FRAME    the feature is tilted against the tool axis
///         TPA-NO-FIT   the cutter does not fit anywhere (it says which would)
///         TPA-ENTRY    no legal way into the material for this cutter
///         TPA-NOTHING  what it would cut is gone already: its bottom is not below the material
///         TPA-DEPTH    no depth, or deeper than the cutter reaches
///         TPA-TOOL     this cutter cannot do this operation
///         TPA-NO-REST  the wider cutter left nothing
///         TPA-UNSUPPORTED  this kind of feature or operation has no path yet
/// Warns   (to `job`) TPA-REST what the cutter cannot reach, TPA-CHANGED a given value that was not legal.
[[nodiscard]] Result<GeneratedPath> generate(const PathJob& task, Job& job);

}  // namespace capstan::toolpath
