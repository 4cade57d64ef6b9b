#pragma once

#include <cstdint>
#include <vector>

#include "planner/base/job.h"
#include "planner/model/cutter_path.h"
#include "planner/optimise/cut.h"

namespace capstan::optimise {

/// How the cutter is engaged somewhere along a move; what feeds are chosen from.
///
/// Frame  angles as in mechanics/immersion.h: 0 at the left of the feed, pi at its right, in the sense of
///        rotation.
struct CutSample {
  std::uint32_t move = 0;
  double ap_mm = 0.0, ae_mm = 0.0;
  bool plunge = false;
  double at_mm = 0.0;    ///< where on the move the sample's step ends
  double step_mm = 0.0;  ///< length it stands for
  double entry_rad = 0.0, exit_rad = 0.0;
  double csa_mm2 = 0.0;
};

struct FeedQuestion {
  CutQuestion cut;           ///< limits, cutter, material, machine
  double n_rpm = 0.0;        ///< of the step; positive clockwise, negative counter-clockwise
  double feed_mm_min = 0.0;  ///< of the step: the most along the path
  bool adapt = true;         ///< false: a given feed is executed as given
  bool constant = false;     ///< one feed for all cutting moves: the largest that every section bears
  std::vector<double> feed_factor, speed_factor, dwell_s;  ///< of the path's moves
  std::vector<CutSample> samples;                          ///< in order of moves
};

/// Feed of a plunge and of a ramp as a fraction of the step's feed, for cutters that may do it.
/// Default, unsourced (handbooks give a third to a half).
inline constexpr double kPlungeFraction = 0.3;
inline constexpr double kRampFraction = 0.5;
/// Feed of moves through air that may not be rapids (close above material): at least this, mm/min, as far as
/// the axes go. Default, unsourced.
inline constexpr double kAirFeedMmMin = 3000.0;
/// Feeds along a path are lowered in steps of this ratio, so that programs stay short and values repeat.
inline constexpr double kFeedStep = 0.9;

struct FeedAnswer {
  model::FeedSchedule schedule;
  model::StepLoads peak;                       ///< over all samples at the scheduled feed
  std::vector<std::string> slowed;             ///< names of the limits that slowed the path somewhere
  std::vector<model::LimitAlongPath> held_by;  ///< which limits hold the feed, largest share first
  double worst_excess = -1.0;                  ///< > 0: some sample exceeds a limit even at the least feed
};

/// Feed for each move: the step's feed, lowered where the measured section would break a limit on power,
/// torque, deflection or chip thickness, and for plunges and ramps.
[[nodiscard]] FeedAnswer feeds(const FeedQuestion& question, const model::CutterPath& path);

}  // namespace capstan::optimise
