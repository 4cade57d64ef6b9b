#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "planner/proof/verify/plan/plan_checks.h"

// A move is as fast along an axis as its heading's part of the feed. On an arc the heading turns, so that
// each axis gets the whole feed somewhere; where the start is farther from the centre than the end, more than
// it.

namespace capstan::verify {
namespace {

constexpr double kMost = 1000.0;    ///< mm/min, of X, Y and Z
constexpr double kAnyGapMm = 1e3;   ///< radii are not what is looked at
constexpr double kRounding = 1e-6;  ///< share

bool too_fast(Move m, double feed_mm_min) {
  model::Machine machine;
  for (auto& axis : machine.axes) axis.feed_max_mm_min = kMost;
  m.feed_mm_min = feed_mm_min;
  StepMoves step;
  step.moves = {m};
  Findings findings;
  check_moves(step, machine, kAnyGapMm, findings);
  const auto all = findings.take();
  return std::any_of(all.begin(), all.end(), [](const auto& f) { return f.code == "CHK-FEED-AXIS"; });
}

Move half_turn(double from_mm, double to_mm) {
  Move m;
  m.kind = model::MoveKind::kArcCcw;
  m.from = {from_mm, 0.0, 0.0};
  m.to = {-to_mm, 0.0, 0.0};
  return m;
}

TEST(AxisFeeds, OnAnArcTheAxesBearTheWholeFeed) {
  EXPECT_FALSE(too_fast(half_turn(10.0, 10.0), kMost));
  EXPECT_TRUE(too_fast(half_turn(10.0, 10.0), 1.001 * kMost));
}

TEST(AxisFeeds, OnAnArcThatBeginsFartherFromItsCentreTheAxesFeedFaster) {
  // At its start it is 10 % faster than at its end, where it has the feed.
  const Move m = half_turn(11.0, 10.0);
  EXPECT_TRUE(too_fast(m, kMost));
  EXPECT_TRUE(too_fast(m, kMost * (1.001 + kRounding) / 1.1));
  EXPECT_FALSE(too_fast(m, kMost * (1.0 - kRounding) / 1.1));
  EXPECT_FALSE(too_fast(half_turn(10.0, 11.0), kMost));
}

TEST(AxisFeeds, OnALineAnAxisBearsItsPartOfTheFeed) {
  Move m;
  m.kind = model::MoveKind::kLine;
  m.to = {3.0, 4.0, 0.0};
  EXPECT_FALSE(too_fast(m, kMost / 0.8));
  EXPECT_TRUE(too_fast(m, 1.001 * kMost / 0.8));
}

}  // namespace
}  // namespace capstan::verify
