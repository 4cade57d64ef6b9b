#include "planner/proof/verify/sweep/known/as_planned.h"

#include <gtest/gtest.h>

#include <cmath>

namespace capstan::verify {
namespace {

using geometry::Vec3;
using model::MoveKind;

constexpr double kHalfUnit = 5e-5;  // four decimals
double four(double v) { return std::round(v * 1e4) / 1e4; }
Vec3 four(Vec3 v) { return {four(v.x), four(v.y), four(v.z)}; }

Move move(MoveKind kind, Vec3 from, Vec3 to, double feed = 0.0) {
  Move m;
  m.kind = kind;
  m.from = from;
  m.to = to;
  m.feed_mm_min = feed;
  m.spindle_rpm = 4321.4;
  return m;
}

/// Down to (1/3, 2/3), along, a quarter circle of radius 2, up, and aside on a slant.
std::vector<Move> planned() {
  const Vec3 start{1.0 / 3.0, 2.0 / 3.0, 5.0}, down{1.0 / 3.0, 2.0 / 3.0, -1.23456},
      on{10.0 / 3.0, 2.0 / 3.0, -1.23456};
  const Vec3 turned{10.0 / 3.0 + 2.0, 2.0 / 3.0 + 2.0, -1.23456};
  std::vector<Move> out = {move(MoveKind::kRapid, {1.0 / 3.0, 2.0 / 3.0, 50.0}, start),
                           move(MoveKind::kLine, start, down, 300.04),
                           move(MoveKind::kLine, down, on, 1000.0 / 7.0),
                           move(MoveKind::kArcCcw, on, turned, 800.0),
                           move(MoveKind::kRapid, turned, {turned.x, turned.y, 5.0}),
                           move(MoveKind::kRapid, {turned.x, turned.y, 5.0}, {0.0, 0.0, 5.0})};
  out[3].centre = {10.0 / 3.0, 2.0 / 3.0 + 2.0};
  return out;
}

/// The same as four decimals, feeds with one and whole speeds have it: to the start by rapids, up in two, a
/// retract behind it.
StepMoves written() {
  StepMoves out;
  out.feed_rounding_mm_min = 0.05;
  out.speed_rounding_rpm = 0.5;
  const std::vector<Move> plan = planned();
  const Vec3 start = four(plan[0].to);
  out.moves = {move(MoveKind::kRapid, {0.0, 0.0, 1e5}, {start.x, start.y, 1e5}),
               move(MoveKind::kRapid, {start.x, start.y, 1e5}, start)};
  for (std::size_t i = 1; i < 4; ++i) {
    Move m = move(plan[i].kind, four(plan[i].from), four(plan[i].to),
                  std::round(plan[i].feed_mm_min * 10.0) / 10.0);
    m.centre = {four(plan[i].centre.x), four(plan[i].centre.y)};
    out.moves.push_back(m);
  }
  const Vec3 turned = out.moves.back().to, half{turned.x, turned.y, 2.0}, up{turned.x, turned.y, 5.0};
  out.moves.push_back(move(MoveKind::kRapid, turned, half));
  out.moves.push_back(move(MoveKind::kRapid, half, up));
  out.moves.push_back(move(MoveKind::kRapid, up, {0.0, 0.0, 5.0}));
  out.moves.push_back(move(MoveKind::kRapid, {0.0, 0.0, 5.0}, {0.0, 0.0, 80.0}));
  long line = 100;
  for (Move& m : out.moves) {
    m.rounding_mm = kHalfUnit;
    m.spindle_rpm = 4321.0;
    m.where = line++;
  }
  return out;
}

TEST(AsPlanned, APlanInFourDecimalsIsThePlan) {
  const auto same = as_planned(written(), planned());
  ASSERT_TRUE(same);
  EXPECT_EQ(same->first, 2U);
  EXPECT_EQ(same->last, 8U);  // without the retract
  EXPECT_EQ(same->where, (std::vector<long>{102, 102, 103, 104, 105, 107}));
}

TEST(AsPlanned, MovesThatStayAndWaitsAreNotCompared) {
  StepMoves text = written();
  Move waits = text.moves[3];
  waits.kind = MoveKind::kDwell;
  Move stays = text.moves[3];
  stays.to = stays.from;
  text.moves.insert(text.moves.begin() + 3, {waits, stays});
  EXPECT_TRUE(as_planned(text, planned()));
}

TEST(AsPlanned, AnotherEndFeedSpeedKindOrCentreIsAnotherMove) {
  const auto with = [](auto change) {
    StepMoves text = written();
    change(text.moves);
    return as_planned(text, planned()).has_value();
  };
  EXPECT_TRUE(with([](auto&) {}));
  EXPECT_FALSE(with([](auto& m) { m[3].to.z -= 1e-4; }));  // one unit deeper
  EXPECT_FALSE(with([](auto& m) { m[2].from.x += 1e-4; }));
  EXPECT_FALSE(with([](auto& m) { m[3].feed_mm_min += 0.1; }));
  EXPECT_FALSE(with([](auto& m) { m[3].spindle_rpm += 1.0; }));
  EXPECT_FALSE(with([](auto& m) { m[3].synchronised = true; }));
  EXPECT_FALSE(with([](auto& m) { m[4].kind = MoveKind::kArcCw; }));
  EXPECT_FALSE(with([](auto& m) { m[4].kind = MoveKind::kLine; }));
  EXPECT_FALSE(with([](auto& m) { m[4].centre.x += 5e-4; }));
  EXPECT_FALSE(with([](auto& m) { m[4].centre.x += 3e-4, m[4].centre.y += 3e-4; }));
  EXPECT_FALSE(with([](auto& m) { m[5].to.x = m[6].from.x += 1e-3; }));  // aside of its way
  EXPECT_FALSE(with([](auto& m) { m[5].spindle_rpm = 0.0; }));
  EXPECT_FALSE(with([](auto& m) { m.erase(m.begin() + 3); }));
  EXPECT_FALSE(with([](auto& m) { m.erase(m.begin() + 4, m.end()); }));
}

TEST(AsPlanned, ARapidOnASlantIsOneMoveAndNoneGoesBackOrJumps) {
  StepMoves corner = written(), back = written(), jump = written();
  Move aside = corner.moves[7];
  aside.to.y = aside.from.y;  // X first, then Y: shank and holder go elsewhere
  corner.moves[7].from = aside.to;
  corner.moves.insert(corner.moves.begin() + 7, aside);
  EXPECT_FALSE(as_planned(corner, planned()));
  Move down = back.moves[5];
  std::swap(down.from, down.to);
  back.moves.insert(back.moves.begin() + 6, {down, back.moves[5]});
  EXPECT_FALSE(as_planned(back, planned()));
  jump.moves[6].from.z = 3.0;
  EXPECT_FALSE(as_planned(jump, planned()));
}

TEST(AsPlanned, WhatStaysElsewhereOrTurnsOtherwiseIsAMove) {
  StepMoves elsewhere = written(), stopped = written();
  Move m = elsewhere.moves[3];
  m.from = m.to = {50.0, 50.0, -5.0};
  elsewhere.moves.insert(elsewhere.moves.begin() + 3, m);
  EXPECT_FALSE(as_planned(elsewhere, planned()));
  Move s = stopped.moves[3];
  s.to = s.from;
  s.spindle_rpm = 0.0;
  stopped.moves.insert(stopped.moves.begin() + 3, s);
  EXPECT_FALSE(as_planned(stopped, planned()));
}

TEST(AsPlanned, AFeedWhoseDecimalsTheCheckDoesNotAllowForIsTheSameNumberOrAnother) {
  StepMoves text = written();
  text.feed_rounding_mm_min = 2.0;  // 1.4 % of 142.857
  text.moves[3].feed_mm_min = 143.0;
  EXPECT_FALSE(as_planned(text, planned()));
  auto plan = planned();
  plan[1].feed_mm_min = 300.0;
  plan[2].feed_mm_min = 143.0;
  EXPECT_TRUE(as_planned(text, plan));
}

TEST(AsPlanned, AFeedMoveBeforeOrBehindIsNotThePlans) {
  StepMoves before = written(), behind = written();
  before.moves[1].kind = MoveKind::kLine;
  behind.moves.back().kind = MoveKind::kLine;
  EXPECT_FALSE(as_planned(before, planned()));
  EXPECT_FALSE(as_planned(behind, planned()));
}

TEST(AsPlanned, CoarseDecimalsAreSweptByThemselves) {
  StepMoves text = written();
  for (Move& m : text.moves) m.rounding_mm = 5e-3;
  EXPECT_FALSE(as_planned(text, planned()));
}

TEST(AsPlanned, APlansOwnMovesHaveNoDecimals) {
  StepMoves text;
  text.moves = planned();
  EXPECT_FALSE(as_planned(text, planned()));
}

}  // namespace
}  // namespace capstan::verify
