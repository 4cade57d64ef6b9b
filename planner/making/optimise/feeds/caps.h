#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "planner/making/optimise/feeds/book.h"

/// What each move of a path may be fed at most, and why.
namespace capstan::optimise::feed {

/// What holds a move's feed: the limits of a section first, in their order.
/// Below kLimits: the limit at that place of kSectionLimits.
enum class Holder : std::uint8_t {
  kStepFeed = kLimits,  ///< the planned feed, or the bound of chip thinning
  kEndCut,              ///< plunges and ramps: their fraction of the step's feed
  kAir,
  kAxisFeed,
  kAcceleration,
  kUnknown,  ///< sections outside the formulas' range: the least feed
};
inline constexpr std::size_t kHolders = 13;

/// `more[k]`: the same with 10 % more of Holder k, as far as sections and the planned feed go.
struct Cap {
  double feed_mm_min = 0.0;
  Holder by = Holder::kStepFeed;
  std::array<double, kLimits + 1> more{};
};

/// Which kinds of cut sections are judged for.
[[nodiscard]] bool cuts_sideways(CutKind kind);

/// The feed that one sample bears, beyond the step's own bounds; infinite where it bears any.
struct Bears {
  double feed_mm_min = 0.0;
  Column at_limit{}, at_more{};
  bool known = true;  ///< false: outside the formulas' range
};
[[nodiscard]] Bears bears(Book& book, const CutSample& sample, const CutQuestion& question, double n_rpm);

/// The spindle's speed on a move.
[[nodiscard]] double rpm_on(const FeedQuestion& q, std::size_t move);

/// One entry per move; rapids and dwells hold zeros. Needs samples in order of moves.
[[nodiscard]] std::vector<Cap> caps_of(const FeedQuestion& q, const model::CutterPath& path, Book& book);

}  // namespace capstan::optimise::feed
