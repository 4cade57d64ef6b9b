#include <gtest/gtest.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "tests/removal/sheet.h"

// Features that no machinist would cut as they are drawn: not planned, with the reason, and no program for
// them.

namespace capstan::testing::removal {
namespace {

TEST(RefusedParts, AHoleWhoseAxisLiesOutsideTheRawPieceIsNotDrilled) {
  Sheet s;
  s.d.hole("H", s.d.placement({62, 30, 0}), 20, 8, s.d.through_bottom());
  expect_refused(s, "its axis lies 2 mm outside the raw piece");
}

TEST(RefusedParts, AHoleWhoseCircleCutsTheEdgeIsNotDrilled) {
  Sheet s;
  s.d.hole("H", s.d.placement({58, 30, 0}), 8, 8, s.d.conical_bottom(118));
  expect_refused(s, "its circle of 8 mm runs 2 mm out over the edge of the raw piece");
}

TEST(RefusedParts, AnOpenPocketWhoseOpenSideLiesWithinThePieceIsNotCut) {
  Sheet s;
  const auto walls = s.d.polyline({{0, -10, 0}, {20, -10, 0}, {20, 10, 0}, {0, 10, 0}});
  s.d.open_pocket("A", s.d.placement({20, 30, 0}), 8, s.d.open(walls), 4);
  expect_refused(s, "its open side ends at (20, 20, 0) within the piece");
}

TEST(RefusedParts, AHoleThatTouchesTheEdgeFromWithinIsDrilled) {
  Sheet s;
  s.d.hole("H", s.d.placement({56, 30, 0}), 8, 8, s.d.conical_bottom(118));
  EXPECT_EQ(s.planned().unplanned, 0U);
}

TEST(RefusedParts, AThreadAtTheEdgeIsNotTapped) {
  Sheet s;
  const auto at = s.d.placement({59, 30, 0});
  const auto core = s.d.hole_of("CORE", at, 17, s.d.length(5, 0.15, 0.05), s.d.conical_bottom(118));
  s.d.thread("M6", at, 12, core, 6, 1);
  expect_unplanned(s.planned(), 2, "its circle of 6 mm runs 2 mm out");
}

TEST(RefusedParts, APocketBelowSolidIsNotDugDownTo) {
  Sheet s;
  s.d.closed_pocket("P", s.d.placement({30, 30, -8}), 6, s.d.rectangle(30, 20), 4);
  expect_refused(s, "up to 8 mm of the piece stand above its top");
}

TEST(RefusedParts, ASlotBelowSolidIsNotDugDownTo) {
  Sheet s;
  s.d.slot("S", s.d.placement({30, 0, -8}), 5, s.d.linear_path(60, {0, 1, 0}), s.d.square_u(8), "open",
           "open");
  expect_refused(s, "up to 8 mm of the piece stand above its top");
}

TEST(RefusedParts, AStepBelowSolidIsNotDugDownTo) {
  Sheet s;
  s.d.step("S", s.d.placement({40, 0, -8}), 6, 60, {0, 1, 0});
  expect_refused(s, "up to 8 mm of the piece stand above its top");
}

// The wall stands at x = 30 and the file's block ends at x = 60; the block that is cut goes on to x = 200.
TEST(RefusedParts, AStepOfAWiderRawPieceThanTheFileStatesIsNotCutInPart) {
  Sheet s;
  s.d.step("S", s.d.placement({30, 0, 0}), 6, 60, {0, 1, 0});
  PlanOptions wider;
  wider.stock = "box:0,0,-20,200,60,0";
  const PlanOutput o = plan_bytes(s.d.text(), "sheet.p21", wider);
  expect_unplanned(o, 1, "the raw piece goes on 170 mm beyond its wall");
  EXPECT_EQ(o.steps, 0U) << told(o);
}

TEST(RefusedParts, AMilledHoleBelowSolidIsNotDugDownTo) {
  Sheet s;
  s.d.hole("H", s.d.placement({30, 30, -8}), 6, 8, s.d.flat_bottom());
  expect_refused(s, "up to 8 mm of the piece stand above its top");
}

TEST(RefusedParts, AWideHoleThroughBelowSolidIsNotDugDownToWithoutANarrowerOneAboveIt) {
  Sheet s;
  s.d.hole("H", s.d.placement({30, 30, -8}), 12, 10, s.d.through_bottom());
  expect_refused(s, "up to 8 mm of the piece stand above its top");
}

TEST(RefusedParts, APocketThatAnotherOpensInPartIsNotDugDownTo) {
  Sheet s;
  s.d.closed_pocket("WIDE", s.d.placement({25, 30, 0}), 6, s.d.rectangle(30, 30), 4);
  s.d.closed_pocket("P", s.d.placement({35, 30, -6}), 6, s.d.rectangle(30, 20), 4);
  const PlanOutput o = s.planned();
  expect_unplanned(o, 1, "up to 6 mm of the piece stand above its top");
  EXPECT_GT(o.steps, 0U) << told(o);
}

TEST(RefusedParts, ASlotWhoseOpenEndLiesInTheBlockIsNotCutRound) {
  Sheet s;
  s.d.slot("S", s.d.placement({30, 15, 0}), 5, s.d.linear_path(60, {0, 1, 0}), s.d.square_u(8), "open",
           "open");
  expect_refused(s, "its open end at (30, 15, 0) is square, solid stands beyond it");
}

TEST(RefusedParts, AFlatEndWhoseCornersDoNotFitTheSlotIsRefused) {
  Sheet s;
  s.d.slot("S", s.d.placement({30, 15, 0}), 5, s.d.linear_path(30, {0, 1, 0}), s.d.square_u(8), "flat 5",
           "flat 2");
  expect_refused(s, "a slot 8 mm wide has room for 4 mm");
}

TEST(RefusedParts, AFlatEndWithTwoUnequalCornersIsRefused) {
  Sheet s;
  s.d.slot("S", s.d.placement({30, 15, 0}), 5, s.d.linear_path(30, {0, 1, 0}), s.d.square_u(16), "flat 7/2",
           "radiused");
  expect_refused(s, "its flat end at (30, 15, 0) states corners of radius 7 and 2 mm");
}

TEST(RefusedParts, AWoodruffEndInThePieceIsRefusedAndOneOutsideItIsNot) {
  Sheet inside;
  inside.d.slot("S", inside.d.placement({30, 15, 0}), 5, inside.d.linear_path(30, {0, 1, 0}),
                inside.d.square_u(8), "woodruff 10", "radiused");
  expect_refused(inside, "its woodruff end at (30, 15, 0) rises to the top along a circle of radius 10 mm");
  // The circle meets the top sqrt(10^2 - 5^2) = 8.66 mm from the course's end.
  Sheet outside;
  outside.d.slot("S", outside.d.placement({30, -9, 0}), 5, outside.d.linear_path(78, {0, 1, 0}),
                 outside.d.square_u(8), "woodruff 10", "woodruff 10");
  EXPECT_EQ(outside.planned().unplanned, 0U) << told(outside.planned());
}

/// A pocket of 20 x 20 mm with an arm to the right: 10 mm long, `mouth` wide where it leaves, `tip` at its
/// end.
void pocket_with_arm(Sheet& s, double mouth, double tip, double corner) {
  const double m = 0.5 * mouth, t = 0.5 * tip;
  const auto outline = s.d.polyline({{-15, -10, 0},
                                     {5, -10, 0},
                                     {5, -m, 0},
                                     {15, -t, 0},
                                     {15, t, 0},
                                     {5, m, 0},
                                     {5, 10, 0},
                                     {-15, 10, 0},
                                     {-15, -10, 0}});
  s.d.closed_pocket("P", s.d.placement({30, 30, 0}), 5, s.d.closed(outline), corner);
}

TEST(RefusedParts, APassageNarrowerThanTwiceTheStatedCornerRadiusIsNotLeftSolid) {
  Sheet straight, tapering;
  pocket_with_arm(straight, 3.2, 3.2, 4);
  expect_refused(straight, "its corner radius of 4 mm does not fit the passage of 3.2 mm");
  pocket_with_arm(tapering, 12, 3, 4);
  expect_refused(tapering, "its corner radius of 4 mm does not fit the passage of");
}

TEST(RefusedParts, APassageAsWideAsTwiceTheStatedCornerRadiusIsCut) {
  for (const double wide : {8.0, 10.0}) {
    Sheet s;
    pocket_with_arm(s, wide, wide, 4);
    const PlanOutput o = s.planned();
    EXPECT_EQ(o.unplanned, 0U) << told(o);
  }
}

TEST(RefusedParts, ASlotThatOpensIntoAPocketIsCut) {
  Sheet s;
  s.d.closed_pocket("P", s.d.placement({30, 45, 0}), 6, s.d.rectangle(30, 20), 4);
  s.d.slot("S", s.d.placement({30, 0, 0}), 5, s.d.linear_path(40, {0, 1, 0}), s.d.square_u(8), "open",
           "open");
  const PlanOutput o = s.planned();
  EXPECT_EQ(o.unplanned, 0U) << told(o);
}

TEST(RefusedParts, MembersOfAPatternAllAtOnePlaceAreRefused) {
  Sheet s;
  const auto h = s.d.hole("H", s.d.placement({10, 0, 0}), 20, 5, s.d.through_bottom());
  s.d.circular_pattern("C", s.d.placement({30, 30, 0}), h, 0, 4, 20);
  expect_refused(s, "all of its 4 members stand at one place");
}

TEST(RefusedParts, PocketsThatTheirPatternTurnsAboutAnUnstatedAxisAreRefusedAndHolesAreNot) {
  Sheet pockets, holes;
  const auto p =
      pockets.d.closed_pocket("P", pockets.d.placement({14, 0, 0}), 5, pockets.d.rectangle(12, 8), 3);
  pockets.d.circular_pattern("C", pockets.d.placement({30, 30, 0}), p, 90, 4, 28, {}, 45);
  expect_refused(pockets, "its base_feature_rotation of 45 degrees turns members that are not round");
  const auto h = holes.d.hole("H", holes.d.placement({14, 0, 0}), 20, 5, holes.d.through_bottom());
  holes.d.circular_pattern("C", holes.d.placement({30, 30, 0}), h, 90, 4, 28, {}, 45);
  EXPECT_EQ(holes.planned().unplanned, 0U);
}

TEST(RefusedParts, ANumberLeftOutThatNoMemberHasIsRefused) {
  Sheet s;
  const auto h = s.d.hole("H", s.d.placement({10, 0, 0}), 20, 5, s.d.through_bottom());
  s.d.circular_pattern("C", s.d.placement({30, 30, 0}), h, 90, 4, 20, {7});
  expect_refused(s, "names member 7, and there are 1 to 4");
}

TEST(RefusedParts, APointThatWouldComeOutBelowIsToldWithItsLength) {
  Sheet s;
  s.d.hole("H", s.d.placement({30, 30, 0}), 19, 10, s.d.conical_bottom(118));
  // 5 / tan 59 = 3.004 mm; 19 + 3.004 - 20.
  expect_refused(
      s,
      "the point of its drill (118 degrees, 3.004 mm long, below a depth of 19 mm) runs through the "
      "underside of the raw piece by 2.004 mm");
}

TEST(RefusedParts, AThroughHoleDeeperThanThePieceIsToldWithWhatItCutsBelow) {
  Sheet s;
  s.d.hole("H", s.d.placement({30, 30, 0}), 43, 10, s.d.through_bottom());
  const std::string said = told(s.planned());
  EXPECT_NE(said.find("goes 23 mm below the underside of the raw piece"), std::string::npos) << said;
  EXPECT_NE(said.find("a depth of 20 mm ends at the underside"), std::string::npos) << said;
}

/// The same with a finished part of 15 mm in the raw piece of 20: 5 mm are cut off below.
PlanOutput planned_thinner(Sheet& s) {
  const auto part =
      s.d.write("BLOCK('PART',#" + std::to_string(s.d.placement({0, 0, -15})) + ",60.,60.,15.)");
  std::string text = s.d.text();
  const std::string from = ",#6,0.1,#5,$,$,());";
  text.replace(text.find(from), from.size(), ",#6,0.1,#5,$,#" + std::to_string(part) + ",());");
  return plan_bytes(text, "sheet.p21");
}

TEST(RefusedParts, AFloorThatIsCutOffWithTheUndersideOfTheRawPieceIsRefused) {
  const std::string why = "its floor, 17 mm deep, lies 2 mm below the underside of the finished part";
  Sheet hole, pocket, slot;
  hole.d.hole("H", hole.d.placement({30, 30, 0}), 17, 8, hole.d.flat_bottom());
  pocket.d.closed_pocket("P", pocket.d.placement({30, 30, 0}), 17, pocket.d.rectangle(40, 40), 6);
  slot.d.slot("S", slot.d.placement({30, 15, 0}), 17, slot.d.linear_path(30, {0, 1, 0}), slot.d.square_u(16),
              "radiused", "radiused");
  for (Sheet* s : {&hole, &pocket, &slot}) {
    const PlanOutput o = planned_thinner(*s);
    expect_unplanned(o, 1, why);
    EXPECT_EQ(o.steps, 0U) << told(o);
  }
  Sheet ends_in_it;
  ends_in_it.d.hole("H", ends_in_it.d.placement({30, 30, 0}), 12, 8, ends_in_it.d.flat_bottom());
  EXPECT_EQ(planned_thinner(ends_in_it).unplanned, 0U);
}

TEST(TwoAtOnePlace, EqualHolesAreMadeOnceAndBothAreNamed) {
  Sheet s;
  s.d.hole("A", s.d.placement({30, 30, 0}), 8, 10, s.d.flat_bottom());
  s.d.hole("B", s.d.placement({30, 30, 0}), 8, 10, s.d.flat_bottom());
  const PlanOutput o = s.planned();
  EXPECT_EQ(o.unplanned, 0U) << told(o);
  EXPECT_NE(told(o).find("warning: features 'A' and 'B' are the same at the same place, (30, 30, 0)"),
            std::string::npos)
      << told(o);
}

TEST(TwoAtOnePlace, AHoleThatACompoundHoldsTooIsMadeOnceAndNotCalledUnplanned) {
  Sheet s;
  const auto core = s.d.hole("CORE", s.d.placement({0, 0, -6}), 14, 6.6, s.d.through_bottom());
  const auto head = s.d.hole("HEAD", s.d.placement({0, 0, 0}), 6, 11, s.d.flat_bottom());
  s.d.compound("CB", s.d.placement({30, 30, 0}), {core, head}, "COUNTERBORE_HOLE");
  s.d.hole("H", s.d.placement({30, 30, -6}), 14, 6.6, s.d.through_bottom());
  const PlanOutput o = s.planned();
  EXPECT_EQ(o.unplanned, 0U) << told(o);
  EXPECT_NE(told(o).find("PIP-TWICE"), std::string::npos) << told(o);
  // Nor is anything said of the steps that are left out for it.
  EXPECT_EQ(told(o).find("PIP-RAPID"), std::string::npos) << told(o);
}

TEST(RefusedParts, AFaceTooNarrowForAnyMillNamesItsWidthAndTheMillItWants) {
  Sheet s;
  s.d.face("SLIT", 30, 0, 1, 60, 0, 5);
  const PlanOutput o = s.planned();
  expect_unplanned(o, 1, "no cutter fits; an end mill");
  EXPECT_NE(told(o).find("the narrowest passage of "), std::string::npos) << told(o);
}

TEST(TwoAtOnePlace, EqualPocketsAreMadeOnceAndBothAreNamed) {
  Sheet s;
  s.d.closed_pocket("A", s.d.placement({30, 30, 0}), 6, s.d.rectangle(30, 20), 4);
  s.d.closed_pocket("B", s.d.placement({30, 30, 0}), 6, s.d.rectangle(30, 20), 4);
  EXPECT_NE(told(s.planned()).find("warning: features 'A' and 'B' are the same"), std::string::npos);
}

TEST(TwoAtOnePlace, AHoleThatLiesWhollyWithinAnotherIsRefused) {
  // On its axis, and 2 mm beside it: 8 - 5 mm would be left between the walls.
  for (const double aside : {0.0, 2.0}) {
    Sheet s;
    s.d.hole("A", s.d.placement({30 + aside, 30, 0}), 5, 10, s.d.flat_bottom());
    s.d.hole("B", s.d.placement({30, 30, 0}), 8, 16, s.d.flat_bottom());
    expect_unplanned(s.planned(), 1, "'A', 10 mm wide and 5 mm deep");
  }
}

TEST(TwoAtOnePlace, HolesOfOneSizeWithTwoTolerancesContradictEachOther) {
  Sheet s;
  s.d.hole("A", s.d.placement({30, 30, 0}), 8, 10, s.d.flat_bottom(), 0, 0.1);
  s.d.hole("B", s.d.placement({30, 30, 0}), 8, 10, s.d.flat_bottom(), 0, 0.3);
  const PlanOutput o = s.planned();
  EXPECT_GE(o.unplanned, 1U) << told(o);
  EXPECT_NE(told(o).find("nothing says which of them is meant"), std::string::npos) << told(o);
}

TEST(TwoAtOnePlace, ANarrowerHoleThatGoesDeeperIsACounterbore) {
  Sheet s;
  s.d.hole("A", s.d.placement({30, 30, 0}), 12, 8, s.d.flat_bottom());
  s.d.hole("B", s.d.placement({30, 30, 0}), 5, 14, s.d.flat_bottom());
  const PlanOutput o = s.planned();
  EXPECT_EQ(o.unplanned, 0U) << told(o);
  EXPECT_EQ(told(o).find("PIP-TWICE"), std::string::npos) << told(o);
}

TEST(RefusedParts, AFaceThatCutsIntoABossFromBesideItIsRefused) {
  // The boss stands up from z = -8 at (10, 30), 12 mm wide: from x = 4 on. The face looks along -x; 6 mm deep
  // it goes to x = 6, 2 mm into the boss; 3 mm deep it ends 1 mm beside it.
  for (const bool into : {true, false}) {
    Sheet s;
    s.d.boss("B", s.d.placement({10, 30, 0}), 8, s.d.circle(12));
    const auto at = s.d.placement({0, 30, -10}, {-1, 0, 0}, {0, 1, 0});
    const auto deep = s.d.depth(into ? 6 : 3);
    const auto area = s.d.rectangle(60, 20);
    s.d.write("PLANAR_FACE('F',#4,(),#" + std::to_string(at) + ",#" + std::to_string(deep) + ",$,$,#" +
              std::to_string(area) + ",())");
    const PlanOutput o = s.planned();
    EXPECT_EQ(told(o).find("cuts into BOSS 'B'") != std::string::npos, into) << told(o);
  }
}

TEST(RoundSlots, OneAsWideAsItsBallIsPlannedForItsFullWidth) {
  Sheet s;
  s.d.slot("S", s.d.placement({10, 30, 0}), 6, s.d.linear_path(40, {1, 0, 0}), s.d.rounded_u(10), "radiused",
           "radiused");
  const PlanOutput o = s.planned();
  EXPECT_EQ(o.unplanned, 0U) << told(o);
  EXPECT_FALSE(o.linuxcnc.empty()) << told(o);
  EXPECT_EQ(told(o).find("CHK-WIDTH-LEFT"), std::string::npos) << told(o);
}

TEST(RefusedParts, AnOutlineThatCrossesItselfIsRefusedAtTheCrossing) {
  Sheet s;
  const auto outline = s.d.polyline({{-10, -10, 0}, {10, 10, 0}, {10, -10, 0}, {-10, 10, 0}, {-10, -10, 0}});
  s.d.closed_pocket("P", s.d.placement({30, 30, 0}), 5, s.d.closed(outline), 0);
  expect_refused(s, "crosses itself at (0, 0)");
}

TEST(RefusedParts, APocketInTheFloorOfOneThatIsNotPlannedIsNeitherAndTheRestIsMade) {
  Sheet s;
  s.d.closed_pocket("WIDE", s.d.placement({25, 30, 0}), 12, s.d.rectangle(40, 40), 4, {},
                    1.37);  // no mill has such a corner
  s.d.closed_pocket("IN FLOOR", s.d.placement({25, 30, -12}), 4, s.d.rectangle(20, 20), 4);
  s.d.hole("APART", s.d.placement({54, 30, 0}), 20, 5, s.d.through_bottom());
  const PlanOutput o = s.planned();
  expect_unplanned(o, 2, "it rests on 'WIDE', which is not planned");
  EXPECT_GT(o.steps, 0U) << told(o);
  EXPECT_TRUE(o.condemned.empty()) << told(o);
  EXPECT_FALSE(o.linuxcnc.empty());
  EXPECT_EQ(o.linuxcnc.find("FLOOR"), std::string::npos);
}

// Drilled from the raw surface, its spot drill would be 10 mm deep in the solid, at the feed of a spot.
TEST(RefusedParts, AHoleInTheFloorOfAFaceThatIsNotPlannedIsNeither) {
  Sheet s{removal::block(60, 60, 20, 10)};
  // Between the bosses 2 mm are left, 10 mm deep: the one mill that is so thin and long would face for 14 h.
  std::vector<Drawing::Id> bosses;
  bosses.push_back(s.d.boss("B1", s.d.placement({17, 30, 10}), 10, s.d.rectangle(22, 30)));
  bosses.push_back(s.d.boss("B2", s.d.placement({41, 30, 10}), 10, s.d.rectangle(22, 30)));
  s.d.face("F", 0, 0, 60, 60, 10, 10, bosses);
  s.d.hole("H", s.d.placement({5, 5, 0}), 20, 6, s.d.through_bottom());
  const PlanOutput o = s.planned();
  expect_unplanned(o, 2, "it rests on 'F', which is not planned");
  EXPECT_EQ(o.steps, 0U) << told(o);
  EXPECT_TRUE(o.linuxcnc.empty());
}

TEST(ThroughHoles, OneThatEndsInThePieceIsCutToItsUndersideUnlessAnotherFeatureOpensBelow) {
  for (const bool bore : {false, true}) {
    Sheet s;
    s.d.hole("H", s.d.placement({30, 30, 0}), 10, 6, s.d.through_bottom());
    // 10 mm wide, along x: over the hole it reaches from z = -12 + sqrt(5^2 - 3^2) = -8 down to -16 at least.
    if (bore)
      s.d.hole("BORE", s.d.placement({0, 30, -12}, {-1, 0, 0}, {0, 0, 1}), 60, 10, s.d.through_bottom());
    const PlanOutput o = s.planned();
    EXPECT_EQ(told(o).find("it is cut down to the underside") == std::string::npos, bore) << told(o);
  }
}

}  // namespace
}  // namespace capstan::testing::removal
