#include "planner/model/features/shape.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "planner/model/features/in_piece.h"
#include "planner/model/nouns/all.h"
#include "tests/model/maker.h"

namespace capstan::model {
namespace {

TEST(Shape, APocketTurnedByItsReferenceDirectionLiesWhereItsFrameSays) {
  Maker k;
  ClosedPocket p;
  p.feature_placement = k.at(70, 70, 0, 0, 1);  // local x along the workpiece's y
  p.depth = k.depth(-30);
  p.bottom_condition = k.m.add(PlanarPocketBottomCondition{});
  p.orthogonal_radius = k.length(10);
  p.feature_boundary = k.rectangle(80, 50);
  const FeatureShape s = k.only(k.m.add(p));
  EXPECT_EQ(s.depth_mm, 30.0);
  const auto box = geometry::bounds(s.area);
  EXPECT_NEAR(box.hi.x, 40.0, 1e-6);
  EXPECT_NEAR(box.hi.y, 25.0, 1e-6);
  // Four corners of radius 10 are missing from the rectangle: (4 - pi) r^2.
  EXPECT_NEAR(geometry::area(s.area), 80 * 50 - (4 - std::numbers::pi) * 100, 0.05);
  EXPECT_EQ(s.frame.to_parent({40, 0, 0}), (geometry::Vec3{70, 110, 0}));
  EXPECT_EQ(floor_at(s, {0, 0}), -30.0);
  EXPECT_FALSE(floor_at(s, {41, 0}));
}

TEST(Shape, AVeeSlotIsAsWideAsItsAngleAndTipRadiusMakeIt) {
  Maker k;
  VeeProfile v;
  v.profile_radius = k.length(3);
  v.profile_angle = std::numbers::pi / 2;
  LinearPath path;
  path.distance = k.length(120);
  path.its_direction = k.direction(1, 0, 0);
  Slot slot;
  slot.feature_placement = k.at(0, 55, 50);
  slot.depth = k.depth(-13);
  slot.course_of_travel = k.m.add(path);
  slot.swept_shape = k.m.add(v);
  slot.end_conditions.push_back(k.m.add(OpenSlotEndType{}));
  slot.end_conditions.push_back(k.m.add(OpenSlotEndType{}));
  const FeatureShape s = k.only(k.m.add(slot));
  // The flank's virtual apex lies r (1/sin(45 deg) - 1) below the tip; at 45 degrees half width = height
  // above it.
  const double half = 13 + 3 * (std::numbers::sqrt2 - 1);
  EXPECT_NEAR(s.width.nominal_mm, 2 * half, 1e-9);
  EXPECT_NEAR(*floor_at(s, {60, 0}), -13.0, 1e-9);
  EXPECT_NEAR(*floor_at(s, {60, half - 1}), -1.0, 1e-6);
  EXPECT_TRUE(s.open);
  EXPECT_GT(geometry::area(s.reach), geometry::area(s.area) + 2 * 90 * 2 * half);
}

/// A slot 60 mm along y with a section drawn as a polyline of (across, height).
Result<std::vector<FeatureShape>> drawn_slot(Maker& k, const std::vector<geometry::Vec2>& section,
                                             double deep) {
  Polyline line;
  for (const auto p : section) line.points.push_back(k.point(p.x, p.y, 0.0));
  GeneralProfile g;
  g.its_profile = k.m.add(line);
  LinearPath path;
  path.distance = k.length(60);
  path.its_direction = k.direction(0, 1, 0);
  Slot s;
  s.its_id = "S";
  s.feature_placement = k.at(0, 0, 0);
  s.depth = k.depth(-deep);
  s.course_of_travel = k.m.add(path);
  s.swept_shape = k.m.add(g);
  return shapes_of(k.m, k.m.add(s));
}

TEST(Shape, ADrawnDovetailIsTheSameWhicheverWayItsPolylineRuns) {
  const std::vector<geometry::Vec2> floor_first = {{7, 6}, {13, 0}, {-13, 0}, {-7, 6}};
  std::vector<geometry::Vec2> from_the_top,
      finer = {{-7, 0}, {-10, -3}, {-13, -6}, {0, -6}, {13, -6}, {10, -3}, {7, 0}};
  for (const auto p : floor_first) from_the_top.insert(from_the_top.begin(), {p.x, p.y - 6.0});
  for (const auto& section : {floor_first, from_the_top, finer}) {
    Maker k;
    const auto s = drawn_slot(k, section, 6);
    ASSERT_TRUE(s) << (s ? "" : s.error().message);
    EXPECT_EQ(s->front().slot_profile, (std::vector<geometry::Vec2>{{0, 13}, {6, 7}}));
    EXPECT_NEAR(s->front().width.nominal_mm, 14.0, 1e-12);
  }
}

TEST(Shape, DrawnSquaresVeesAndTeesAreKnownForWhatTheyAre) {
  Maker k;
  const auto square = drawn_slot(k, {{-4, 0}, {-4, -5}, {4, -5}, {4, 0}}, 5);
  ASSERT_TRUE(square);
  EXPECT_TRUE(square->front().slot_profile.empty());
  EXPECT_NEAR(square->front().width.nominal_mm, 8.0, 1e-12);
  // Drawn beyond the top by 1 mm, where it is 12 wide: at the slot's top it is 10 wide.
  const auto vee = drawn_slot(k, {{-6, 6}, {0, 0}, {6, 6}}, 5);
  ASSERT_TRUE(vee);
  EXPECT_NEAR(vee->front().slot_angle_rad, std::numbers::pi / 2.0, 1e-9);
  EXPECT_NEAR(vee->front().width.nominal_mm, 10.0, 1e-9);
  const auto tee = drawn_slot(k, {{-3, 9}, {-3, 4}, {-6, 4}, {-6, 0}, {6, 0}, {6, 4}, {3, 4}, {3, 9}}, 9);
  ASSERT_TRUE(tee);
  EXPECT_EQ(tee->front().slot_profile, (std::vector<geometry::Vec2>{{0, 6}, {4, 6}, {4, 3}, {9, 3}}));
}

TEST(Shape, ADrawnSectionThatIsNotUnderstoodIsRefusedWithItsReason) {
  const auto why = [](const std::vector<geometry::Vec2>& section, double deep) {
    Maker k;
    const auto s = drawn_slot(k, section, deep);
    return s ? std::string("read") : s.error().message;
  };
  EXPECT_NE(why({{-7, 6}, {-13, 0}, {10, 0}, {7, 6}}, 6).find("not symmetric"), std::string::npos);
  EXPECT_NE(why({{-7, 6}, {-13, 0}, {13, 0}, {7, 5}}, 6).find("one height"), std::string::npos);
  EXPECT_NE(why({{-7, 6}, {-13, 0}, {13, 0}, {7, 6}}, 8).find("lower than the slot is deep"),
            std::string::npos);
  EXPECT_NE(why({{-9, 6}, {-9, 0}, {-4, 2}, {4, 2}, {9, 0}, {9, 6}}, 6).find("beside"), std::string::npos);
}

TEST(Shape, ASquareProfileWithAnglesBelowARightAngleIsADovetailOnItsBase) {
  Maker k;
  const auto slot_with = [&](double first, double second) {
    SquareUProfile q;
    q.width = k.length(22);
    q.first_angle = first;
    q.second_angle = second;
    LinearPath path;
    path.distance = k.length(60);
    path.its_direction = k.direction(0, 1, 0);
    Slot s;
    s.feature_placement = k.at(0, 0, 0);
    s.depth = k.depth(-5);
    s.course_of_travel = k.m.add(path);
    s.swept_shape = k.m.add(q);
    return shapes_of(k.m, k.m.add(s));
  };
  const double deg = std::numbers::pi / 180.0;
  const auto s = slot_with(60 * deg, 60 * deg);
  ASSERT_TRUE(s) << s.error().message;
  EXPECT_NEAR(s->front().width.nominal_mm, 22.0 - 10.0 * std::tan(30 * deg), 1e-9);
  ASSERT_EQ(s->front().slot_profile.size(), 2U);
  EXPECT_NEAR(s->front().slot_profile.front().y, 11.0, 1e-12);
  for (const double upright : {0.0, 90 * deg})
    EXPECT_TRUE(slot_with(upright, 90 * deg)->front().slot_profile.empty());
  EXPECT_FALSE(slot_with(60 * deg, 90 * deg));
}

TEST(Shape, AConicalBottomGoesOnBelowTheDepthOfTheFullDiameter) {
  Maker k;
  const auto ref = k.hole(50, 50, 10, 10);
  ConicalHoleBottom c;
  c.tip_angle = 140 * std::numbers::pi / 180;
  k.m.get<RoundHole>(ref)->bottom_condition = k.m.add(c);
  const FeatureShape s = k.only(ref);
  EXPECT_NEAR(*floor_at(s, {0, 0}), -10 - 5 * std::tan(20 * std::numbers::pi / 180), 1e-9);
  EXPECT_NEAR(*floor_at(s, {5, 0}), -10.0, 1e-9);
}

TEST(Shape, ACircularPatternTurnsItsBaseAboutItsOwnPlacement) {
  Maker k;
  CircularPattern p;
  p.feature_placement = k.at(10, 10, 0);
  p.replicate_base_feature = k.hole(20, 0, 6, 12);
  p.angle_increment = std::numbers::pi / 2;
  p.number_of_feature = 4;
  CircularOmit omit;
  omit.index = 3;
  p.missing_base_feature.push_back(k.m.add(omit));
  const auto s = shapes_of(k.m, k.m.add(p));
  ASSERT_TRUE(s);
  ASSERT_EQ(s->size(), 3U);
  EXPECT_LT(norm((*s)[0].frame.origin - geometry::Vec3{30, 10, 0}), 1e-12);
  EXPECT_LT(norm((*s)[1].frame.origin - geometry::Vec3{10, 30, 0}), 1e-12);
  EXPECT_LT(norm((*s)[2].frame.origin - geometry::Vec3{10, -10, 0}), 1e-12);
}

TEST(Shape, ARectangularPatternCountsRowsAndColumnsFromItsBase) {
  Maker k;
  RectangularPattern p;
  p.feature_placement = k.at(0, 0, 0);
  p.replicate_base_feature = k.hole(5, 5, 6, 12);
  p.spacing = k.length(20);
  p.its_direction = k.direction(1, 0, 0);
  p.number_of_columns = 3;
  p.number_of_rows = 2;
  p.row_spacing = k.length(15);
  p.row_layout_direction = k.direction(0, 1, 0);
  const auto s = shapes_of(k.m, k.m.add(p));
  ASSERT_TRUE(s);
  ASSERT_EQ(s->size(), 6U);
  EXPECT_LT(norm(s->back().frame.origin - geometry::Vec3{45, 20, 0}), 1e-12);
}

TEST(Shape, APolygonThatDoesNotSayWhatItsDiameterIsOfIsAssumedAcrossCorners) {
  for (const bool says : {false, true}) {
    Maker k;
    NgonClosedProfile n;
    n.diameter = k.length(20);
    n.number_of_sides = 6;
    if (says) n.circumscribed = false;
    ClosedPocket p;
    p.feature_placement = k.at(0, 0, 0);
    p.depth = k.depth(-3);
    p.bottom_condition = k.m.add(PlanarPocketBottomCondition{});
    p.feature_boundary = k.m.add(n);
    const FeatureShape s = k.only(k.m.add(p));
    const bool told = std::any_of(s.assumptions.begin(), s.assumptions.end(), [](const std::string& a) {
      return a.find("20 mm is across flats or across corners") != std::string::npos;
    });
    EXPECT_EQ(told, !says);
    EXPECT_NEAR(geometry::area(s.area), 6.0 * 0.5 * 100.0 * std::sin(std::numbers::pi / 3.0), 1e-3);
  }
}

TEST(Shape, AnEdgeOfNoSizeIsRefusedAndSaysWhatAndWhy) {
  Maker k;
  Chamfer c;
  c.its_id = "C";
  c.first_feature = k.pocket(0, 0, 20, 10, 5);
  c.first_offset_amount = k.length(0.0);
  const auto chamfer = shapes_of(k.m, k.m.add(c));
  ASSERT_FALSE(chamfer);
  EXPECT_EQ(chamfer.error().code, "SHP-UNSUPPORTED");
  EXPECT_NE(chamfer.error().message.find("'C'"), std::string::npos) << chamfer.error().message;
  EXPECT_NE(chamfer.error().message.find("first_offset_amount is 0 mm"), std::string::npos)
      << chamfer.error().message;
  EdgeRound e;
  e.its_id = "E";
  e.first_feature = c.first_feature;
  e.radius = k.length(0.0);
  const auto round = shapes_of(k.m, k.m.add(e));
  ASSERT_FALSE(round);
  EXPECT_EQ(round.error().code, "SHP-UNSUPPORTED");
  EXPECT_NE(round.error().message.find("radius is 0 mm"), std::string::npos) << round.error().message;
}

TEST(Shape, AFeatureThatIsKeptVerbatimIsNamedByItsOwnKeyword) {
  Maker k;
  KeptInstance kept;
  kept.keyword = "ROUND_HOLEX";
  const auto shapes = shapes_of(k.m, Ref<ManufacturingFeature>(AnyRef(k.m.add(kept))));
  ASSERT_FALSE(shapes);
  EXPECT_EQ(shapes.error().message, "ROUND_HOLEX: this kind of feature is not understood");
}

TEST(Shape, AThreadInAHoleThatSaysItIsAnOuterOneIsRefused) {
  Maker k;
  RoundHole hole;
  hole.feature_placement = k.at(0, 0, 0);
  hole.depth = k.depth(-10);
  hole.diameter = k.length(5);
  hole.bottom_condition = k.m.add(FlatHoleBottom{});
  DefinedThread t;
  t.its_id = "M6";
  t.applied_shape.push_back(k.m.add(hole));
  t.major_diameter = 6.0;
  NumericParameter pitch;
  pitch.its_parameter_value = 1.0;
  t.number_of_threads = k.m.add(pitch);
  for (const Boolean inner : {Boolean{}, Boolean{true}, Boolean{false}}) {
    t.inner_or_outer_thread = inner;
    const auto s = shapes_of(k.m, k.m.add(t));
    EXPECT_EQ(s.has_value(), inner != false) << (s ? "" : s.error().message);
    if (s) continue;
    EXPECT_NE(s.error().message.find("'M6'"), std::string::npos) << s.error().message;
    EXPECT_NE(s.error().message.find("inner_or_outer_thread"), std::string::npos) << s.error().message;
  }
}

/// An open pocket by its walls and its mouth, both as polylines.
FeatureShape open_pocket(Maker& k, const std::vector<geometry::Vec2>& walls,
                         const std::vector<geometry::Vec2>& mouth) {
  const auto line = [&](const std::vector<geometry::Vec2>& points) {
    Polyline drawn;
    for (const auto p : points) drawn.points.push_back(k.point(p.x, p.y, 0.0));
    GeneralProfile profile;
    profile.its_profile = k.m.add(drawn);
    return k.m.add(profile);
  };
  OpenPocket p;
  p.its_id = "P";
  p.feature_placement = k.at(0, 0, 0);
  p.depth = k.depth(-3);
  p.bottom_condition = k.m.add(PlanarPocketBottomCondition{});
  p.open_boundary = line(walls);
  p.wall_boundary = line(mouth);
  return k.only(k.m.add(p));
}

TEST(Shape, TheReachOfAMouthThatGoesRoundACornerGoesRoundItToo) {
  constexpr double kOut = 100.0;  // kOpenReach of shape/open_reach.h
  Maker k;
  // At a corner of the piece: walls above and on the left, open below and on the right.
  const FeatureShape s = open_pocket(k, {{40, 30}, {0, 30}, {0, 0}}, {{0, 0}, {40, 0}, {40, 30}});
  EXPECT_NEAR(geometry::area(s.area), 40 * 30, 1e-6);
  EXPECT_NEAR(geometry::area(s.reach), (40 + kOut) * (30 + kOut), 1e-3);
  EXPECT_TRUE(geometry::contains(s.reach, {40 + 0.5 * kOut, -0.5 * kOut}));
  // Drawn the other way round it is the same.
  const FeatureShape turned = open_pocket(k, {{0, 0}, {0, 30}, {40, 30}}, {{40, 30}, {40, 0}, {0, 0}});
  EXPECT_NEAR(geometry::area(geometry::subtract(turned.reach, s.reach)), 0.0, 1e-3);
  EXPECT_NEAR(geometry::area(geometry::subtract(s.reach, turned.reach)), 0.0, 1e-3);
}

TEST(Shape, TheReachOfAMouthRoundThreeSidesGoesRoundAllOfThem) {
  constexpr double kOut = 100.0;
  Maker k;
  const FeatureShape s = open_pocket(k, {{0, 30}, {0, 0}}, {{0, 0}, {40, 0}, {40, 30}, {0, 30}});
  EXPECT_NEAR(geometry::area(s.reach), (40 + kOut) * (30 + 2 * kOut), 1e-3);
}

TEST(Shape, TheCornersOfAnOpenPocketMayKeepAShareOfItsNarrowerSideAndOfAClosedOneThreeMillimetres) {
  Maker k;
  const FeatureShape open = open_pocket(k, {{40, 30}, {0, 30}, {0, 0}}, {{0, 0}, {40, 0}, {40, 30}});
  EXPECT_NEAR(unstated_corner_mm(open), 0.35 * 30, 1e-9);
  EXPECT_NEAR(unstated_corner_mm(k.only(k.pocket(0, 0, 40, 30, 5))), 3.0, 1e-9);
}

/// How high a fillet of radius r is so far from its wall.
double fillet(double r, double from_wall) { return r - std::sqrt(r * r - (r - from_wall) * (r - from_wall)); }

TEST(Shape, TheFloorOfAnOpenPocketRisesInFilletsAtItsWallsAndNotAtItsMouth) {
  Maker k;
  FeatureShape s = open_pocket(k, {{40, 30}, {0, 30}, {0, 0}, {40, 0}}, {{40, 0}, {40, 30}});
  EXPECT_EQ(floor_at(s, {20, 0.5}), -3.0);
  s.bottom_radius_mm = 2.0;
  EXPECT_NEAR(*floor_at(s, {20, 0.5}), -3.0 + fillet(2.0, 0.5), 1e-9);
  EXPECT_NEAR(*floor_at(s, {0.5, 15}), -3.0 + fillet(2.0, 0.5), 1e-9);
  EXPECT_EQ(floor_at(s, {39.5, 15}), -3.0);
}

TEST(Shape, TheFloorOfASlotRisesInFilletsAlongBothSides) {
  FeatureShape s;
  s.kind = ShapeKind::kSlot;
  s.depth_mm = 8.0;
  s.width.nominal_mm = 20.0;
  s.bottom_radius_mm = 3.0;
  s.spine = {{0, 0}, {50, 0}};
  s.area = geometry::rectangle({0, -10}, {50, 10});
  EXPECT_EQ(floor_at(s, {25, 6}), -8.0);
  EXPECT_NEAR(*floor_at(s, {25, 9}), -8.0 + fillet(3.0, 1.0), 1e-9);
  EXPECT_NEAR(*floor_at(s, {25, -9}), -8.0 + fillet(3.0, 1.0), 1e-9);
  EXPECT_EQ(floor_at(s, {0.1, 0}), -8.0);
}

TEST(Shape, TheFilletAtTheFootOfABossIsThatOfTheFaceAroundIt) {
  Maker k;
  Boss b;
  b.its_id = "B";
  b.feature_placement = k.at(30, 20, 0);
  b.depth = k.depth(-6);
  b.its_boundary = k.rectangle(10, 10);
  b.fillet_radius = k.length(1.5);
  PlanarFace f;
  f.its_id = "F";
  f.feature_placement = k.at(0, 0, 0);
  f.depth = k.depth(-6);
  f.face_boundary = k.rectangle(200, 200);
  f.its_boss.push_back(k.m.add(b));
  f.its_boss.given = true;
  const FeatureShape s = k.only(k.m.add(f));
  ASSERT_EQ(s.islands.size(), 1U);
  EXPECT_EQ(s.islands.front().foot_radius_mm, 1.5);
  EXPECT_EQ(floor_fillet_mm(s), 1.5);
  EXPECT_NEAR(*floor_at(s, {35.5, 20}), -6.0 + fillet(1.5, 0.5), 1e-9);
  EXPECT_EQ(floor_at(s, {37, 20}), -6.0);
}

TEST(Shape, FilletsOfDifferentRadiiAtOneFloorAreToldApart) {
  Maker k;
  FeatureShape s = k.only(k.pocket(0, 0, 40, 30, 5));
  EXPECT_EQ(floor_fillet_mm(s), 0.0);
  s.bottom_radius_mm = 2.0;
  s.islands.push_back({geometry::disc({0, 0}, 4.0), -1.0, 2.0});
  EXPECT_EQ(floor_fillet_mm(s), 2.0);
  s.islands.front().foot_radius_mm = 0.0;
  EXPECT_FALSE(floor_fillet_mm(s)) << "a sharp foot beside round ones";
  EXPECT_EQ(largest_fillet_mm(s), 2.0);
  EXPECT_EQ(floor_at(s, {4.5, 0}), -5.0);
  // An island that is lower than its fillet ends it.
  s.islands.front() = {geometry::disc({0, 0}, 4.0), -4.5, 2.0};
  EXPECT_EQ(floor_at(s, {4.01, 0}), -4.5);
  s.open = true;
  s.reach = geometry::subtract(s.area, s.islands.front().area);
  EXPECT_EQ(floor_at(s, {4.01, 0}), -4.5) << "the reach has holes for islands, which are no walls";
}

TEST(Shape, AnEdgeIsBrokenBesideItsOutlineOnTheSideOfTheMaterial) {
  Maker k;
  EdgeRound e;
  e.first_feature = k.pocket(0, 0, 40, 30, 5);
  e.radius = k.length(2.0);
  const FeatureShape in = k.only(k.m.add(e));
  EXPECT_FALSE(floor_at(in, {19, 0})) << "within the pocket";
  EXPECT_FALSE(floor_at(in, {22.5, 0}));
  EXPECT_NEAR(*floor_at(in, {20.5, 0}), -2.0 + std::sqrt(4.0 - 1.5 * 1.5), 1e-9);
  Boss b;
  b.its_id = "B";
  b.feature_placement = k.at(0, 0, 0);
  b.depth = k.depth(-6);
  b.its_boundary = k.rectangle(40, 30);
  Chamfer c;
  c.first_feature = k.m.add(b);
  c.angle_to_plane = 0.25 * std::numbers::pi;
  c.first_offset_amount = k.length(1.0);
  const FeatureShape around = k.only(k.m.add(c));
  EXPECT_FALSE(floor_at(around, {20.5, 0})) << "beside the boss";
  EXPECT_NEAR(*floor_at(around, {19.75, 0}), -0.75, 1e-9);
  EXPECT_FALSE(floor_at(around, {18.5, 0}));
}

TEST(Shape, WhatIsMissingIsNamed) {
  Maker k;
  ClosedPocket p;
  p.its_id = "P";
  p.feature_placement = k.at(0, 0, 0);
  p.depth = k.depth(-3);
  const auto s = shapes_of(k.m, k.m.add(p));
  ASSERT_FALSE(s);
  EXPECT_NE(s.error().message.find("CLOSED_POCKET 'P' has no closed profile"), std::string::npos)
      << s.error().message;
}

TEST(Shape, ACompoundOfItselfIsRefused) {
  Maker k;
  const auto ref = k.m.add(CounterboreHole{});
  k.m.get<CounterboreHole>(ref)->elements.items.push_back(ref);
  EXPECT_FALSE(shapes_of(k.m, ref));
}

}  // namespace
}  // namespace capstan::model
