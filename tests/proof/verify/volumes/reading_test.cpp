#include "planner/proof/verify/volumes/reading.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/proof/verify/volumes/bench.h"

// What the check's own reading says of features, with numbers worked out by hand.

namespace capstan::verify::volumes {
namespace {

/// "R" removed, "-" stays, "?" not said, for each place.
std::string said(const Reading& r, const std::vector<Vec3>& places) {
  std::string out = r.unread.empty() ? "" : "unread: " + r.unread;
  for (const Vec3 p : places) {
    const PointState s = r.at(p);
    out += s == PointState::kRemoved ? 'R' : s == PointState::kStays ? '-' : '?';
  }
  return out;
}

TEST(Reading, APocketTurnedByItsReferenceDirectionLiesAlongY) {
  Bench k;
  const auto p = k.pocket(70, 70, 80, 50, 30);
  k.m.at<model::ClosedPocket>(p).feature_placement = k.at(70, 70, 0, 0, 1);
  k.m.at<model::ClosedPocket>(p).orthogonal_radius = k.length(10);
  k.m.at<model::ClosedPocket>(p).planar_radius = k.length(4);
  const Reading r = k.own(p);
  // 80 along y: 30 .. 110; 50 along x: 45 .. 95.
  EXPECT_EQ(said(r, {{70, 109.9, -1}, {70, 110.1, -1}, {94.9, 70, -1}, {95.1, 70, -1}}), "R-R-");
  EXPECT_EQ(said(r, {{70, 70, -29.9}, {70, 70, -30.1}, {70, 70, 0.1}}), "R--");
  // The corner's circle is about (85, 100): 10 / sqrt 2 = 7.07 on the diagonal.
  EXPECT_EQ(said(r, {{92.0, 107.0, -1}, {92.2, 107.2, -1}}), "R-");
  // At 1 above the floor the foot's circle of 4 stands 4 - sqrt(16 - 9) = 1.354 out of the wall.
  EXPECT_EQ(said(r, {{95 - 1.3, 70, -29}, {95 - 1.4, 70, -29}}), "-R");
}

TEST(Reading, AFaceIsItsRemovalBoundarySweptAlongItsCourse) {
  Bench k;
  model::LinearPath course;
  course.distance = k.length(120);
  course.its_direction = k.direction(0, 1, 0);
  model::NumericParameter length;
  length.its_parameter_value = 80;
  model::LinearProfile across;
  across.profile_length = k.m.add(length);
  across.placement = k.at(0, 0, 0, -1, 0);  // along -x
  model::PlanarFace f;
  f.feature_placement = k.at(150, 10, 0);
  f.depth = k.depth(-5);
  f.course_of_travel = k.m.add(course);
  f.removal_boundary = k.m.add(across);
  const auto face = k.m.add(f);
  const Reading r = k.own(face);
  // x 70 .. 150, y 10 .. 130; above it nothing is said.
  EXPECT_EQ(
      said(r, {{71, 11, -1}, {69, 11, -1}, {149, 129, -4.9}, {149, 129, -5.1}, {149, 131, -1}, {100, 50, 3}}),
      "R-R--?");
  EXPECT_EQ(k.agree(face), "");
}

TEST(Reading, AnOpenPocketIsClosedByItsMouthAndHasNoFootThere) {
  Bench k;
  model::GeneralProfile walls;
  // A U of 40 x 30, open to +x.
  walls.its_profile = k.line({{20, 15}, {-20, 15}, {-20, -15}, {20, -15}});
  model::OpenPocket o;
  o.feature_placement = k.at(180, 75, 0);
  o.depth = k.depth(-10);
  o.bottom_condition = k.m.add(model::PlanarPocketBottomCondition{});
  o.open_boundary = k.m.add(walls);
  o.planar_radius = k.length(3);
  const auto p = k.m.add(o);
  const Reading r = k.own(p);
  EXPECT_EQ(said(r, {{199.9, 75, -5}, {160.1, 75, -5}, {159.9, 75, -5}, {200.1, 75, -5}}), "RR--");
  EXPECT_EQ(said(r, {{199.9, 75, -9.9}, {160.1, 75, -9.9}}), "R-");
  EXPECT_EQ(k.agree(p), "");
}

TEST(Reading, AnOpenPocketsInsideCornersHaveItsRadiusAndItsMouthNone) {
  Bench k;
  model::GeneralProfile walls;
  walls.its_profile = k.line({{20, 15}, {-20, 15}, {-20, -15}, {20, -15}});
  model::OpenPocket o;
  o.feature_placement = k.at(180, 75, 0);
  o.depth = k.depth(-10);
  o.bottom_condition = k.m.add(model::PlanarPocketBottomCondition{});
  o.open_boundary = k.m.add(walls);
  o.orthogonal_radius = k.length(4);
  const auto p = k.m.add(o);
  // Of a corner of radius 4, (sqrt 2 - 1) 4 = 1.66 stays along the diagonal: 1.17 along x and y.
  const Reading r = k.own(p);
  EXPECT_EQ(said(r, {{161.1, 61.1, -5}, {161.3, 61.3, -5}, {199.9, 60.1, -5}}), "-RR");
  EXPECT_EQ(k.agree(p), "");
}

TEST(Reading, HolesHaveTheBottomsTheirConditionsSay) {
  Bench k;
  const auto with = [&](AnyRef bottom) {
    const auto h = k.hole(60, 60, 20, 15);
    k.m.at<model::RoundHole>(h).bottom_condition = Ref<model::HoleBottomCondition>(bottom);
    EXPECT_EQ(k.agree(h), "");
    return k.own(h);
  };
  model::ConicalHoleBottom full, flank, half;
  full.tip_angle = 118 * kDeg;  // 10 / tan 59 = 6.009 below the depth
  flank.tip_angle = 30 * kDeg;  // example 2 of ISO 14649-11: a point of 120, 10 / tan 60 = 5.774
  half.tip_angle = 70 * kDeg;   // a point of 140, 10 / tan 70 = 3.640
  EXPECT_EQ(said(with(k.m.add(full)), {{60, 60, -20.9}, {60, 60, -21.1}, {65, 60, -17.9}, {65, 60, -18.1}}),
            "R-R-");
  EXPECT_EQ(said(with(k.m.add(flank)), {{60, 60, -20.7}, {60, 60, -20.8}}), "R-");
  EXPECT_EQ(said(with(k.m.add(half)), {{60, 60, -18.6}, {60, 60, -18.7}}), "R-");
  EXPECT_EQ(
      said(with(k.m.add(model::ThroughBottomCondition{})), {{60, 60, -14}, {60, 60, -40}, {71, 60, -40}}),
      "RR-");
  EXPECT_EQ(said(with(k.m.add(model::FlatHoleBottom{})), {{69.9, 60, -14.9}, {60, 60, -15.1}}), "R-");
  model::FlatWithRadiusHoleBottom radiused;
  radiused.corner_radius = k.length(4);
  // 1 above the floor: 4 - sqrt(16 - 9) = 1.354 from the wall.
  EXPECT_EQ(said(with(k.m.add(radiused)), {{70 - 1.3, 60, -14}, {70 - 1.4, 60, -14}, {65.9, 60, -14.95}}),
            "-RR");
  model::SphericalHoleBottom ball;
  ball.radius = k.length(10);
  // Either the ball's lowest place is at 15, or its middle: between the two nothing is said.
  EXPECT_EQ(said(with(k.m.add(ball)),
                 {{60, 60, -14.9}, {69.9, 60, -4.9}, {69, 60, -14}, {60, 60, -20}, {60, 60, -25.1}}),
            "RR?"
            "?-");
}

TEST(Reading, TapersNarrowByTheirAngleOrToTheirDiameter) {
  Bench k;
  const auto h = k.hole(60, 60, 20, 10);
  model::AngleTaper angle;
  angle.angle = 30 * kDeg;
  k.m.at<model::RoundHole>(h).change_in_diameter = k.m.add(angle);
  // Half way: 10 - 5 tan 30 = 7.113.
  EXPECT_EQ(said(k.own(h), {{67.1, 60, -5}, {67.2, 60, -5}}), "R-");
  model::DiameterTaper end;
  end.final_diameter = k.length(12);
  k.m.at<model::RoundHole>(h).change_in_diameter = k.m.add(end);
  EXPECT_EQ(said(k.own(h), {{67.9, 60, -5}, {68.1, 60, -5}, {65.9, 60, -9.9}, {66.1, 60, -9.99}}), "R-R-");
}

TEST(Reading, ACounterboreOfAPatternStandsWhereEveryMemberIs) {
  Bench k;
  const auto wide = k.hole(0, 0, 12, 4), through = k.hole(0, 0, 8, 20);
  model::CounterboreHole c;
  c.feature_placement = k.at(20, 0, 0);
  c.elements.items = {wide, through};
  const auto bore = k.m.add(c);
  model::CircularPattern p;
  p.feature_placement = k.at(100, 75, 0);
  p.replicate_base_feature = bore;
  p.angle_increment = 90 * kDeg;
  p.number_of_feature = 4;
  model::CircularOmit omit;
  omit.index = 3;
  p.missing_base_feature.push_back(k.m.add(omit));
  const auto f = k.m.add(p);
  const Reading r = k.own(f);
  ASSERT_EQ(r.solids.size(), 6u);
  // At (120, 75), (100, 95) and (100, 55), not at (80, 75): 12 wide to 4, 8 wide to 20.
  EXPECT_EQ(said(r, {{125.9, 75, -3.9},
                     {125.9, 75, -4.1},
                     {123.9, 75, -19.9},
                     {100, 100.9, -1},
                     {100, 49.1, -1},
                     {80, 75, -1}}),
            "R-RRR-");
  EXPECT_EQ(k.agree(f), "");
  EXPECT_EQ(k.agree(bore), "");
  EXPECT_EQ(said(k.own(through), {{120, 75, -19}}), "R");  // alone it stands where its pattern puts it first
}

TEST(Reading, ElementsAreInWorkpieceCoordinatesOnlyWhereTheStandardLeavesThePiece) {
  Bench k;
  const auto far = k.compound(k.at(160, 90, 0), {k.hole(160, 90, 8, 10)});
  EXPECT_EQ(said(k.own(far), {{160, 90, -5}}), "R");
  const auto near = k.compound(k.at(60, 40, 0), {k.hole(60, 40, 8, 10)});
  EXPECT_EQ(said(k.own(near), {{120, 80, -5}, {60, 40, -5}}), "R-");
}

TEST(Reading, AGeneralPatternAndARelocatedMemberStandWhereTheyAreListed) {
  Bench k;
  model::GeneralPattern g;
  g.feature_placement = k.at(30, 20, 0);
  g.replicate_base_feature = k.hole(0, 0, 8, 10);
  g.replicate_locations.push_back(k.at(50, 10, 0));
  const auto f = k.m.add(g);
  EXPECT_EQ(said(k.own(f), {{30, 20, -5}, {80, 30, -5}, {50, 10, -5}}), "RR-");
  EXPECT_EQ(k.agree(f), "");
  model::RectangularPattern p;
  p.feature_placement = k.at(60, 100, 0);
  p.replicate_base_feature = k.hole(0, 0, 6, 12);
  p.spacing = k.length(30);
  p.its_direction = k.direction(1, 0, 0);
  p.number_of_columns = 3;
  model::RectangularOffset moved;
  moved.row_index = 1;
  moved.column_index = 2;
  moved.offset_direction = k.direction(0, 1, 0);
  moved.offset_distance = 7;
  p.relocated_base_feature.push_back(k.m.add(moved));
  const auto q = k.m.add(p);
  EXPECT_EQ(said(k.own(q), {{60, 100, -5}, {90, 107, -5}, {120, 100, -5}, {90, 100, -5}}), "RRR-");
  EXPECT_EQ(k.agree(q), "");
}

TEST(Reading, ABossStandsInEveryFaceAroundItAndEndsAtItsTop) {
  Bench k;
  const auto boss = k.boss(100, 75, 20, 10, 6);
  k.m.at<model::Boss>(boss).feature_placement = k.at(100, 75, -2);
  model::PlanarFace f;
  f.feature_placement = k.at(100, 75, 0);
  f.depth = k.depth(-8);
  f.face_boundary = k.rectangle(180, 140);
  const auto face = k.m.add(f);
  const Reading r = k.own(face);
  EXPECT_EQ(said(r, {{100, 75, -1}, {100, 75, -2.1}, {111, 75, -7}, {109.9, 79.9, -7}}), "R-R-");
  EXPECT_EQ(k.agree(face), "");
  // As a feature it is cut around: 25 mm beside it are said.
  EXPECT_EQ(
      said(k.own(boss), {{110.1, 75, -3}, {109.9, 75, -3}, {134, 75, -3}, {136, 75, -3}, {111, 75, -8.1}}),
      "R-R?-");
}

TEST(Reading, SlotsAreTheirSectionAlongTheirCourse) {
  Bench k;
  const auto slot = [&](AnyRef path, AnyRef profile, double deep, AnyRef end) {
    model::Slot s;
    s.feature_placement = k.at(60, 60, 0);
    s.depth = k.depth(-deep);
    s.course_of_travel = Ref<model::TravelPath>(path);
    s.swept_shape = Ref<model::OpenProfile>(profile);
    for (int i = 0; i < 2; ++i) s.end_conditions.push_back(Ref<model::SlotEndType>(end));
    const auto f = k.m.add(s);
    EXPECT_EQ(k.agree(f), "");
    return k.own(f);
  };
  model::LinearPath along;
  along.distance = k.length(50);
  along.its_direction = k.direction(1, 0, 0);
  const auto line = k.m.add(along);
  const auto rounded = k.m.add(model::RadiusedSlotEndType{});
  const auto flat = k.m.add(model::FlatSlotEndType{});
  const auto open = k.m.add(model::OpenSlotEndType{});
  model::SquareUProfile square;
  square.width = k.length(10);
  const auto u = k.m.add(square);
  // From x = 60 to 110; round ends reach 5 further, and at (4, 4) from the end 5.66 do not.
  EXPECT_EQ(said(slot(line, u, 8, rounded),
                 {{85, 64.9, -7.9}, {85, 65.1, -1}, {114.9, 60, -1}, {114, 64, -1}, {55.1, 60, -1}}),
            "R-R-R");
  EXPECT_EQ(said(slot(line, u, 8, flat), {{109.9, 64.9, -1}, {110.1, 60, -1}}), "R-");
  EXPECT_EQ(said(slot(line, u, 8, open), {{109.9, 64.9, -1}, {112, 60, -1}}), "R?");
  model::RoundedUProfile round;
  round.width = k.length(10);
  // A circle of 5 at the floor: 1 above it sqrt(25 - 16) = 3 to either side.
  EXPECT_EQ(said(slot(line, k.m.add(round), 8, flat), {{85, 62.9, -7}, {85, 63.1, -7}, {85, 64.9, -2}}),
            "R-R");
  model::VeeProfile vee;
  vee.profile_angle = 90 * kDeg;
  vee.profile_radius = k.length(3);
  // The flank leaves the circle at 45 degrees, (2.121, 0.879); at the height of 6: 2.121 + 5.121 = 7.243.
  EXPECT_EQ(said(slot(line, k.m.add(vee), 10, flat), {{85, 67.2, -4}, {85, 67.3, -4}, {85, 60, -9.9}}),
            "R-R");
  model::TeeProfile tee;
  tee.cross_bar_width = k.length(20);
  tee.cross_bar_depth = k.length(4);
  tee.width = k.length(10);
  EXPECT_EQ(said(slot(line, k.m.add(tee), 9, flat), {{85, 69.9, -8}, {85, 69.9, -4.9}, {85, 64.9, -4.9}}),
            "R-R");
  model::SquareUProfile dovetail;
  dovetail.width = k.length(22);
  dovetail.first_angle = dovetail.second_angle = 60 * kDeg;
  // The base is 11 to either side; 4 above it 11 - 4 tan 30 = 8.69.
  EXPECT_EQ(said(slot(line, k.m.add(dovetail), 6, flat), {{85, 70.9, -5.95}, {85, 68.6, -2}, {85, 68.8, -2}}),
            "RR-");
  model::PartialCircularPath bend;
  bend.radius = k.length(30);
  bend.sweep_angle = 90 * kDeg;
  // About (60, 60): at 45 degrees the course is at 60 + 21.213.
  EXPECT_EQ(said(slot(k.m.add(bend), u, 8, flat),
                 {{81.2, 81.2, -1}, {84.6, 84.6, -1}, {84.9, 84.9, -1}, {72, 72, -1}}),
            "RR--");
  model::GeneralPath drawn;
  drawn.swept_path = k.line({{0, 0}, {30, 0}, {30, 30}});
  // In the outer corner of the kink, beside (90, 60), nothing is said.
  EXPECT_EQ(said(slot(k.m.add(drawn), u, 8, flat),
                 {{75, 64.9, -1}, {94.9, 80, -1}, {93, 57, -1}, {95.1, 54.9, -1}}),
            "RR?-");
}

TEST(Reading, AStepLiesOnTheRightOfItsPath) {
  Bench k;
  model::LinearPath path;
  path.distance = k.length(150);
  path.its_direction = k.direction(0, 1, 0);
  model::Step s;
  s.feature_placement = k.at(180, 0, 0);
  s.depth = k.depth(-8);
  s.open_boundary = k.m.add(path);
  const auto step = k.m.add(s);
  EXPECT_EQ(said(k.own(step), {{181, 75, -7.9}, {179, 75, -1}, {199, 1, -1}, {190, 75, -8.1}, {206, 75, -1}}),
            "R-R-?");
}

TEST(Reading, AnOpenOutsideTakesTheSmallerPartOfTheRawPiece) {
  Bench k;
  model::GeneralProfile line;
  line.its_profile = k.line({{0, 0}, {0, 150}});
  model::GeneralOutsideProfile o;
  o.feature_placement = k.at(180, 0, 0);
  o.depth = k.depth(-8);
  o.feature_boundary = k.m.add(line);
  const auto right = k.m.add(o);
  EXPECT_EQ(said(k.own(right), {{181, 75, -1}, {179, 75, -1}}), "R-");
  k.m.at<model::GeneralOutsideProfile>(right).feature_placement = k.at(20, 0, 0);
  EXPECT_EQ(said(k.own(right), {{21, 75, -1}, {19, 75, -1}}), "-R");
  k.m.at<model::GeneralOutsideProfile>(right).feature_placement = k.at(100, 0, 0);
  EXPECT_NE(k.own(right).unread, "");
}

TEST(Reading, EdgesAndThreadsAreOnWhatTheyAreStatedOn) {
  Bench k;
  const auto hole = k.hole(60, 60, 20, 15);
  model::Chamfer c;
  c.first_feature = hole;
  c.angle_to_plane = 45 * kDeg;
  c.first_offset_amount = k.length(2);
  const auto chamfer = k.m.add(c);
  // From radius 12 at the top to 10 at 2 deep.
  EXPECT_EQ(said(k.own(chamfer), {{71.9, 60, -0.05}, {71, 60, -0.9}, {71, 60, -1.1}, {72.1, 60, -0.05}}),
            "RR--");
  EXPECT_EQ(k.agree(chamfer), "");
  model::EdgeRound e;
  e.first_feature = hole;
  e.radius = k.length(2);
  const auto round = k.m.add(e);
  // A circle about 2 beside the wall, 2 deep: in the middle it stands 2 (1 - 1 / sqrt 2) = 0.586 deep and
  // beside.
  EXPECT_EQ(said(k.own(round), {{70.5, 60, -0.5}, {70.65, 60, -0.65}, {71.9, 60, -0.3}}), "R--");
  EXPECT_EQ(k.agree(round), "");
  model::NumericParameter pitch;
  pitch.its_parameter_value = 0.5;
  model::PartialAreaDefinition length;
  length.effective_length = 12;
  model::DefinedThread t;
  t.applied_shape.push_back(hole);
  t.major_diameter = 24;
  t.number_of_threads = k.m.add(pitch);
  t.partial_profile = k.m.add(length);
  const auto thread = k.m.add(t);
  EXPECT_EQ(said(k.own(thread), {{69.9, 60, -14.9}}), "R");
  EXPECT_EQ(k.agree(thread), "");
  auto shapes = k.planner(thread);
  shapes[0].thread_major_mm = 20;
  EXPECT_TRUE(disagreement(k.own(thread), shapes, k.raw));
}

TEST(Reading, CurvesAreEvaluatedInTheirOwnParameter) {
  Bench k;
  // A quarter of the circle of 10, by angles in degrees, seen from below: from (10, 0) to (0, -10).
  model::Circle circle;
  model::Axis2Placement3d below;
  below.location = k.point(0, 0, 0);
  below.axis = k.direction(0, 0, -1);
  below.ref_direction = k.direction(1, 0, 0);
  circle.position = k.m.add(below);
  circle.radius = 10;
  model::TrimmedCurve t;
  t.basis_curve = k.m.add(circle);
  t.trim_1.items.push_back({.ref = {}, .type = "PARAMETER_VALUE", .real = 0.0, .text = {}});
  t.trim_2.items.push_back({.ref = {}, .type = "PARAMETER_VALUE", .real = 90.0, .text = {}});
  t.sense_agreement = true;
  const Course c = edges_of(k.m, k.m.add(t));
  ASSERT_EQ(c.edges.size(), 1u) << c.fault;
  EXPECT_LT(norm(c.edges[0].to - Vec2{0, -10}), 1e-9);
  EXPECT_NEAR(c.edges[0].sweep_rad, -90 * kDeg, 1e-12);
  // A parabola as a Bezier of three points: at t = 1/2 (P0 + 2 P1 + P2) / 4 = (5, 5).
  model::BezierCurve b;
  b.degree = 2;
  for (const Vec2 p : {Vec2{0, 0}, Vec2{5, 10}, Vec2{10, 0}})
    b.control_points_list.push_back(k.point(p.x, p.y, 0));
  const Course s = edges_of(k.m, k.m.add(b));
  ASSERT_EQ(s.fault, "");
  Outline o;
  for (const Edge& e : s.edges) o.add(e);
  EXPECT_LT(nearest(o, {5, 5}).distance_mm, 1e-3);
  // At t = 1/4: x = 2.5, y = 2 (1/4)(3/4) 10 = 3.75.
  EXPECT_LT(nearest(o, {2.5, 3.75}).distance_mm, 1e-3);
}

TEST(Reading, WhatIsNotReadIsSaid) {
  Bench k;
  const auto p = k.pocket(100, 75, 40, 30, 12);
  k.m.at<model::ClosedPocket>(p).bottom_condition = k.m.add(model::RadiusedPocketBottomCondition{});
  EXPECT_EQ(k.own(p).unread, "its bottom is not planar");
  EXPECT_NE(k.own(k.m.add(model::SphericalCap{})).unread, "");
  EXPECT_TRUE(k.own(k.m.add(model::ToolpathFeature{})).nothing);
  const auto c = k.m.add(model::CounterboreHole{});
  k.m.at<model::CounterboreHole>(c).elements.items.push_back(c);
  EXPECT_NE(k.own(c).unread.find("nested in itself"), std::string::npos);
}

}  // namespace
}  // namespace capstan::verify::volumes
