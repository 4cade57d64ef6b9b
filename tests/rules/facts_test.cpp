#include "rules/facts/facts.h"

#include "planner/ground/vocabulary/unit_factors.h"
#include "rules/facts/it_grade.h"

namespace capstan::rules {
namespace {

TEST(StandardTolerance, IsThePublishedTableAtItsCorners) {
  // ISO 286-1:2010, table 1.
  EXPECT_DOUBLE_EQ(standard_tolerance_mm(7, 20.0), 0.021);
  EXPECT_DOUBLE_EQ(standard_tolerance_mm(7, 18.0), 0.018) << "18 belongs to the range up to and including 18";
  EXPECT_DOUBLE_EQ(standard_tolerance_mm(11, 10.0), 0.090);
  EXPECT_DOUBLE_EQ(standard_tolerance_mm(6, 3.0), 0.006);
  EXPECT_DOUBLE_EQ(standard_tolerance_mm(1, 500.0), 0.008);
  EXPECT_DOUBLE_EQ(standard_tolerance_mm(18, 3150.0), 33.0);
  EXPECT_DOUBLE_EQ(standard_tolerance_mm(5, 600.0), 0.032);
  EXPECT_EQ(standard_tolerance_mm(0, 20.0), 0.0) << "rules begin at IT1";
  EXPECT_EQ(standard_tolerance_mm(7, 3151.0), 0.0);
  EXPECT_EQ(standard_tolerance_mm(7, 0.0), 0.0);
}

TEST(StandardTolerance, GrowsWithGradeAndSize) {
  const double sizes[] = {2,   4,   8,   15,  25,  40,   70,   100,  150,  200, 300,
                          350, 450, 600, 700, 900, 1100, 1400, 1800, 2200, 3000};
  for (int grade = 6; grade <= 18; ++grade) {
    double before = 0.0;
    for (const double size : sizes) {
      EXPECT_GE(standard_tolerance_mm(grade, size), before);
      before = standard_tolerance_mm(grade, size);
      if (grade > 6) {
        EXPECT_GT(before, standard_tolerance_mm(grade - 1, size));
      }
    }
  }
}

TEST(GradeOfWidth, IsTheCoarsestThatFits) {
  EXPECT_EQ(grade_of_width(20.0, 0.021), 7);
  EXPECT_EQ(grade_of_width(20.0, 0.0209), 6);
  EXPECT_EQ(grade_of_width(20.0, 0.0329), 7);
  EXPECT_EQ(grade_of_width(20.0, 0.033), 8);
  EXPECT_EQ(grade_of_width(20.0, 0.001), 0);
  EXPECT_EQ(grade_of_width(20.0, 9.0), 18);
  for (int grade = 1; grade <= 18; ++grade)
    EXPECT_EQ(grade_of_width(20.0, standard_tolerance_mm(grade, 20.0)), grade);
}

TEST(StatedTolerance, IsNeverReplacedByTheGeneralOne) {
  const Context context;
  const model::Toleranced none{20.0, 0.0, 0.0, true}, below{20.0, -0.041, -0.020, true};
  EXPECT_EQ(tolerance_or_general(none, context).width(), 0.0);
  EXPECT_EQ(tolerance_or_general(below, context).lower_mm, -0.041);
  EXPECT_EQ(tolerance_or_general(below, context).upper_mm, -0.020);
  EXPECT_GT(tolerance_or_general({20.0, 0.0, 0.0, false}, context).width(), 0.0);
  model::FeatureShape hole;
  hole.kind = model::ShapeKind::kHole;
  hole.depth_mm = 10.0;
  hole.diameter = none;
  EXPECT_EQ(facts_of(hole, context).facts.number("it_grade"), 0.0) << "below IT1: no chain holds it";
}

TEST(Reamers, ComeInHalfMillimetresThenWholeOnes) {
  for (const double d : {1.0, 6.0, 6.5, 20.0, 22.0, 25.0, 32.0, 35.0, 40.0, 50.0})
    EXPECT_TRUE(is_reamer_size(d)) << d;
  for (const double d : {0.9, 6.2, 20.5, 33.0, 51.0}) EXPECT_FALSE(is_reamer_size(d)) << d;
}

// What the estimates promise: 1 % of the widest, on the small side.
void expect_passage(const geometry::Region& area, double widest, double narrowest, double exact) {
  const Passage p = passage_of(area);
  EXPECT_LE(p.widest_mm, widest + 1e-9);
  EXPECT_GE(p.widest_mm, 0.97 * widest);
  EXPECT_LE(p.narrowest_mm, narrowest * 1.001);
  EXPECT_GE(p.narrowest_mm, narrowest - 0.04 * widest);
  EXPECT_LE(p.exact_mm, exact * 1.04);
  EXPECT_GE(p.exact_mm, exact - 0.04 * widest);
}

TEST(Passage, OfASharpRectangleIsItsWidthAndNoCutterReachesItsCorners) {
  expect_passage(geometry::rectangle({0, 0}, {100, 40}), 40, 40, 0);
}
TEST(Passage, OfARoundedRectangleReachesItsCornersUpToTheirRadius) {
  expect_passage(geometry::rounded_rectangle({0, 0}, {100, 40}, 6.0), 40, 40, 12);
}
TEST(Passage, OfADiscIsItsDiameter) { expect_passage(geometry::disc({5, 5}, 15), 30, 30, 30); }
TEST(Passage, BetweenIslandAndWallIsTheGap) {
  const auto area =
      geometry::subtract(geometry::rectangle({0, 0}, {100, 100}), geometry::rectangle({8, 30}, {70, 70}));
  const Passage p = passage_of(area);
  EXPECT_LE(p.narrowest_mm, 8.0 * 1.001);
  EXPECT_GE(p.narrowest_mm, 0.9 * 8.0);
  EXPECT_GE(p.widest_mm, 30.0);
}
TEST(Passage, OfANarrowFingerIsTheFinger) {
  const auto area =
      geometry::unite(geometry::rectangle({0, 0}, {60, 60}), geometry::rectangle({60, 27}, {90, 33}));
  expect_passage(area, 60, 6, 0);
}
TEST(Passage, OfTwoRoomsThroughANeckIsTheNeck) {
  const auto rooms =
      geometry::unite(geometry::rectangle({0, 0}, {40, 40}), geometry::rectangle({60, 0}, {100, 40}));
  expect_passage(geometry::unite(rooms, geometry::rectangle({39, 15}, {61, 25})), 40, 10, 0);
}
/// What a circle of radius r leaves in a point of that angle is the point, however wide the circle is.
TEST(Passage, OfAPointSharperThanSixtyDegreesIsNotItsTip) {
  for (const double deg : {30.0, 45.0, 59.0}) {
    const double half = std::tan(0.5 * deg * kRadPerDegree) * 60.0;
    const geometry::Region point = {{{{0, 0}, {60, -half}, {60, half}}}};
    const Passage p = passage_of(point);
    EXPECT_GE(p.narrowest_mm, 0.95 * p.widest_mm) << deg;
    EXPECT_EQ(p.exact_mm, 0.0) << deg;
  }
}
TEST(Passage, OfAPointSharperThanThirtyDegreesHasNone) {
  const geometry::Region needle = {{{{0, 0}, {60, -6}, {60, 6}}}};
  EXPECT_LT(passage_of(needle).narrowest_mm, 1.0);
}
TEST(Passage, OfAFingerWithAPointedEndIsTheFinger) {
  const geometry::Region point = {{{{89, 27}, {100, 30}, {89, 33}}}};
  const auto area = geometry::unite(
      geometry::unite(geometry::rectangle({0, 0}, {60, 60}), geometry::rectangle({60, 27}, {90, 33})), point);
  const Passage p = passage_of(area);
  EXPECT_LE(p.narrowest_mm, 6.0 * 1.001);
  EXPECT_GE(p.narrowest_mm, 5.0);
}
/// An arm of free room outside of what is to be cut limits no cutter.
TEST(Passage, OfWhatIsAskedForIgnoresNarrowRoomBesideIt) {
  const auto square = geometry::rectangle({0, 0}, {60, 60});
  const auto area = geometry::unite(square, geometry::rectangle({60, 27}, {90, 33}));
  EXPECT_LE(passage_of(area, false).narrowest_mm, 6.0 * 1.001);
  EXPECT_GE(passage_of(area, false, square).narrowest_mm, 0.95 * 60.0);
}
TEST(FactsOfArea, TheCornersOfAnOpenPocketAreThoseBetweenItsWalls) {
  constexpr double kRadius = 6.35;
  model::FeatureShape s;
  s.kind = model::ShapeKind::kPocket;
  s.open = true;
  s.depth_mm = 3.0;
  // At a corner of the piece: one corner between two walls, the mouth round the other three.
  const auto closed = geometry::rounded_rectangle({0, 0}, {200, 200}, kRadius);
  s.area = geometry::intersect(closed, geometry::rectangle({0, 0}, {40, 30}));
  s.reach = geometry::intersect(closed, geometry::rectangle({0, 0}, {140, 130}));
  const auto f = facts_of(s, {}).facts;
  EXPECT_NEAR(*f.number("corner_radius_mm"), kRadius, 0.04 * kRadius);
  EXPECT_GE(*f.number("passage_mm"), 100.0);
}
TEST(Passage, OfNothingIsNothing) { EXPECT_EQ(passage_of({}).widest_mm, 0.0); }

}  // namespace
}  // namespace capstan::rules
