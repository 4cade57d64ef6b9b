#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "planner/making/optimise/feeds/cut_classes.h"

/// Largest feed of each move of a path, and the limit that determines it.
namespace capstan::optimise::feed {

/// Limit that determines a move's feed: first the limits of a section, in their order.
/// Below kLimits: the limit at that place of kSectionLimits.
enum class FeedBound : std::uint8_t {
  kStepFeed = kLimits,  ///< the planned feed, or the bound of chip thinning
  kEndCut,              ///< plunges and ramps: their fraction of the step's feed
  kAir,
  kAxisFeed,
  kAcceleration,
  kUnknown,  ///< sections outside the formulas' range: the least feed
};
inline constexpr std::size_t kFeedBounds = 13;

/// `more[k]`: the same with 10 % more of FeedBound k, as far as sections and the planned feed go.
struct Cap {
  double feed_mm_min = 0.0;
  FeedBound by = FeedBound::kStepFeed;
  std::array<double, kLimits + 1> more{};
};

/// The largest feed at which one sample keeps every limit, without the step's own bounds; infinite where no
/// feed reaches a limit.
struct SampleFeed {
  double feed_mm_min = 0.0;
  Column at_limit{}, at_more{};
  bool known = true;  ///< false: outside the formulas' range
};
[[nodiscard]] SampleFeed sample_feed(CutClasses& classes, const CutSample& sample,
                                     const CutQuestion& question, double n_rpm);

/// The spindle's speed on a move.
[[nodiscard]] double rpm_on(const FeedQuestion& q, std::size_t move);

/// One entry per move; rapids and dwells hold zeros. Needs samples in order of moves.
[[nodiscard]] std::vector<Cap> caps_of(const FeedQuestion& q, const model::CutterPath& path,
                                       CutClasses& classes);

}  // namespace capstan::optimise::feed
