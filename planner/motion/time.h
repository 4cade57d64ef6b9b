#pragma once

#include <vector>

#include "planner/base/result.h"
#include "planner/model/cutter_path.h"
#include "planner/model/machine.h"
#include "planner/model/plan.h"

namespace capstan::motion {

/// How long one workingstep takes. Units: s, mm/min.
struct StepTime {
  double cutting_s = 0.0;  ///< moves at feed
  double rapid_s = 0.0;
  double dwell_s = 0.0;
  double spindle_s = 0.0;           ///< waiting for changes of speed or direction within the step
  std::vector<double> move_s;       ///< parallel to the path; entry 0 is 0
  std::vector<double> peak_mm_min;  ///< the highest speed each move reaches: below the feed where it is short
  [[nodiscard]] double total_s() const { return cutting_s + rapid_s + dwell_s + spindle_s; }
};

/// The time of a path, limited by acceleration as LinuxCNC 2.9 limits it (it has no jerk limit).
///
/// Between stops a forward and a backward scan keep each speed reachable. A junction is passed at the speed
/// of the arc that rounds it within the path tolerance P of G64:
///
///     R = min(P sin(t) / (1 - sin(t)), tan(t) min(L1, L2) / 2)      v = sqrt(0.866 a R)
///
/// t is half the angle between the moves (pi/2: straight on), and a the acceleration that every axis can
/// give in the plane of the corner. An arc is run at no more than sqrt(0.866 a R), and braked with what the
/// centripetal acceleration leaves. Full stops: between rapid and feed, at dwells, at changes of spindle
/// speed, at both ends of tapping moves, at either end of the path. The time of the corner itself is that of
/// the sharp one (the rounding is shorter).
///
/// Units   the path's and schedule's; the machine's axes limit speed and acceleration each.
/// Needs   a schedule parallel to the path.
/// Fails   MOT-SCHEDULE when the schedule is of another length, MOT-FEED for a move without a feed,
///         MOT-MACHINE for an axis without acceleration or speed, MOT-NUMBER for a number that is not finite.
/// Cost    linear; three vectors, nothing is allocated per move.
/// Source  LinuxCNC 2.9 src/emc/tp: blendmath.c (blendComputeParameters, pmCircleActualMaxVel,
///         BLEND_ACC_RATIO_NORMAL = sqrt(1 - 0.5^2)), tp.c (handleModeChange).
[[nodiscard]] Result<StepTime> time_of(const model::CutterPath& path, const model::FeedSchedule& schedule,
                                       const model::Machine& machine);

/// How long the spindle takes from one speed to another, s: proportional to the difference, `spin_up_s` for
/// a start to rpm_max. Source: constant angular acceleration, derived.
[[nodiscard]] double spindle_change_s(const model::Spindle& spindle, double from_rpm, double to_rpm);

/// How long the whole plan takes, s.
struct PlanTime {
  double cutting_s = 0.0, rapid_s = 0.0, dwell_s = 0.0;
  double link_s = 0.0;  ///< rapids between steps with the same tool: up to the security plane, across, down
  double tool_change_s = 0.0;  ///< the machine's chip-to-chip time for each change
  double spin_up_s = 0.0;      ///< starts, stops and changes of the spindle
  int tool_changes = 0;
  [[nodiscard]] double total_s() const {
    return cutting_s + rapid_s + dwell_s + link_s + tool_change_s + spin_up_s;
  }
};

/// Sums the steps that have a path; time to re-clamp between set-ups is not known here.
/// Fails  as `time_of` of a step, naming it.
[[nodiscard]] Result<PlanTime> time_of(const model::Plan& plan);

/// The feed schedule of a step: its own, or its one feed and speed where it has none.
[[nodiscard]] model::FeedSchedule schedule_of(const model::StepResult& step);

}  // namespace capstan::motion
