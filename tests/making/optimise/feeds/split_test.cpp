// Moves are cut where what they bear changes; the way stays.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "planner/physics/motion/time.h"
#include "tests/making/optimise/feeds/examples.h"

namespace capstan::optimise {
namespace {

using examples::cut_along;
using examples::question;
using model::CutterPath;
using model::MoveRole;
using std::numbers::pi;

TEST(SplitMoves, SeparatesAHeavyEndFromALightMove) {
  FeedQuestion q = question();
  q.cut.peak_force_limit_n = 500.0;
  CutterPath p;
  p.start({0, 0, 0});
  p.line({100, 0, 0}, MoveRole::kCut);
  cut_along(q, p, 1, 1.0, 1.0, 0.0, 80.0);
  cut_along(q, p, 1, 8.0, 8.0, 80.0);
  split_moves(q, p, nullptr);
  ASSERT_EQ(p.size(), 3U);
  EXPECT_NEAR(p.x[1], 80.0, 1e-9);
  const auto a = feeds(q, p);
  EXPECT_GT(a.schedule.feed_mm_min[1], 3.0 * a.schedule.feed_mm_min[2]);
  for (const CutSample& s : q.samples) EXPECT_EQ(s.move, s.ap_mm > 4.0 ? 2U : 1U);
}

TEST(SplitMoves, MakesNoPieceOfARampSteeperThanItIsByTheProgramsDigits) {
  FeedQuestion q = question();
  q.cut.machine.control.decimals = 3;
  const auto written = [](double v) { return std::round(1000.0 * v) / 1000.0; };
  const double slope = std::tan(3.0 * pi / 180.0);
  for (int i = 0; i < 200; ++i) {
    q.cut.peak_force_limit_n = 500.0;
    q.samples.clear();
    const double from = -1.0 - 0.000137 * i;
    CutterPath p;
    p.start({0, 0, from});
    p.line({20, 0, from - slope * (20.0 - 0.005) + 0.001}, MoveRole::kRamp);
    cut_along(q, p, 1, 8.0, 8.0, 0.0, 2.2 + 0.003 * i);
    cut_along(q, p, 1, 1.0, 1.0, 2.2 + 0.003 * i);
    split_moves(q, p, nullptr);
    ASSERT_EQ(p.size(), 3U);
    for (std::size_t k = 1; k < p.size(); ++k) {
      const double along = written(p.x[k]) - written(p.x[k - 1]);
      EXPECT_LE(std::atan((written(p.z[k - 1]) - written(p.z[k])) / along), std::atan(slope) + 1e-4) << i;
    }
  }
}

TEST(SplitMoves, CutsAFullCircleWhereItsEntryEnds) {
  FeedQuestion q = question();
  q.cut.peak_force_limit_n = 500.0;
  CutterPath p;
  p.start({10, 0, 0});
  p.arc({10, 0, 0}, {0, 0}, false, MoveRole::kCut);
  const double whole = 2.0 * pi * 10.0;
  cut_along(q, p, 1, 4.0, 10.0, 0.0, 0.25 * whole);
  cut_along(q, p, 1, 4.0, 1.0, 0.25 * whole);
  split_moves(q, p, nullptr);
  ASSERT_EQ(p.size(), 3U);
  EXPECT_NEAR(p.x[1], 0.0, 1e-9);
  EXPECT_NEAR(p.y[1], 10.0, 1e-9);
  EXPECT_NEAR(model::move_length(p, 1) + model::move_length(p, 2), whole, 1e-9);
}

TEST(SplitMoves, RenumbersSectionsFactorsAndDwellsWithTheMoves) {
  FeedQuestion q = question();
  q.cut.peak_force_limit_n = 500.0;
  CutterPath p;
  p.start({0, 0, 0});
  p.line({40, 0, 0}, MoveRole::kCut);
  p.line({80, 0, 0}, MoveRole::kCut);
  model::SectionSeries s;
  for (std::uint32_t move : {1U, 2U}) {
    cut_along(q, p, move, 1.0, 1.0, 0.0, 20.0);
    cut_along(q, p, move, 8.0, 8.0, 20.0);
  }
  for (const CutSample& c : q.samples) {
    s.move.push_back(c.move);
    s.at_mm.push_back(c.at_mm);
  }
  q.feed_factor = {1.0, 1.0, 0.5};
  q.dwell_s = {0.0, 0.1, 0.2};
  split_moves(q, p, &s);
  ASSERT_EQ(p.size(), 5U);
  EXPECT_EQ(q.feed_factor, (std::vector<double>{1.0, 1.0, 1.0, 0.5, 0.5}));
  EXPECT_EQ(q.dwell_s, (std::vector<double>{0.0, 0.0, 0.1, 0.0, 0.2}));
  for (std::size_t k = 0; k < s.size(); ++k) {
    EXPECT_EQ(s.move[k], q.samples[k].move);
    EXPECT_NEAR(s.at_mm[k], q.samples[k].at_mm, 1e-12);
    EXPECT_LE(s.at_mm[k], model::move_length(p, s.move[k]) + 1e-9);
    EXPECT_GT(s.at_mm[k], 0.0);
  }
}

// Of cells it is known to half of one only where a cut begins: the heavy one may begin, and end, as much
// farther on.
TEST(SplitMoves, IsSlowWhereACutMayBeginOrEndForAllThatIsKnown) {
  FeedQuestion q = question();
  q.cut.peak_force_limit_n = 500.0;
  q.known_to_mm = 0.5;
  CutterPath p;
  p.start({0, 0, 0});
  p.line({100, 0, 0}, MoveRole::kCut);
  cut_along(q, p, 1, 1.0, 1.0, 0.0, 40.0);
  cut_along(q, p, 1, 8.0, 8.0, 40.0, 80.0);
  cut_along(q, p, 1, 1.0, 1.0, 80.0);
  split_moves(q, p, nullptr);
  ASSERT_EQ(p.size(), 4U);
  EXPECT_NEAR(p.x[1], 39.5, 1e-9);
  EXPECT_NEAR(p.x[2], 80.5, 1e-9);
  EXPECT_NEAR(p.x[3], 100.0, 1e-12);
}

// As where a finishing mill meets the next wall: the last tenth of a millimetre is heavy. A piece is at least
// a fifth of the diameter long, and takes that from the straight; the straight keeps its feed.
TEST(SplitMoves, LetsAHeavyEndThatIsTooShortTakeWhatItLacksFromTheStraight) {
  FeedQuestion q = question();
  q.cut.peak_force_limit_n = 500.0;
  const double least = 0.2 * q.cut.cutter.cutting_diameter_mm;
  for (const bool at_end : {true, false}) {
    q.samples.clear();
    CutterPath p;
    p.start({0, 0, 0});
    p.line({100, 0, 0}, MoveRole::kCut);
    const double heavy = 0.1, light = 100.0 - heavy;
    if (at_end) {
      cut_along(q, p, 1, 1.0, 1.0, 0.0, light);
      cut_along(q, p, 1, 8.0, 8.0, light);
    } else {
      cut_along(q, p, 1, 8.0, 8.0, 0.0, heavy);
      cut_along(q, p, 1, 1.0, 1.0, heavy);
    }
    split_moves(q, p, nullptr);
    ASSERT_EQ(p.size(), 3U) << at_end;
    EXPECT_NEAR(p.x[1], at_end ? 100.0 - least : least, 1e-9);
    const auto a = feeds(q, p);
    const std::size_t fast = at_end ? 1 : 2, slow = at_end ? 2 : 1;
    EXPECT_GT(a.schedule.feed_mm_min[fast], 3.0 * a.schedule.feed_mm_min[slow]);
    for (const CutSample& s : q.samples) EXPECT_TRUE(s.ap_mm < 4.0 || s.move == slow) << s.at_mm;
    q = question();
    q.cut.peak_force_limit_n = 500.0;
  }
}

TEST(SplitMoves, LeavesAnEvenMoveWhole) {
  FeedQuestion q = question();
  CutterPath p;
  p.start({0, 0, 0});
  p.line({100, 0, 0}, MoveRole::kCut);
  cut_along(q, p, 1, 4.0, 4.0);
  const CutterPath before = p;
  split_moves(q, p, nullptr);
  EXPECT_EQ(p, before);
}

TEST(SplitMovesProperty, KeepsTheWayAndMakesNoShortPieces) {
  std::mt19937 random(17);
  for (int round = 0; round < 20; ++round) {
    FeedQuestion q = question();
    q.cut.peak_force_limit_n = 800.0;
    CutterPath p = examples::random_path(q, random);
    const CutterPath before = p;
    split_moves(q, p, nullptr);
    double length_before = 0.0;
    double length = 0.0;
    std::size_t at = 0;  // every old point is passed, in order
    for (std::size_t i = 0; i < before.size(); ++i) {
      length_before += model::move_length(before, i);
      while (at < p.size() && !(p.point(at) == before.point(i))) ++at;
      ASSERT_LT(at, p.size());
    }
    for (std::size_t i = 1; i < p.size(); ++i) {
      length += model::move_length(p, i);
      const bool old = std::find(before.x.begin(), before.x.end(), p.x[i]) != before.x.end();
      const bool from_old = std::find(before.x.begin(), before.x.end(), p.x[i - 1]) != before.x.end();
      if (!old || !from_old) {
        EXPECT_GE(model::move_length(p, i), 2.0 - 1e-6);
      }
    }
    EXPECT_NEAR(length, length_before, 1e-6 * length_before);
  }
}

}  // namespace
}  // namespace capstan::optimise
