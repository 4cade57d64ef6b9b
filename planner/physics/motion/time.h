#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "planner/ground/base/result.h"
#include "planner/model/plan/cutter_path.h"
#include "planner/model/plan/plan.h"
#include "planner/model/plan/resources/machine.h"

namespace capstan::motion {

/// The limit that determines a move's highest speed.
enum class TopBy : std::uint8_t {
  kFeed,     ///< the schedule
  kAxes,     ///< the axes' speed
  kTurning,  ///< an arc's centripetal acceleration
  kBlock,    ///< the control's least time per block
};

/// How long one workingstep takes. Units: s, mm/min.
struct StepTime {
  double cutting_s = 0.0;  ///< moves at feed
  double rapid_s = 0.0;
  double dwell_s = 0.0;
  double spindle_s = 0.0;           ///< waiting for changes of speed or direction within the step
  std::vector<double> move_s;       ///< parallel to the path; entry 0 is 0
  std::vector<double> peak_mm_min;  ///< the highest speed each move reaches: below the feed where it is short
  std::vector<double> at_top_s;     ///< of move_s: at constant speed, the most that `top` allows the move
  std::vector<TopBy> top;
  double corner_s =
      0.0;  ///< of cutting_s: braking to and speeding up from corners that the path tolerance slows
  [[nodiscard]] double total_s() const { return cutting_s + rapid_s + dwell_s + spindle_s; }
};

/// The time of a path, limited by acceleration as LinuxCNC 2.9 limits it, and by jerk where an axis states
/// one (LinuxCNC 2.9 has no jerk limit; leave it out of its machines).
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
/// With jerk, every change of speed is one S-curve (profile.h) from where acceleration is zero to where it is
/// again: between places that are passed at their own limit, over as many moves as lie between. Corners and
/// the ends of arcs are passed at the same speeds as without: the jerk of turning is left to the tolerance.
/// Never faster than without jerk, and the same in the limit of large jerk.
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

/// Limits of the axes along each move, regardless of feed: input of a feed schedule.
struct MoveReach {
  double length_mm = 0.0;
  double most_mm_min = 0.0;         ///< axes and centripetal acceleration
  double acceleration_mm_s2 = 0.0;  ///< along the path
  double jerk_mm_s3 = 0.0;          ///< 0: no limit
  double entry_mm_min = 0.0;        ///< the most at which it is entered from the move before; 0: after a stop
};

/// Parallel to the path; entry 0, dwells and moves without length are zeros.
/// Fails  as `time_of`.
[[nodiscard]] Result<std::vector<MoveReach>> reach_along(const model::CutterPath& path,
                                                         const model::Machine& machine);

/// The most at which a move may be run so that it is braked within itself to `exit_mm_min`.
[[nodiscard]] double braked_mm_min(const MoveReach& move, double exit_mm_min);

/// How long the spindle takes from one speed to another, s: proportional to the difference, `spin_up_s` for
/// a start to rpm_max. Source: constant angular acceleration, derived.
[[nodiscard]] double spindle_change_s(const model::Spindle& spindle, double from_rpm, double to_rpm);

/// What one step takes of the plan's time, s: its own, and what comes before it.
struct StepShare {
  double cutting_s = 0.0;  ///< at feed, with dwells
  double rapid_s = 0.0;
  double link_s = 0.0;         ///< the way from the step before, with the same tool
  double tool_change_s = 0.0;  ///< where it begins with one
  double spindle_s = 0.0;  ///< its changes of speed, the stop before it; of the last step the last stop, too
  [[nodiscard]] double total_s() const { return cutting_s + rapid_s + link_s + tool_change_s + spindle_s; }
};

/// How long the whole plan takes, s.
struct PlanTime {
  double cutting_s = 0.0, rapid_s = 0.0, dwell_s = 0.0;
  double link_s = 0.0;  ///< rapids between steps with the same tool: up to the security plane, across, down
  double tool_change_s = 0.0;  ///< the machine's chip-to-chip time for each change
  double spin_up_s = 0.0;      ///< starts, stops and changes of the spindle
  int tool_changes = 0;
  std::vector<StepShare> steps;  ///< parallel to the plan's; zeros of one without a path. They add up to all
  [[nodiscard]] double total_s() const {
    return cutting_s + rapid_s + dwell_s + link_s + tool_change_s + spin_up_s;
  }
  /// As steps count it (StepResult::cutting_s): with the dwells.
  [[nodiscard]] double at_feed_s() const { return cutting_s + dwell_s; }
};

/// "4 min 10.6 s".
[[nodiscard]] std::string duration_text(double seconds);
/// "4 min 10.6 s: cutting 2 min 41.4 s, rapids 17.7 s, between steps 2.8 s, 10 tool changes 50 s,
/// spindle 18.7 s": cutting and rapids are what the steps' own add up to.
[[nodiscard]] std::string text_of(const PlanTime& t);

/// Sums the steps that have a path; time to re-clamp between set-ups is not known here.
/// Fails  as `time_of` of a step, naming it.
[[nodiscard]] Result<PlanTime> time_of(const model::Plan& plan);

/// The feed schedule of a step: its own, else one made of its single feed and speed.
[[nodiscard]] model::FeedSchedule schedule_of(const model::StepResult& step);

}  // namespace capstan::motion
