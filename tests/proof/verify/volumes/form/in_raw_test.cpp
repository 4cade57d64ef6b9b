#include "planner/proof/verify/volumes/form/in_raw.h"

#include <gtest/gtest.h>

#include <random>

#include "planner/model/features/in_piece.h"
#include "tests/proof/verify/volumes/bench.h"

// Forms against the piece that they are cut from. The check finds by itself what a fault in the planner's own
// reading would hide, and on drawn parts it says what was worked out by hand.

namespace capstan::verify::volumes {
namespace {

struct InRaw : ::testing::Test {
  Bench k;
  Piece raw{k.raw, std::nullopt};
  model::PieceForm planners{k.raw, std::nullopt};

  Form form(AnyRef f) {
    auto forms = forms_of(source_of(k.m, k.raw), f, k.own(f));
    EXPECT_EQ(forms.size(), 1U);
    return forms.empty() ? Form{} : forms.front();
  }
  /// A face from the raw piece's top down, over `length` of its 200 mm from x = 0, as wide as it is.
  AnyRef face(double length, double depth) {
    model::LinearPath course;
    course.distance = k.length(150);
    course.its_direction = k.direction(0, 1, 0);
    model::NumericParameter n;
    n.its_parameter_value = length;
    model::LinearProfile across;
    across.profile_length = k.m.add(n);
    across.placement = k.at(0, 0, 0);
    model::PlanarFace f;
    f.feature_placement = k.at(0, 0, 0);
    f.depth = k.depth(-depth);
    f.course_of_travel = k.m.add(course);
    f.removal_boundary = k.m.add(across);
    return k.m.add(f);
  }
  double lid_over(const Form& f, const std::vector<Form>& others) {
    double above = 0.0;
    (void)buried(f, others, raw, above);
    return above;
  }
};

// A planner that took the hole to lie 5 mm farther in would drill it.
TEST_F(InRaw, AHoleOverTheEdgeIsFoundAlthoughThePlannerMisplacesIt) {
  const auto hole = k.hole(2, 75, 8, 10);
  FeatureShape read = k.planner(hole).front();
  EXPECT_FALSE(model::cuts_an_edge(read, planners).empty());
  read.frame.origin.x += 5.0;
  ASSERT_TRUE(model::cuts_an_edge(read, planners).empty()) << "the fault is planted";
  EXPECT_NE(cuts_an_edge(form(hole), raw).find("runs 2 mm out"), std::string::npos);
}

TEST_F(InRaw, AHoleInABarIsMeasuredFromTheBarsAxis) {
  raw.round_mm = 75.0;  // about (100, 75)
  const auto near = k.hole(100, 75 + 68, 8, 10), over = k.hole(100, 75 + 72, 8, 10);
  EXPECT_EQ(cuts_an_edge(form(near), raw), "");
  EXPECT_NE(cuts_an_edge(form(over), raw).find("runs 1 mm out"), std::string::npos);
}

// A planner that forgot the point of 118 degrees, 8 / 2 / tan 59 = 2.403 mm, would let it out of the table
// side.
TEST_F(InRaw, APointBelowTheUndersideIsFoundAlthoughThePlannerForgetsIt) {
  const auto hole = k.hole(100, 75, 8, 48);
  model::ConicalHoleBottom cone;
  cone.tip_angle = 118.0 * kDeg;
  k.m.at<model::RoundHole>(hole).bottom_condition = k.m.add(cone);
  const Form own = form(hole);
  ASSERT_GT(own.tip_mm, 0.0);
  FeatureShape read = k.planner(hole).front();
  EXPECT_FALSE(model::point_runs_through(read, planners, planners).empty());
  read.bottom = model::HoleBottom::kFlat;
  ASSERT_TRUE(model::point_runs_through(read, planners, planners).empty()) << "the fault is planted";
  EXPECT_NE(point_runs_through(own, raw, raw).find("underside of the raw piece by 0.403 mm"),
            std::string::npos);
}

// A planner that read half the depth would see a floor in the finished part.
TEST_F(InRaw, AFloorBelowTheFinishedPartIsFoundAlthoughThePlannerReadsHalfTheDepth) {
  const auto pocket = k.pocket(100, 75, 40, 30, 12);
  const Piece part{{{0, 0, -10}, {200, 150, 0}}, std::nullopt};
  const model::PieceForm planners_part{part.box, std::nullopt};
  FeatureShape read = k.planner(pocket).front();
  EXPECT_FALSE(model::floor_below_part(read, planners, planners_part).empty());
  read.depth_mm *= 0.5;
  ASSERT_TRUE(model::floor_below_part(read, planners, planners_part).empty()) << "the fault is planted";
  EXPECT_NE(floor_below_part(form(pocket), raw, part).find("lies 2 mm below"), std::string::npos);
}

// A planner that took the face over half of the part for one over all of it would cut a pocket under solid.
TEST_F(InRaw, ALidIsFoundAlthoughThePlannersFaceIsTooLong) {
  const auto pocket = k.pocket(100, 75, 40, 30, 10);
  k.m.at<model::ClosedPocket>(pocket).feature_placement = k.at(100, 75, -4);
  const auto half = face(100, 4), whole = face(200, 4);
  const FeatureShape read = k.planner(pocket).front();
  EXPECT_TRUE(model::buried(read, {read, k.planner(half).front()}, planners));
  ASSERT_FALSE(model::buried(read, {read, k.planner(whole).front()}, planners)) << "the fault is planted";
  EXPECT_NEAR(lid_over(form(pocket), {form(pocket), form(half)}), 4.0, kBeyondMm);
  EXPECT_EQ(lid_over(form(pocket), {form(pocket), form(whole)}), 0.0);
}

// Only what lies within the tolerance of a form's top is rounding of a file.
TEST_F(InRaw, AThinLidOnAFormsTopIsFoundFromThatToleranceOn) {
  for (const double lid_mm : {0.01, 0.03, 0.05, 0.1, 0.119, 0.125, 0.5}) {
    const auto hole = k.hole(100, 75, 10, 10);
    k.m.at<model::RoundHole>(hole).feature_placement = k.at(100, 75, -lid_mm);
    const double found = lid_over(form(hole), {form(hole)});
    EXPECT_NEAR(found, lid_mm > 0.02 ? lid_mm : 0.0, 1e-6);
  }
}

// A hole across the part, 6 mm below its top, opens nothing above the pocket but where it runs.
TEST_F(InRaw, WhatAHoleAcrossTakesIsNoLidAndTheRestIs) {
  const auto pocket = k.pocket(100, 75, 4, 4, 10);
  k.m.at<model::ClosedPocket>(pocket).feature_placement = k.at(100, 75, -6);
  const auto across = k.hole(0, 0, 10, 200);
  auto& noun = k.m.at<model::RoundHole>(across);
  model::Axis2Placement3d from_the_left = k.m.at<model::Axis2Placement3d>(k.at(0, 75, -6));
  from_the_left.axis = k.direction(-1, 0, 0);
  from_the_left.ref_direction = k.direction(0, 1, 0);
  noun.feature_placement = k.m.add(from_the_left);
  const Form own = form(pocket);
  const double without = lid_over(own, {own}), with = lid_over(own, {own, form(across)});
  EXPECT_NEAR(without, 6.0, kBeyondMm);
  EXPECT_NEAR(with, 6.0, kBeyondMm) << "up to the top of the piece";
  double above = 0.0;
  const std::string all = buried(own, {own}, raw, above), less = buried(own, {own, form(across)}, raw, above);
  EXPECT_NE(all.find("about 96 mm3"), std::string::npos) << all;  // 4 x 4 x 6
  EXPECT_NE(less, all) << "what the hole takes is not counted";
}

// Pockets and holes at drawn depths below faces of drawn depths and lengths. Worked out by hand: the lid is
// what the face leaves above the form's top, wherever the face does not reach all of the form.
TEST_F(InRaw, PropertyALidIsWhatAFaceLeavesAboveAFormsTop) {
  std::mt19937 draw(20261124U);
  const auto between = [&](double lo, double hi) {
    return lo + (hi - lo) * (static_cast<double>(draw() % 1000U) / 1000.0);
  };
  int buried_ones = 0, open_ones = 0;
  for (int n = 0; n < 60; ++n) {
    const double size = between(6, 30), x = between(30, 170), y = between(30, 120), top = between(1, 9);
    const double depth = n % 3 == 0 ? top : between(1, 9), length = between(20, 200);
    AnyRef made;
    if (n % 2 == 0) {
      const auto p = k.pocket(x, y, size, size, 10);
      k.m.at<model::ClosedPocket>(p).feature_placement = k.at(x, y, -top);
      made = p;
    } else {
      const auto h = k.hole(x, y, size, 10);
      k.m.at<model::RoundHole>(h).feature_placement = k.at(x, y, -top);
      made = h;
    }
    const Form own = form(made), faced = form(face(length, depth));
    // Near the face's end some lines are under it and some are not; the lid's height is the higher one.
    const bool beside = length<x + 0.5 * size - 1.0, under = length> x - 0.5 * size + 1.0;
    if (length > x - 0.5 * size - 1.0 && length < x - 0.5 * size + 1.0) continue;
    if (length > x + 0.5 * size - 1.0 && length < x + 0.5 * size + 1.0) continue;
    const double left = beside ? top : under ? std::max(0.0, top - depth) : top;
    if (left > 0.0 && left < 0.2) continue;  // thin ones are rounding of a file
    EXPECT_NEAR(lid_over(own, {own, faced}), left, 0.05)
        << n << ": " << size << " at " << x << " " << top << "; face " << length << " x " << depth;
    ++(left > 0.0 ? buried_ones : open_ones);
  }
  EXPECT_GT(buried_ones, 20);
  EXPECT_GT(open_ones, 5);
}

}  // namespace
}  // namespace capstan::verify::volumes
