#include <gtest/gtest.h>

#include "tests/removal/made.h"
#include "tests/removal/parts.h"
#include "tests/support/rs274.h"

// Parts planned from a file, their programs run by LinuxCNC's interpreter and simulated, held against targets
// written by hand from the numbers of the drawing.

namespace capstan::testing::removal {
namespace {

CAPSTAN_MADE(RemovalOfParts, FacesAroundAndKeepsTheIslandOfAPocket, island_pocket())
CAPSTAN_MADE(RemovalOfParts, CutsAPocketThatOpensAtASide, open_pocket())
CAPSTAN_MADE(RemovalOfParts, CutsSquareRoundVeeAndClosedSlots, plain_slots())
CAPSTAN_MADE(RemovalOfParts, MakesEveryKindOfHoleBottom, single_holes())
CAPSTAN_MADE(RemovalOfParts, CutsAThreadInItsCore, threaded_hole())
CAPSTAN_MADE(RemovalOfParts, CopiesHolesAlongEveryPattern, hole_patterns())
CAPSTAN_MADE(RemovalOfParts, LeavesWhatAnOutsideContourEncloses, outside_contour())
CAPSTAN_MADE(RemovalOfParts, FollowsAnArcFrom270DegreesToZero, arcs_across_zero(false))
CAPSTAN_MADE(RemovalOfParts, FollowsAContourDrawnClockwise, arcs_across_zero(true))
CAPSTAN_MADE(RemovalOfParts, ChamfersTheEdgesOfAPocketAndAHole, chamfered_edges())
CAPSTAN_MADE(RemovalOfParts, CutsAPieceFromBothSides, turned_over())
CAPSTAN_MADE(RemovalOfParts, CutsAStepShorterThanTheBlock, short_step())
CAPSTAN_MADE(RemovalOfParts, CutsAStepOutToTheFarEdgeOfTheBlock, wide_step())
CAPSTAN_MADE(RemovalOfParts, StopsAFaceAtAWallBesideIt, face_beside_walls(1, 5))
CAPSTAN_MADE(RemovalOfParts, StopsAFaceAtALowWallBesideIt, face_beside_walls(1, 1))
CAPSTAN_MADE(RemovalOfParts, StopsAFaceAtAHighWallBesideIt, face_beside_walls(1, 20))
CAPSTAN_MADE(RemovalOfParts, StopsAFaceAtTwoWalls, face_beside_walls(2, 5))
CAPSTAN_MADE(RemovalOfParts, StopsAFaceBetweenThreeWalls, face_beside_walls(3, 5))
CAPSTAN_MADE(RemovalOfParts, StopsAFaceBetweenThreeHighWalls, face_beside_walls(3, 20))
CAPSTAN_MADE(RemovalOfParts, StopsAFaceThatListsABossAtTheWallBesideIt, face_with_boss_beside_wall())
CAPSTAN_MADE(RemovalOfParts, CutsAFaceAtTheEdgeWhateverNarrowOneLiesBehindTheWall,
             face_at_the_edge_and_narrow_face())
CAPSTAN_MADE(RemovalOfParts, CutsTheShallowerOfTwoFacesThatOverlapFirst, deeper_face_over_a_shallow_one())
CAPSTAN_MADE(RemovalOfParts, CutsAClosedMeshOfABoxOutOfABlock, mesh_box())
CAPSTAN_MADE(RemovalOfParts, CutsAClosedMeshOfAStepOutOfABlock, mesh_step())
CAPSTAN_MADE(RemovalOfParts, CutsAClosedMeshWithAPocketOutOfABlock, mesh_pocket())
CAPSTAN_MADE(RemovalOfParts, BoresHolesOfIT6InTwoCutsEachOfWhichCuts, fine_holes())
CAPSTAN_MADE(RemovalOfParts, PlacesTheHolesOfACompound, compound_holes())
CAPSTAN_MADE(RemovalOfParts, UndercutsTeeSlotsAndDovetails, undercut_slots())
CAPSTAN_MADE(RemovalOfParts, KeepsTheBossBesideAPocket, boss_beside_pocket())
CAPSTAN_MADE(RemovalOfParts, KeepsEachBossOfAPatternFromTheOthersSteps, bosses_in_a_pattern())
CAPSTAN_MADE(RemovalOfParts, KeepsABossWhereItsCompoundPutsIt, boss_in_a_compound())
CAPSTAN_MADE(RemovalOfParts, DrillsBesideWallsWithoutGougingThem, holes_near_walls())
CAPSTAN_MADE(RemovalOfParts, CutsTolerancedConesSeatsAndCoresListedInAnyOrder, tight_holes())
CAPSTAN_MADE(RemovalOfParts, SinksAConeWithATipThatGoesIntoItsCore, small_countersink())
CAPSTAN_MADE(RemovalOfParts, MillsAWideHoleThatRunsOverAnEdge, hole_over_an_edge())
CAPSTAN_MADE(RemovalOfParts, EntersAndCutsAPocketThatRunsOverAnEdge, pocket_over_an_edge())
CAPSTAN_MADE(RemovalOfParts, ClearsThePieceAroundALoneRoundBoss, lone_boss(true))
CAPSTAN_MADE(RemovalOfParts, ClearsALongPieceOutToItsFarEnd, boss_at_the_end_of_a_long_block())
CAPSTAN_MADE(RemovalOfParts, ClearsThePieceAroundALoneSquareBoss, lone_boss(false))
CAPSTAN_MADE(RemovalOfParts, OpensAPocketBeforeTheOneInItsFloor, pocket_in_a_pocket())
CAPSTAN_MADE(RemovalOfParts, KeepsTheStatedCornersAtTheFlatEndsOfASlot, flat_ended_slot())
CAPSTAN_MADE(RemovalOfParts, RoundsEachFlatEndOfASlotByItsOwnRadius, unequal_flat_ends())
CAPSTAN_MADE(RemovalOfParts, LeavesOnlyTheCornersOfAPocketThatNoMillMakes, pocket_with_rest_in_its_corners(2))
CAPSTAN_MADE(RemovalOfParts, LeavesOnlyTheCornersAtTheSquareEndsOfASlot, square_ended_slot(1))
CAPSTAN_MADE(RemovalOfParts, EndsAHoleThatOpensIntoACrossBoreThere, hole_into_a_cross_bore())
CAPSTAN_MADE(RemovalOfParts, CutsEachPlaceOfAPatternThatMeetsItselfOnce, pattern_that_meets_itself())

// What is planned comes out as it must; what cannot be is named with its reason.
void expect_left_out(const Part& part, std::size_t unplanned, const std::string& why) {
  const Outcome o = plan_and_simulate(part);
  ASSERT_TRUE(o.written()) << part.name << ":\n" << o.text();
  EXPECT_EQ(o.plan.unplanned, unplanned) << o.text();
  EXPECT_NE(o.text().find(why), std::string::npos) << o.text();
  EXPECT_TRUE(o.verdict.agrees()) << part.name << ":\n" << o.text();
}

TEST(RemovalOfParts, KeepsClearOfALeaningBossByItsFoot) {
  CAPSTAN_NEEDS_RS274();
  expect_left_out(leaning_boss(), 1, "BOSS 'CONE': its walls lean by 10 degrees");
}
TEST(RemovalOfParts, KeepsClearOfABossWhoseHeightIsNotKnown) {
  CAPSTAN_NEEDS_RS274();
  expect_left_out(boss_without_height(), 1,
                  "feature 'ISLAND' (BOSS) is not planned: the feature has no depth");
}
TEST(RemovalOfParts, LeavesOutAPocketThatListsABossBesideIt) {
  CAPSTAN_NEEDS_RS274();
  expect_left_out(boss_beside_what_lists_it(), 1, "lists BOSS 'ISLAND', which lies outside it");
}
TEST(RemovalOfParts, LeavesOutWhatMayCutABossThatCannotBeRead) {
  CAPSTAN_NEEDS_RS274();
  expect_left_out(boss_without_contour(true), 2, "BOSS 'ISLAND' has no closed profile");
  expect_left_out(boss_without_contour(false), 3, "BOSS 'ISLAND' has no closed profile");
}

}  // namespace
}  // namespace capstan::testing::removal
