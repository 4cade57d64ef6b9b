#include <gtest/gtest.h>

#include "planner/ground/geometry/region.h"
#include "tests/model/maker.h"

// Outside profiles that are not closed: which side of them is taken away.

namespace capstan::model {
namespace {

using geometry::Vec2;

struct Open : Maker {
  Ref<Workpiece> piece;

  void raw(double x0, double y0, double x, double y) {
    Block block;
    block.position = at(x0, y0, -50);
    block.x = x;
    block.y = y;
    block.z = 50;
    Workpiece w;
    w.its_bounding_geometry = m.add(block);
    piece = m.add(w);
  }
  /// 100 mm along x from (0, y), 50 deep.
  Ref<GeneralOutsideProfile> line(double y) {
    NumericParameter along;
    along.its_parameter_value = 100.0;
    LinearProfile profile;
    profile.profile_length = m.add(along);
    GeneralOutsideProfile p;
    p.its_id = "SIDE";
    p.its_workpiece = piece;
    p.feature_placement = at(0, y, 0);
    p.depth = depth(-50);
    p.feature_boundary = m.add(profile);
    return m.add(p);
  }
};

TEST(OpenOutside, TakesAwayTheSideOnWhichTheRawPieceEndsNearest) {
  for (const bool near_below : {true, false}) {
    Open k;
    k.raw(0, 0, 100, 60);
    const auto s = k.only(k.line(near_below ? 5.0 : 55.0));
    EXPECT_EQ(s.kind, ShapeKind::kOutside);
    EXPECT_EQ(geometry::contains(s.area, {50, -1}), near_below);
    EXPECT_EQ(geometry::contains(s.area, {50, 1}), !near_below);
    // Straight on over its ends, for 100 mm.
    EXPECT_TRUE(geometry::contains(s.area, {-99, near_below ? -1.0 : 1.0}));
    EXPECT_NEAR(geometry::area(s.area), 300.0 * 100.0, 1e-6);
    EXPECT_DOUBLE_EQ(s.depth_mm, 50.0);
    ASSERT_EQ(s.assumptions.size(), 1U);
    EXPECT_NE(s.assumptions.front().find(near_below ? "right" : "left"), std::string::npos);
  }
}

TEST(OpenOutside, LooksAtTheOtherFeaturesWhereNoRawPieceIsStated) {
  for (const double y : {30.0, -30.0}) {
    Open k;
    (void)k.pocket(50, y, 60, 40, 10);
    const auto s = k.only(k.line(0.0));
    EXPECT_EQ(geometry::contains(s.area, {50, -1}), y > 0.0) << "the part lies where its features are";
  }
}

TEST(OpenOutside, IsRefusedWhereNothingTellsItsSide) {
  Open alone;
  EXPECT_EQ(shapes_of(alone.m, alone.line(0.0)).error().code, "SHP-UNSUPPORTED");
  Open middle;
  middle.raw(0, -30, 100, 60);
  const auto s = shapes_of(middle.m, middle.line(0.0));
  ASSERT_FALSE(s);
  EXPECT_NE(s.error().message.find("which of them is taken away is not clear"), std::string::npos);
}

TEST(OpenOutside, FollowsALineWithCorners) {
  // An L round the corner of a block of 100 x 60: its lower side and its right one.
  Open k;
  k.raw(0, 0, 100, 60);
  Polyline line;
  for (const auto& [x, y] : {std::pair(0.0, 4.0), std::pair(95.0, 4.0), std::pair(95.0, 60.0)})
    line.points.push_back(k.point(x, y, 0));
  GeneralProfile profile;
  profile.its_profile = k.m.add(line);
  GeneralOutsideProfile p;
  p.its_workpiece = k.piece;
  p.feature_placement = k.at(0, 0, 0);
  p.depth = k.depth(-20);
  p.feature_boundary = k.m.add(profile);
  const auto s = k.only(k.m.add(p));
  EXPECT_TRUE(geometry::contains(s.area, {50, 2}));
  EXPECT_TRUE(geometry::contains(s.area, {98, 30}));
  EXPECT_TRUE(geometry::contains(s.area, {98, 2}));
  EXPECT_FALSE(geometry::contains(s.area, {50, 30}));
  // Of the block: 100 x 4 below and 5 x 56 beside.
  EXPECT_NEAR(geometry::area(geometry::intersect(s.area, geometry::rectangle({0, 0}, {100, 60}))), 680.0,
              1e-6);
}

Ref<Slot> tee(Maker& k, double depth, double course_z, double bar_depth) {
  LinearPath path;
  path.placement = k.at(0, 0, course_z);
  path.distance = k.length(50);
  path.its_direction = k.direction(1, 0, 0);
  TeeProfile t;
  t.cross_bar_width = k.length(32);
  t.cross_bar_depth = k.length(bar_depth);
  t.width = k.length(20);
  t.first_offset = t.second_offset = k.length(6);
  Slot s;
  s.its_id = "T";
  s.feature_placement = k.at(0, 0, 0);
  s.depth = k.depth(-depth);
  s.course_of_travel = k.m.add(path);
  s.swept_shape = k.m.add(t);
  return k.m.add(s);
}

TEST(TeeSlot, WhoseBarDoesNotFitAboveItsDepthStatesThatOfItsNeck) {
  // The standard's example 2: a bar of 20 mm, depth and course at 10 mm: the floor is 30 mm deep.
  Maker k;
  const auto s = k.only(tee(k, 10, -10, 20));
  EXPECT_DOUBLE_EQ(s.depth_mm, 30.0);
  ASSERT_EQ(s.slot_profile.size(), 4U);
  EXPECT_DOUBLE_EQ(s.slot_profile[1].x, 20.0);
  EXPECT_DOUBLE_EQ(s.slot_profile[3].x, 30.0);
  EXPECT_FALSE(s.assumptions.empty());
  // One that fits is read as it stands.
  EXPECT_DOUBLE_EQ(k.only(tee(k, 30, 0, 20)).depth_mm, 30.0);
  // One that does not, and whose course says nothing, is refused.
  const auto none = shapes_of(k.m, tee(k, 10, 0, 20));
  ASSERT_FALSE(none);
  EXPECT_NE(none.error().message.find("leaves no neck"), std::string::npos);
}

}  // namespace
}  // namespace capstan::model
