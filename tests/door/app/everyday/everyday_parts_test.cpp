#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <string>

#include "tests/door/app/command/command.h"
#include "tests/door/app/programs.h"

// Parts as CAD systems make them every day are planned whole, from above, and their programs make them.

namespace capstan::app {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

class EverydayParts : public CommandTest {
 protected:
  /// What planning a part says.
  Ran planned(const std::string& name) {
    put_part(name);
    return run("plan " + name + ".step --material 6061 -o part.json -o part.ngc -o part.p21");
  }
  void put_part(const std::string& name) {
    ASSERT_EQ(std::system(("'" + parts_file() + "' " + name + " '" + (folder_ / name).string() +
                           ".step' >/dev/null 2>&1")
                              .c_str()),
              0);
  }
};

#define NEEDS_PARTS() \
  if (parts_file().empty()) GTEST_SKIP() << "built without OpenCASCADE"

/// Planned whole in one set-up, and the program makes the CAD shape.
auto whole_in_one_setup() {
  return AllOf(HasSubstr("no face and no volume is left over"), HasSubstr("100 % overlap"),
               HasSubstr("\nSafe: "), Not(HasSubstr("set-ups")), Not(HasSubstr("CHK-SHAPE-")),
               Not(HasSubstr("PIP-UNPLANNED")));
}

TEST_F(EverydayParts, ChamfersRoundABlockTakeOneSetUp) {
  NEEDS_PARTS();
  const Ran r = planned("block_with_chamfers");
  EXPECT_EQ(r.code, 0);
  EXPECT_THAT(r.err + r.out, whole_in_one_setup());
  EXPECT_THAT(run("explain part.json").out, HasSubstr("CHAMFER 2 chamfer"));
}

TEST_F(EverydayParts, ChamfersOfAnOutlineAndOfAPocketAreMadeWithThem) {
  NEEDS_PARTS();
  const Ran r = planned("plate_with_chamfers");
  EXPECT_EQ(r.code, 0);
  EXPECT_THAT(r.err + r.out, whole_in_one_setup());
  EXPECT_THAT(run("explain part.json").out,
              AllOf(HasSubstr("CHAMFER 3 chamfer"), HasSubstr("CHAMFER 4 chamfer")));
  // The file says which edges they break, and reads back the same.
  const Ran again = run("check part.p21");
  EXPECT_THAT(again.err + again.out, HasSubstr("Safe: 1 file checked; no error"));
}

TEST_F(EverydayParts, AChamferThatASlotInterruptsIsOneChamfer) {
  NEEDS_PARTS();
  const Ran r = planned("plate_with_chamfers_and_slot");
  EXPECT_EQ(r.code, 0);
  EXPECT_THAT(r.err + r.out, whole_in_one_setup());
  EXPECT_THAT(r.err + r.out, HasSubstr("3 features of"));
}

TEST_F(EverydayParts, RoundsOfAnOutlineAreMadeByAMillThatRoundsEdges) {
  NEEDS_PARTS();
  const Ran r = planned("plate_with_rounds");
  EXPECT_EQ(r.code, 0);
  EXPECT_THAT(r.err + r.out, whole_in_one_setup());
  EXPECT_THAT(r.err + r.out, Not(HasSubstr("CHK-GOUGE-UNDECIDED")));
  EXPECT_THAT(run("explain part.json").out, HasSubstr("corner rounding mill"));
}

TEST_F(EverydayParts, ABossKeepsTheFilletAtItsFootAndGetsItsChamfer) {
  NEEDS_PARTS();
  const Ran r = planned("plate_with_boss");
  EXPECT_EQ(r.code, 0);
  EXPECT_THAT(r.err + r.out, whole_in_one_setup());
}

TEST_F(EverydayParts, FilletsThatMeetInMitresAtSharpCornersAreMade) {
  NEEDS_PARTS();
  for (const char* part : {"plate_with_sharp_block", "block_with_corners_standing"}) {
    const Ran r = planned(part);
    EXPECT_EQ(r.code, 0) << part;
    EXPECT_THAT(r.err + r.out, whole_in_one_setup()) << part;
  }
}

TEST_F(EverydayParts, WallsThatEndAlongTheSidesOfTheRawPieceAreMadeToTheirEnds) {
  NEEDS_PARTS();
  const Ran r = planned("block_with_round_corners_standing");
  EXPECT_EQ(r.code, 0);
  EXPECT_THAT(r.err + r.out,
              AllOf(HasSubstr("no face and no volume is left over"), HasSubstr("12 of 12 plane faces"),
                    HasSubstr("\nSafe: 2 steps"), Not(HasSubstr("CHK-SHAPE-"))));
}

TEST_F(EverydayParts, FilletsAtTheFloorsOfOpenShapesAreMade) {
  NEEDS_PARTS();
  for (const char* part : {"block_with_shoulder", "block_with_round_slot", "block_with_open_pocket"}) {
    const Ran r = planned(part);
    EXPECT_EQ(r.code, 0) << part;
    EXPECT_THAT(r.err + r.out, whole_in_one_setup()) << part;
  }
}

TEST_F(EverydayParts, BevelsThatNoMillMakesFromAboveAreFaced) {
  NEEDS_PARTS();
  const Ran one = planned("block_with_one_bevel");
  EXPECT_THAT(one.err + one.out, AllOf(HasSubstr("100 % overlap"), HasSubstr("\nSafe: ")));
  const Ran wide = planned("block_with_wide_bevels");
  EXPECT_THAT(wide.err + wide.out,
              AllOf(HasSubstr("4 features of 4 faces"), HasSubstr("4 set-ups"), HasSubstr("\nSafe: ")));
}

TEST_F(EverydayParts, ASharpRibInTheSlotThatInterruptsAChamferStaysSharp) {
  NEEDS_PARTS();
  const Ran r = planned("plate_with_chamfers_and_rib");
  EXPECT_THAT(r.err + r.out, AllOf(Not(HasSubstr("CHK-SHAPE-GOUGE")), HasSubstr("\nSafe")));
  EXPECT_THAT(run("explain part.json").out, Not(HasSubstr("chamfer mill")));
}

TEST_F(EverydayParts, TheToolGoesRoundATallBossWhileItFacesALowerOne) {
  NEEDS_PARTS();
  const Ran r = planned("plate_with_bosses_of_two_heights");
  EXPECT_EQ(r.code, 0);
  // Of a plate without walls the lattice counts the foot's fillets to a thousandth.
  EXPECT_THAT(r.err + r.out,
              AllOf(HasSubstr("8 of 8 plane faces"), HasSubstr("\nSafe: "), Not(HasSubstr("set-ups")),
                    Not(HasSubstr("CHK-SHAPE-")), Not(HasSubstr("PIP-UNPLANNED"))));
}

TEST_F(EverydayParts, AWindowInAThinFloorIsCutFromOutside) {
  NEEDS_PARTS();
  // The hollow is 37 mm deep, the floor 3 mm thick: no mill of 4 mm reaches the window through the hollow.
  const Ran r = planned("cover_with_window");
  EXPECT_EQ(r.code, 0);
  EXPECT_THAT(r.err + r.out,
              AllOf(HasSubstr("2 features of"), HasSubstr("2 set-ups"), HasSubstr("100 % overlap"),
                    HasSubstr("\nSafe: "), Not(HasSubstr("PIP-UNPLANNED"))));
  const std::string part = slurp(folder_ / "part.p21");
  EXPECT_THAT(part, HasSubstr("THROUGH_POCKET_BOTTOM_CONDITION"));
  EXPECT_THAT(part, HasSubstr("(0.,0.,-3.)"));
}

TEST_F(EverydayParts, ARoundEdgeGoesRoundCornersThatAreAsRound) {
  NEEDS_PARTS();
  const Ran r = planned("block_with_round_corners");
  EXPECT_EQ(r.code, 0);
  EXPECT_THAT(r.err + r.out, whole_in_one_setup());
  EXPECT_THAT(run("explain part.json").out, HasSubstr("corner rounding mill"));
}

TEST_F(EverydayParts, EdgesOfASlotAndOfAnOpenPocketAreBrokenFromAbove) {
  NEEDS_PARTS();
  for (const char* part : {"plate_with_slot_all_chamfered", "plate_with_slot_all_rounded",
                           "plate_with_open_pocket_all_chamfered"}) {
    const Ran r = planned(part);
    EXPECT_EQ(r.code, 0) << part;
    EXPECT_THAT(r.err + r.out, whole_in_one_setup()) << part;
  }
}

TEST_F(EverydayParts, EdgesOfBothSidesAreBrokenInTwoSetUps) {
  NEEDS_PARTS();
  const Ran r = planned("plate_chamfered_on_both_sides");
  EXPECT_EQ(r.code, 0);
  EXPECT_THAT(r.err + r.out,
              AllOf(HasSubstr("no face and no volume is left over"), HasSubstr("14 of 14 plane faces"),
                    HasSubstr("2 set-ups"), HasSubstr("\nSafe: "), Not(HasSubstr("PIP-UNPLANNED"))));
  // The far mouth of the hole, from below.
  EXPECT_THAT(run("explain part.json").out, HasSubstr("HOLE 4 countersink"));
}

TEST_F(EverydayParts, ABlindHoleWithAFlatBottomGetsTheChamferOfItsMouth) {
  NEEDS_PARTS();
  const Ran r = planned("plate_with_chamfered_holes");
  EXPECT_EQ(r.code, 0);
  EXPECT_THAT(r.err + r.out, AllOf(HasSubstr("11 of 11 plane faces"), HasSubstr("\nSafe: "),
                                   Not(HasSubstr("set-ups")), Not(HasSubstr("PIP-UNPLANNED"))));
}

TEST_F(EverydayParts, ASheetBesideTheSolidIsToldAndLeft) {
  NEEDS_PARTS();
  const Ran r = planned("plate_and_sheet");
  EXPECT_EQ(r.code, 0);
  EXPECT_THAT(r.err + r.out,
              AllOf(HasSubstr("beside the one solid the file holds 1 sheet, without volume: the solid "
                              "is planned"),
                    HasSubstr("[CAD-SHEETS]"), HasSubstr("\nSafe: ")));
  EXPECT_THAT(run("plan plate_and_sheet.step --body 2 --material 6061 -o part.json").err,
              HasSubstr("expected the number or the name of one solid"));
}

TEST_F(EverydayParts, APartDrawnInInchesIsOfferedInchTools) {
  NEEDS_PARTS();
  const Ran r = planned("pocket_inch");
  EXPECT_EQ(r.code, 0);
  EXPECT_THAT(r.err + r.out, whole_in_one_setup());
  EXPECT_THAT(slurp(folder_ / "part.json"), AllOf(HasSubstr("generic-inch, "), HasSubstr("drawn in inches")));
  // No metric mill has the fillet of .09.
  const Ran metric = run("plan pocket_inch.step --material 6061 --tools generic -o metric.json");
  EXPECT_THAT(metric.err, HasSubstr("corner radius 2.286 mm"));
}

TEST_F(EverydayParts, AHoleOfAnInchDrillsSizeIsDrilledByThatDrill) {
  NEEDS_PARTS();
  EXPECT_EQ(planned("holes_inch").code, 0);
  EXPECT_THAT(run("explain part.json").out,
              AllOf(HasSubstr("6.35 mm twist drill"), HasSubstr("5.105 mm twist drill")));
}

TEST_F(EverydayParts, BossesStandOnBossesOnBosses) {
  NEEDS_PARTS();
  const Ran r = planned("pocket_with_stack");
  EXPECT_EQ(r.code, 0);
  EXPECT_THAT(r.err + r.out,
              AllOf(Not(HasSubstr("CHK-GOUGE")), HasSubstr("\nSafe: "), Not(HasSubstr("PIP-UNPLANNED"))));
}

TEST_F(EverydayParts, APartThatIsTooLargeForTheUsualMachineGetsALargerOne) {
  NEEDS_PARTS();
  const Ran r = planned("long_plate");
  EXPECT_EQ(r.code, 0);
  EXPECT_THAT(r.err + r.out, AllOf(HasSubstr("\nSafe: "), Not(HasSubstr("CHK-MACHINE-PIECE"))));
  EXPECT_THAT(run("explain part.json").out,
              HasSubstr("built-in default, the raw piece is too large for 'generic_vmc'"));
}

TEST_F(EverydayParts, OfTwoBossesOneGetsItsChamfer) {
  NEEDS_PARTS();
  const Ran r = planned("block_with_two_bosses");
  EXPECT_EQ(r.code, 0);
  EXPECT_THAT(r.err + r.out, whole_in_one_setup());
}

}  // namespace
}  // namespace capstan::app
