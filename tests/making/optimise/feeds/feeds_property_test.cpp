// What holds of the feeds of random paths, whatever their sections are.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "planner/making/optimise/feeds.h"
#include "tests/making/optimise/feeds/examples.h"
#include "tests/support/soak.h"

namespace capstan::optimise {
namespace {

using examples::cutting_s;
using examples::question;
using examples::random_path;
using model::CutterPath;
using model::MoveRole;

// More questions than are kept at a time, asked by turns, some of them twice with other paths.
TEST(FeedsProperty, AreTheSameWithWhatWasKnownBefore) {
  std::mt19937 random(20261125);
  KnownFeeds known;
  for (int round = 0; round < rounds(20, 60); ++round) {
    FeedQuestion q = question();
    q.explain = round % 4 == 0;
    q.cut.depth_mm += static_cast<double>(round % 20);
    q.cut.peak_force_limit_n = round % 3 == 0 ? 900.0 : 0.0;
    q.cut.cutter.corner_radius_mm = round % 5 == 0 ? 1.0 : 0.0;
    q.feed_mm_min *= round % 2 == 0 ? 1.0 : 0.9;
    CutterPath p = random_path(q, random);
    if (round % 7 == 0) q.samples.front().entry_rad = std::nan("");
    FeedQuestion again = q;
    CutterPath again_p = p;
    split_moves(q, p, nullptr);
    split_moves(again, again_p, nullptr, &known);
    ASSERT_EQ(again_p, p) << "round " << round;
    const FeedAnswer a = feeds(q, p), b = feeds(again, again_p, &known);
    ASSERT_EQ(b.schedule.feed_mm_min, a.schedule.feed_mm_min) << "round " << round;
    ASSERT_EQ(b.schedule.spindle_rpm, a.schedule.spindle_rpm);
    ASSERT_EQ(b.peak, a.peak) << "round " << round;
    ASSERT_EQ(b.held_by.size(), a.held_by.size());
    ASSERT_EQ(b.worst_excess, a.worst_excess) << "round " << round;
  }
}

// At every sample the scheduled feed keeps every limit, computed without the grid.
TEST(FeedsProperty, KeepEveryLimitAtEverySampleOfRandomPaths) {
  std::mt19937 random(20261121);
  for (int round = 0; round < 12; ++round) {
    FeedQuestion q = question();
    q.explain = false;
    q.cut.peak_force_limit_n = round % 2 == 0 ? 900.0 : 0.0;
    q.cut.cutter.corner_radius_mm = round % 3 == 0 ? 1.0 : 0.0;
    if (round % 5 == 0)
      q.cut.material.mechanistic = {{"carbide", 1500, 30, 500, 40, 200, 2, 0.3, "made up for this test"}};
    CutterPath p = random_path(q, random);
    if (round % 2 == 1) split_moves(q, p, nullptr);
    const auto a = feeds(q, p);
    bool at_least = false;
    std::size_t judged = 0;
    for (const CutSample& s : q.samples) {
      const double feed = a.schedule.feed_mm_min[s.move];
      // What even the least feed does not keep is reported as an excess.
      if (feed <= std::max(kLeastFeedShare * q.feed_mm_min, least_feed_mm_min(q.cut, q.n_rpm)) + 0.1) {
        at_least = true;
        continue;
      }
      const auto excess = excess_at(q, s, feed);
      ASSERT_TRUE(excess);
      ++judged;
      EXPECT_LE(*excess, 1e-9) << "round " << round << " move " << s.move << " at " << s.at_mm << ": ap "
                               << s.ap_mm << " ae " << s.ae_mm << " arc " << s.entry_rad << ".."
                               << s.exit_rad;
    }
    EXPECT_GT(judged, 0U) << "round " << round << " looked at no sample";
    if (!at_least) {
      EXPECT_LE(a.worst_excess, 1e-9);
    }
  }
}

TEST(FeedsProperty, TheConstantFeedIsTheLargestThatEverySectionBears) {
  std::mt19937 random(7);
  for (int round = 0; round < 8; ++round) {
    FeedQuestion q = question();
    q.explain = false;
    q.constant = true;
    q.cut.peak_force_limit_n = 900.0;
    const CutterPath p = random_path(q, random);
    const auto a = feeds(q, p);
    double one = 0.0;
    for (std::size_t i = 1; i < p.size(); ++i) {
      if (p.role[i] == MoveRole::kCut && p.kind[i] != model::MoveKind::kRapid)
        one = std::max(one, a.schedule.feed_mm_min[i]);
    }
    for (std::size_t i = 1; i < p.size(); ++i) {
      if (p.role[i] == MoveRole::kCut && p.kind[i] != model::MoveKind::kRapid) {
        EXPECT_EQ(a.schedule.feed_mm_min[i], one);
      }
    }
    double worst = -1.0;
    double one_more = -1.0;
    for (const CutSample& s : q.samples) {
      if (p.role[s.move] == MoveRole::kRamp) continue;
      worst = std::max(worst, excess_at(q, s, one).value_or(1.0));
      one_more = std::max(one_more, excess_at(q, s, 1.01 * one).value_or(1.0));
    }
    EXPECT_LE(worst, 1e-9);
    EXPECT_GT(one_more, 0.0);
  }
}

TEST(FeedsProperty, AreNeverSlowerInAllThanTheConstantFeed) {
  std::mt19937 random(11);
  for (int round = 0; round < 8; ++round) {
    FeedQuestion q = question();
    q.explain = false;
    q.cut.peak_force_limit_n = 900.0;
    const CutterPath p = random_path(q, random);
    FeedQuestion constant = q;
    constant.constant = true;
    const double free_s = cutting_s(q, p, feeds(q, p).schedule);
    const double constant_s = cutting_s(q, p, feeds(constant, p).schedule);
    EXPECT_LE(free_s, constant_s * (1.0 + 1e-9));
    FeedQuestion cut = q;
    CutterPath pieces = p;
    split_moves(cut, pieces, nullptr);
    EXPECT_LE(cutting_s(cut, pieces, feeds(cut, pieces).schedule), free_s * (1.0 + 1e-3));
  }
}

TEST(FeedsProperty, TheSameQuestionHasTheSameAnswer) {
  std::mt19937 random(3);
  FeedQuestion q = question();
  const CutterPath p = random_path(q, random);
  const auto a = feeds(q, p);
  const auto b = feeds(q, p);
  EXPECT_EQ(a.schedule, b.schedule);
  EXPECT_EQ(a.held_by, b.held_by);
  EXPECT_EQ(a.peak, b.peak);
}

TEST(FeedsProperty, SharesOfTheLimitsAddUpToTheCuttingTime) {
  std::mt19937 random(5);
  FeedQuestion q = question();
  q.cut.peak_force_limit_n = 900.0;
  const CutterPath p = random_path(q, random);
  double sum = 0.0;
  for (const auto& l : feeds(q, p).held_by) {
    EXPECT_GE(l.share, 0.0);
    EXPECT_GE(l.saves_s, 0.0);
    EXPECT_FALSE(l.name.empty());
    sum += l.share;
  }
  EXPECT_NEAR(sum, 1.0, 0.01);
}

}  // namespace
}  // namespace capstan::optimise
