#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/proof/verify/checked.h"

// Rapids on pieces so large that the check's cells, a million at most, are coarse for a drill of 8 mm: 7.6 mm
// wide on 7.6 m, 10 mm on 10 m.

namespace capstan::verify {
namespace {

using model::MoveRole;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using testing::of;
using testing::PlanMaker;

constexpr const char* kUndecided = "CHK-RAPID-UNDECIDED";

PlanMaker plan_on(double side_mm) {
  PlanMaker k = testing::good_plan();
  k.plan.stock.box.add({side_mm, side_mm, 0});
  return k;
}

/// A drill that goes to z by rapid, and from there by feed.
model::CutterPath rapid_to(double x, double y, double z) {
  model::CutterPath p;
  p.start({x, y, 10});
  p.rapid({x, y, z});
  p.line({x, y, -20}, MoveRole::kDrill);
  p.rapid({x, y, 10}, MoveRole::kRetract);
  return p;
}

TEST(RapidsOnALargePiece, WhereTheDrillHasBeenAreFree) {
  for (const double side_mm : {7600.0, 10000.0}) {
    PlanMaker k = plan_on(side_mm);
    model::CutterPath p;
    p.start({80, 80, 10});
    p.rapid({80, 80, 2});
    p.line({80, 80, -10}, MoveRole::kDrill);
    p.rapid({80, 80, 2}, MoveRole::kRetract);
    p.rapid({80, 80, -9.5});
    p.line({80, 80, -20}, MoveRole::kDrill);
    p.rapid({80, 80, 10}, MoveRole::kRetract);
    k.step<model::Drilling>("pecks", k.hole("Q", 80, 80, 8, 18), "d8", p, 225, 1500);
    EXPECT_THAT(of(k, "CHK-RAPID-DOWN"), IsEmpty()) << side_mm;
    EXPECT_THAT(of(k, "CHK-RAPID"), IsEmpty()) << side_mm;
    EXPECT_THAT(of(k, kUndecided), IsEmpty()) << side_mm;
  }
}

// (76, 76) is a corner of four cells: no centre is nearer than 5.37 mm, and the drill's radius is 4.
TEST(RapidsOnALargePiece, IntoSolidBetweenTheCentresOfCellsAreFoundByACloserLook) {
  PlanMaker k = plan_on(7600);
  k.step<model::Drilling>("into", k.hole("Q", 76, 76, 8, 18), "d8", rapid_to(76, 76, -5), 225, 1500);
  const auto found = of(k, "CHK-RAPID-DOWN");
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].step, "into");
  EXPECT_EQ(found[0].severity, Severity::kError);
  EXPECT_THAT(of(k, kUndecided), IsEmpty());
}

// The pocket is 10 mm deep about (50, 50).
TEST(RapidsOnALargePiece, IntoWhatWasCutBeforeAreFree) {
  PlanMaker k = plan_on(7600);
  k.step<model::Drilling>("below", k.hole("Q", 50, 50, 8, 18), "d8", rapid_to(50, 50, -8), 225, 1500);
  EXPECT_THAT(of(k, "CHK-RAPID-DOWN"), IsEmpty());
  EXPECT_THAT(of(k, kUndecided), IsEmpty());
}

// On 10 m even points eight times as close as the cells are 1.25 mm apart, more than an eighth of the drill.
TEST(RapidsOnALargePiece, ThatNoLookTellsAreNotCalledFree) {
  PlanMaker k = plan_on(10000);
  k.step<model::Drilling>("into", k.hole("Q", 80, 80, 8, 18), "d8", rapid_to(80, 80, -5), 225, 1500);
  const auto found = of(k, kUndecided);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].step, "into");
  EXPECT_TRUE(found[0].unproved);
  EXPECT_THAT(found[0].message, HasSubstr("cells of 10 mm"));
}

}  // namespace
}  // namespace capstan::verify
