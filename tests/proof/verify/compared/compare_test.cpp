#include "planner/proof/verify/compared/compare.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/proof/verify/volumes/bench.h"

// Faults planted in what the planner's reading gives: the comparison takes the shapes as a value.

namespace capstan::verify::volumes {
namespace {

/// The boundary of a region with every part between two corners straight: arcs as their chords.
geometry::Region chords(const geometry::Region& r, const std::vector<Vec2>& kept) {
  geometry::Region out;
  for (const auto& loop : r.loops) {
    geometry::Loop l;
    for (const Vec2 p : loop) {
      if (std::any_of(kept.begin(), kept.end(), [&](Vec2 k) { return norm(p - k) < 0.01; })) l.push_back(p);
    }
    out.loops.push_back(std::move(l));
  }
  return out;
}

TEST(Meaning, ACompoundsHolesDrilledAtTheOriginAreFound) {
  Bench k;
  const auto c = k.compound(k.at(100, 50, 0), {k.hole(0, 0, 8, 10), k.hole(20, 0, 6, 10)});
  ASSERT_EQ(k.agree(c), "");
  auto shapes = k.planner(c);
  shapes[0].frame.origin = {0, 0, 0};
  shapes[1].frame.origin = {20, 0, 0};
  const auto d = disagreement(k.own(c), shapes, k.raw);
  ASSERT_TRUE(d);
  EXPECT_TRUE(d->removed);  // at (100, 50), where the planner drills nothing
  EXPECT_LT(std::hypot(d->at.x - 100, d->at.y - 50), 4.0) << Bench::to_text(*d);
}

TEST(Meaning, AnArcTakenAsItsChordIsFound) {
  Bench k;
  const auto p = k.with_round_end(true);
  ASSERT_EQ(k.agree(p), "");
  auto shapes = k.planner(p);
  shapes[0].area = chords(shapes[0].area, {{20, 15}, {-20, 15}, {-20, -15}, {20, -15}});
  ASSERT_NEAR(geometry::area(shapes[0].area), 40 * 30, 1e-3);
  const auto d = disagreement(k.own(p), shapes, k.raw);
  ASSERT_TRUE(d);
  EXPECT_TRUE(d->removed);
  EXPECT_GT(d->at.x, 120.0);  // beyond the chord at x = 100 + 20
}

TEST(Meaning, AnArcTakenTheOtherWayRoundIsFound) {
  Bench k;
  const auto bulging = k.with_round_end(true), hollow = k.with_round_end(false);
  ASSERT_EQ(k.agree(bulging), "");
  ASSERT_EQ(k.agree(hollow), "");
  EXPECT_TRUE(disagreement(k.own(bulging), k.planner(hollow), k.raw));
  EXPECT_TRUE(disagreement(k.own(hollow), k.planner(bulging), k.raw));
}

TEST(Meaning, APatternsMemberThatIsMissingOrTooManyIsFound) {
  Bench k;
  model::RectangularPattern p;
  p.feature_placement = k.at(60, 40, 0);
  p.replicate_base_feature = k.hole(5, 5, 6, 12);
  p.spacing = k.length(20);
  p.its_direction = k.direction(1, 0, 0);
  p.number_of_columns = 3;
  p.number_of_rows = 2;
  p.row_spacing = k.length(15);
  p.row_layout_direction = k.direction(0, 1, 0);
  model::RectangularOmit omit;
  omit.row_index = 2;
  omit.column_index = 2;
  p.missing_base_feature.push_back(k.m.add(omit));
  const auto f = k.m.add(p);
  ASSERT_EQ(k.agree(f), "");
  auto shapes = k.planner(f);
  ASSERT_EQ(shapes.size(), 5u);
  auto fewer = shapes;
  fewer.pop_back();  // row 2, column 3: (60 + 5 + 40, 40 + 5 + 15)
  const auto d = disagreement(k.own(f), fewer, k.raw);
  ASSERT_TRUE(d);
  EXPECT_TRUE(d->removed);
  EXPECT_LT(std::hypot(d->at.x - 105, d->at.y - 60), 3.1) << Bench::to_text(*d);
  auto more = shapes;
  more.push_back(shapes[0]);
  more.back().frame.origin = {85, 60, 0};  // the one that is left out
  const auto e = disagreement(k.own(f), more, k.raw);
  ASSERT_TRUE(e);
  EXPECT_FALSE(e->removed);
  EXPECT_LT(std::hypot(e->at.x - 85, e->at.y - 60), 3.1) << Bench::to_text(*e);
}

TEST(Meaning, ADepthFromTheWrongSideIsFound) {
  Bench k;
  const auto p = k.pocket(100, 75, 40, 30, 12);
  ASSERT_EQ(k.agree(p), "");
  auto shapes = k.planner(p);
  shapes[0].depth_mm = 50 - 12;  // from the underside
  EXPECT_TRUE(disagreement(k.own(p), shapes, k.raw));
  shapes = k.planner(p);
  shapes[0].frame.origin.z = 12;  // upwards
  EXPECT_TRUE(disagreement(k.own(p), shapes, k.raw));
  shapes = k.planner(p);
  shapes[0].through = true;
  const auto d = disagreement(k.own(p), shapes, k.raw);
  ASSERT_TRUE(d);
  EXPECT_LT(d->at.z, -12.0);
}

TEST(Meaning, ATaperInvertedIsFound) {
  Bench k;
  const auto h = k.hole(60, 60, 20, 10);
  model::AngleTaper t;
  t.angle = 30 * kDeg;
  k.m.at<model::RoundHole>(h).change_in_diameter = k.m.add(t);
  ASSERT_EQ(k.agree(h), "");
  auto shapes = k.planner(h);
  // It narrows to 20 - 2 x 10 tan 30 = 8.45; inverted it would widen to 31.5.
  ASSERT_NEAR(shapes[0].bottom_diameter_mm, 20 - 20 * std::tan(30 * kDeg), 1e-9);
  shapes[0].bottom_diameter_mm = 20 + 20 * std::tan(30 * kDeg);
  EXPECT_TRUE(disagreement(k.own(h), shapes, k.raw));
}

TEST(Meaning, WhatDiffersByLessThanTheTwoMayIsNoFault) {
  Bench k;
  const auto h = k.hole(60, 60, 20, 10);
  auto shapes = k.planner(h);
  shapes[0].diameter.nominal_mm += 0.01;
  shapes[0].bottom_diameter_mm += 0.01;
  EXPECT_FALSE(disagreement(k.own(h), shapes, k.raw));
  shapes[0].bottom_diameter_mm = shapes[0].diameter.nominal_mm = 20.1;  // 0.05 beside the wall
  EXPECT_TRUE(disagreement(k.own(h), shapes, k.raw));
}

TEST(Meaning, ABossThatIsForgottenAndAPocketTurnedAreFound) {
  Bench k;
  const auto p = k.pocket(100, 75, 60, 30, 12);
  k.m.at<model::ClosedPocket>(p).its_boss.push_back(k.boss(95, 75, 10, 10, 12));
  ASSERT_EQ(k.agree(p), "");
  auto shapes = k.planner(p);
  ASSERT_EQ(shapes[0].islands.size(), 1u);
  auto bare = shapes;
  bare[0].islands.clear();
  const auto d = disagreement(k.own(p), bare, k.raw);
  ASSERT_TRUE(d);
  EXPECT_FALSE(d->removed);
  EXPECT_LE(std::abs(d->at.x - 95), 5.0);
  auto turned = shapes;
  std::swap(turned[0].frame.x, turned[0].frame.y);
  turned[0].frame.y = -1.0 * turned[0].frame.y;
  EXPECT_TRUE(disagreement(k.own(p), turned, k.raw));
}

TEST(Meaning, AStepAndAnOutsideOnTheWrongSideAreFound) {
  Bench k;
  model::LinearPath path;
  path.distance = k.length(150);
  path.its_direction = k.direction(0, 1, 0);
  model::Step s;
  s.feature_placement = k.at(180, 0, 0);
  s.depth = k.depth(-8);
  s.open_boundary = k.m.add(path);
  const auto step = k.m.add(s);
  ASSERT_EQ(k.agree(step), "");
  auto shapes = k.planner(step);
  for (auto& loop : shapes[0].area.loops) {
    for (Vec2& p : loop) p.x = -p.x;
    std::reverse(loop.begin(), loop.end());
  }
  EXPECT_TRUE(disagreement(k.own(step), shapes, k.raw));

  model::GeneralOutsideProfile o;
  o.feature_placement = k.at(100, 75, 0);
  o.depth = k.depth(-8);
  o.feature_boundary = k.rectangle(120, 90);
  const auto outside = k.m.add(o);
  ASSERT_EQ(k.agree(outside), "");
  shapes = k.planner(outside);
  shapes[0].area = shapes[0].islands[0].area;
  shapes[0].islands.clear();
  EXPECT_TRUE(disagreement(k.own(outside), shapes, k.raw));
}

TEST(Meaning, ASlotsEndsAndSectionAreCompared) {
  Bench k;
  const auto slot = [&](AnyRef profile, double deep) {
    model::LinearPath path;
    path.distance = k.length(60);
    path.its_direction = k.direction(1, 0, 0);
    model::Slot s;
    s.feature_placement = k.at(50, 60, 0);
    s.depth = k.depth(-deep);
    s.course_of_travel = k.m.add(path);
    s.swept_shape = Ref<model::OpenProfile>(profile);
    s.end_conditions.push_back(k.m.add(model::RadiusedSlotEndType{}));
    s.end_conditions.push_back(k.m.add(model::FlatSlotEndType{}));
    return k.m.add(s);
  };
  model::SquareUProfile q;
  q.width = k.length(16);
  model::VeeProfile v;
  v.profile_angle = 90 * kDeg;
  v.profile_radius = k.length(3);
  model::RoundedUProfile u;
  u.width = k.length(16);
  model::SquareUProfile dovetail;
  dovetail.width = k.length(22);
  dovetail.first_angle = dovetail.second_angle = 60 * kDeg;
  model::TeeProfile t;
  t.cross_bar_width = k.length(22);
  t.cross_bar_depth = k.length(4);
  t.width = k.length(12);
  const auto square = slot(k.m.add(q), 10), vee = slot(k.m.add(v), 10), round = slot(k.m.add(u), 12);
  const auto dove = slot(k.m.add(dovetail), 8), tee = slot(k.m.add(t), 10);
  for (const auto f : {square, vee, round, dove, tee}) EXPECT_EQ(k.agree(f), "") << k.planner(f)[0].name;
  for (const auto f : {vee, round, dove, tee}) {
    auto shapes = k.planner(f);
    shapes[0].slot_profile.clear();  // square, and as wide as its mouth
    EXPECT_TRUE(disagreement(k.own(f), shapes, k.raw));
  }
  auto shapes = k.planner(square);
  shapes[0].area = geometry::stroke(shapes[0].spine, 8, false);  // both ends flat
  EXPECT_TRUE(disagreement(k.own(square), shapes, k.raw));
}

}  // namespace
}  // namespace capstan::verify::volumes
