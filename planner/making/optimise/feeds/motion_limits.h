#pragma once

#include <vector>

#include "planner/making/optimise/feeds/move_limits.h"
#include "planner/physics/motion/time.h"

/// From what each move may be fed to what the machine can follow and a program may say.
namespace capstan::optimise::feed {

struct Followed {
  std::vector<double> feed_mm_min;
  std::vector<FeedBound> by;
};

/// `most` per move and what holds it; lowered so that each move brakes within itself to the next, grouped,
/// trimmed to what is reached, rounded down to 0.1 mm/min.
/// Needs   columns parallel to the path.
[[nodiscard]] Followed followed(const FeedQuestion& q, const model::CutterPath& path,
                                std::vector<double> most, std::vector<FeedBound> by,
                                const model::Machine& machine);

/// The schedule with these feeds, and the question's speeds and dwells.
[[nodiscard]] model::FeedSchedule schedule_with(const FeedQuestion& q, const model::CutterPath& path,
                                                std::vector<double> feeds);

/// Which limits hold the feed along the path, and what 10 % more of each would save.
[[nodiscard]] std::vector<model::LimitAlongPath> held_by(const FeedQuestion& q, const model::CutterPath& path,
                                                         const std::vector<Cap>& caps, CutClasses& classes,
                                                         const Followed& f);

}  // namespace capstan::optimise::feed
