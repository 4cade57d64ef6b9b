#include "planner/making/workholding/clear_of_fixtures.h"

#include <gtest/gtest.h>

namespace capstan::workholding {
namespace {

model::Workholding one(double x0, double y0, double x1, double y1, double z0, double z1) {
  model::Workholding h;
  h.id = "test";
  h.clearance_mm = 2.0;
  h.solids = {{"clamp 1", "clamp", {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}}, z0, z1, true}};
  return h;
}

/// Diameter 10, flutes 20, sticks out 40 from a holder of 50.
model::Cutter mill() {
  model::Cutter c;
  c.id = "em10";
  c.cutting_diameter_mm = 10;
  c.shank_diameter_mm = 10;
  c.maximum_depth_of_cut_mm = 20;
  c.stick_out_mm = 40;
  c.holder_diameter_mm = 50;
  return c;
}

TEST(Touch, IsMeasuredToTheCuttersFlank) {
  model::CutterPath p;
  p.start({0, 0, 0});
  p.line({100, 0, 0}, model::MoveRole::kCut);
  // Radius 5 and clearance 2: a clamp at y = 7 is just far enough, at 6.5 it is not.
  EXPECT_FALSE(near_move_of(p, mill(), one(40, 7, 60, 20, -5, 10)));
  const auto t = near_move_of(p, mill(), one(40, 6.5, 60, 20, -5, 10));
  ASSERT_TRUE(t);
  EXPECT_EQ(t->move, 1U);
  EXPECT_NE(t->text.find("the cutter would pass 1.5 mm from 'clamp 1'"), std::string::npos) << t->text;
}

TEST(Touch, CountsTheHolderAboveTheTool) {
  model::CutterPath p;
  p.start({0, 0, 0});
  p.line({100, 0, 0}, model::MoveRole::kCut);
  EXPECT_FALSE(near_move_of(p, mill(), one(40, 20, 60, 30, -5, 38)));  // the holder begins at 40
  const auto t = near_move_of(p, mill(), one(40, 20, 60, 30, -5, 45));
  ASSERT_TRUE(t);
  EXPECT_NE(t->text.find("the holder would enter 'clamp 1' by 5 mm"), std::string::npos) << t->text;
}

TEST(Touch, TakesARapidAsTheBoxBetweenItsEnds) {
  model::CutterPath p;
  p.start({0, 0, 5});
  p.rapid({100, 100, 5}, model::MoveRole::kLink);
  EXPECT_TRUE(near_move_of(p, mill(), one(80, 10, 90, 20, -5, 10)));  // 49 mm from the straight way
  model::CutterPath q;
  q.start({0, 0, 5});
  q.line({100, 100, 5}, model::MoveRole::kLink);
  EXPECT_FALSE(near_move_of(q, mill(), one(80, 10, 90, 20, -5, 10)));
}

TEST(Touch, AHeadIsEverywhereBetweenTheEndsOfAnUprightMove) {
  model::Cutter head = mill();
  head.cutting_diameter_mm = 50;
  head.maximum_depth_of_cut_mm = 10;
  head.shank_diameter_mm = 22;
  head.holder_diameter_mm = 22;
  head.stick_out_mm = 90;
  // At its lowest the head is 3 mm under the bar and the arbor 4 mm beside it.
  const auto bar = one(15, -20, 30, 20, 8, 20);
  for (const bool rapid : {true, false}) {
    model::CutterPath p;
    p.start({0, 0, 80});
    if (rapid)
      p.rapid({0, 0, -5});
    else
      p.line({0, 0, -5}, model::MoveRole::kPlunge);
    const auto t = near_move_of(p, head, bar);
    ASSERT_TRUE(t);
    EXPECT_NE(t->text.find("the cutter would enter 'clamp 1' by 10 mm"), std::string::npos) << t->text;
  }
  model::CutterPath under;
  under.start({0, 0, -5});
  under.line({0, 10, -5}, model::MoveRole::kCut);
  EXPECT_FALSE(near_move_of(under, head, bar));
}

TEST(Touch, TakesASlopeAtTheHeightsItHas) {
  model::CutterPath p;
  p.start({0, 0, 60});
  p.line({100, 0, 10}, model::MoveRole::kRamp);
  EXPECT_FALSE(near_move_of(p, mill(), one(0, -5, 10, 5, -5, 45)));  // 20 mm further the tip is at 50
  EXPECT_TRUE(near_move_of(p, mill(), one(60, -5, 70, 5, -5, 28)));  // it ends there 2.5 mm lower
}

TEST(Touch, TakesWhatIsNotDescribedAsThickAsTheCutter) {
  model::CutterPath p;
  p.start({0, 0, 0});
  p.line({100, 0, 0}, model::MoveRole::kCut);
  model::Cutter c = mill();
  c.shank_diameter_mm = 0;
  EXPECT_TRUE(near_move_of(p, c, one(40, 4, 60, 20, 25, 35)));
  c.stick_out_mm = 0;
  EXPECT_TRUE(near_move_of(p, c, one(40, 4, 60, 20, 25, 35)));
}

TEST(Touch, FollowsArcs) {
  model::CutterPath p;
  p.start({-50, 0, 0});
  p.arc({50, 0, 0}, {0, 0}, true, model::MoveRole::kCut);  // over the top, radius 50
  EXPECT_FALSE(near_move_of(p, mill(), one(-5, 57.1, 5, 70, -5, 10)));
  EXPECT_TRUE(near_move_of(p, mill(), one(-5, 56.9, 5, 70, -5, 10)));
  EXPECT_FALSE(near_move_of(p, mill(), one(-5, -70, 5, -40, -5, 10)));
}

}  // namespace
}  // namespace capstan::workholding
