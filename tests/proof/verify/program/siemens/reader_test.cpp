#include "planner/proof/verify/program/siemens/reader.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "planner/ground/base/number.h"
#include "tests/proof/verify/plans.h"

// What a SINUMERIK 840D sl makes of blocks, by its manuals (reader.h names them).

namespace capstan::verify::siemens {
namespace {

using Kind = Block::Kind;
using model::MoveKind;

model::Machine machine(std::vector<model::ControlOption> options = {}) {
  model::Machine m = testing::machine();
  m.control.dialect = "siemens";
  if (!options.empty()) m.control_options = model::ControlOptions{std::move(options)};
  return m;
}

constexpr const char* kStart =
    "G17 G40 G90 G94 G710\nMCALL\nG60\nG54\nT1 M6\nS1000 M3\nG0 X5 Y6\nG0 D1 Z20\n";

Program read(const std::string& body, std::vector<model::ControlOption> options = {}) {
  return read_program(kStart + body + "M30\n", machine(std::move(options)));
}

/// "R 5 6 2" for a rapid to X5 Y6 Z2, "L" a line, "A" an arc, "T" tapping, "D 0.5" a dwell; those behind the
/// start, rounded.
std::vector<std::string> moves(const Program& p) {
  std::vector<std::string> out;
  for (const Block& b : p.blocks) {
    if (b.line <= 8 || (b.kind != Kind::kMove && b.kind != Kind::kDwell)) continue;
    const char* kind = b.kind == Kind::kDwell       ? "D "
                       : b.move == MoveKind::kRapid ? "R "
                       : b.synchronised             ? "T "
                       : b.move == MoveKind::kLine  ? "L "
                                                    : "A ";
    out.push_back(kind + (b.kind == Kind::kDwell
                              ? trimmed(b.dwell_s, 4)
                              : trimmed(b.to.x, 4) + " " + trimmed(b.to.y, 4) + " " + trimmed(b.to.z, 4)));
  }
  return out;
}

bool finds(const Program& p, const std::string& code) {
  return std::any_of(p.faults.begin(), p.faults.end(), [&](const auto& f) { return f.code == code; });
}
std::string faults(const Program& p) {
  std::string out;
  for (const auto& f : p.faults) out += std::to_string(f.line) + " " + f.code + " " + f.message + "\n";
  return out;
}

using Moves = std::vector<std::string>;

// CYCLE81: by rapid to RFP + SDIS, at feed to DP, by rapid to RTP; at each place behind MCALL.
TEST(SiemensCycles, AModalCallDrillsBehindEachMoveUntilItIsEnded) {
  const auto p = read("F100\nMCALL CYCLE81(15,1,1,-8,)\nG0 X10 Y6\nX12\nMCALL\nG0 X14\n");
  EXPECT_EQ(faults(p), "");
  EXPECT_EQ(moves(p), (Moves{"R 10 6 20", "R 10 6 2", "L 10 6 -8", "R 10 6 15", "R 12 6 15", "R 12 6 2",
                             "L 12 6 -8", "R 12 6 15", "R 14 6 15"}));
}

TEST(SiemensCycles, ACallByItselfDrillsOnceWhereTheToolIs) {
  const auto p = read("F100\nCYCLE81(15,1,1,-8)\nG0 X10\n");
  EXPECT_EQ(faults(p), "");
  EXPECT_EQ(moves(p), (Moves{"R 5 6 2", "L 5 6 -8", "R 5 6 15", "R 10 6 15"}));
}

// DPR counts from RFP and holds in place of DP.
TEST(SiemensCycles, ADepthMayCountFromTheReferencePlane) {
  EXPECT_EQ(moves(read("F100\nCYCLE81(15,1,1,,9)\n")), (Moves{"R 5 6 2", "L 5 6 -8", "R 5 6 15"}));
  EXPECT_TRUE(finds(read("F100\nCYCLE81(15,1,1,-8,12)\n"), "CHK-CYCLE"));
}

// CYCLE82, CYCLE89: DTB at the bottom, seconds above 0, turns below; CYCLE85: down at FFR, up at RFF.
TEST(SiemensCycles, WaitAtTheBottomAndComeOutAtFeedAsTheyAreMeant) {
  EXPECT_EQ(moves(read("F100\nCYCLE82(15,1,1,-8,,0.5)\n")),
            (Moves{"R 5 6 2", "L 5 6 -8", "D 0.5", "R 5 6 15"}));
  EXPECT_EQ(moves(read("F100\nCYCLE82(15,1,1,-8,,-2)\n")),  // 2 turns at 1,000 1/min
            (Moves{"R 5 6 2", "L 5 6 -8", "D 0.12", "R 5 6 15"}));
  EXPECT_EQ(moves(read("F100\nCYCLE89(15,1,1,-8,,0.5)\n")),
            (Moves{"R 5 6 2", "L 5 6 -8", "D 0.5", "L 5 6 2", "R 5 6 15"}));
  const auto p = read("F100\nCYCLE85(15,1,1,-8,,0,150,300)\n");
  EXPECT_EQ(faults(p), "");
  EXPECT_EQ(moves(p), (Moves{"R 5 6 2", "L 5 6 -8", "L 5 6 2", "R 5 6 15"}));
  EXPECT_EQ(p.blocks[p.blocks.size() - 4].feed_mm_min, 150.0);
  EXPECT_EQ(p.blocks[p.blocks.size() - 3].feed_mm_min, 300.0);
}

// CYCLE83: VARI 0 goes up by _VRT (1 mm where it is 0), VARI 1 to RFP + SDIS and back to _DIS1 above.
TEST(SiemensCycles, PecksGrowShorterByDamAndBreakOrClearTheChips) {
  EXPECT_EQ(moves(read("F100\nCYCLE83(15,1,1,-8,,-3,,1,0,0,1,0,,2)\n")),
            (Moves{"R 5 6 2", "L 5 6 -3", "L 5 6 -2", "L 5 6 -6", "L 5 6 -5", "L 5 6 -8", "R 5 6 15"}));
  EXPECT_EQ(moves(read("F100\nCYCLE83(15,1,1,-8,,-3,,0,0,0,1,1,,0,,,0.5)\n")),
            (Moves{"R 5 6 2", "L 5 6 -3", "R 5 6 2", "R 5 6 -2.5", "L 5 6 -7", "R 5 6 2", "R 5 6 -6.5",
                   "L 5 6 -8", "R 5 6 15"}));
  EXPECT_TRUE(finds(read("F100\nCYCLE83(15,1,1,-8,,-3,,0,0,0,1,1,1)\n"), "CHK-UNVERIFIABLE"));  // along X
}

// POCKET4 of radius 12 about (5, 6) with a mill of 10: from 1 to -3 in two levels; in along a helix of 4 that
// goes down 1 in a turn, a whole turn at its foot, and a ring at 12 - 5 = 7. The second level is come to by
// rapid as far above the first as the tool is fed from above RFP.
TEST(SiemensCycles, APocketIsClearedLevelByLevelFromItsMiddle) {
  const std::string tool = ";CAPSTAN TOOL T1 H1 length=100 diameter=10 end_mill\n";
  const std::string call = "POCKET4(20,1,1,-3,12,5,6,2,0,0,500,200,0,21,8,,,4,1)\n";
  const auto p = read(tool + call);
  EXPECT_EQ(faults(p), "");
  EXPECT_EQ(moves(p), (Moves{"R 9 6 20",   "R 9 6 2",   "A 1 6 1.5",  "A 9 6 1",   "A 1 6 0.5",  "A 9 6 0",
                             "A 1 6 -0.5", "A 9 6 -1",  "A 1 6 -1",   "A 9 6 -1",  "L 12 6 -1",  "A -2 6 -1",
                             "A 12 6 -1",  "R 12 6 2",  "R 9 6 2",    "R 9 6 0",   "A 1 6 -0.5", "A 9 6 -1",
                             "A 1 6 -1.5", "A 9 6 -2",  "A 1 6 -2.5", "A 9 6 -3",  "A 1 6 -3",   "A 9 6 -3",
                             "L 12 6 -3",  "A -2 6 -3", "A 12 6 -3",  "R 12 6 20", "R 5 6 20"}));
  ASSERT_EQ(p.pockets.size(), 1U);
  EXPECT_FALSE(p.pockets[0].clockwise);                // climbing, with M3
  EXPECT_TRUE(finds(read(call), "CHK-UNVERIFIABLE"));  // how wide the tool is nobody says
  EXPECT_TRUE(finds(read(tool + "POCKET3(1,2)\n"), "CHK-CYCLE"));
}

// HOLES1: from the end nearer to the tool (5, 6); FDIS before the first.
TEST(SiemensCycles, ARowOfHolesIsMadeFromTheEndNearerToTheTool) {
  const auto p = read("F100\nMCALL CYCLE81(20,1,1,-8,)\nHOLES1(0,6,0,5,10,2)\nMCALL\nG0 X0\n");
  EXPECT_EQ(faults(p), "");
  const Moves near = {"R 5 6 2",  "L 5 6 -8",  "R 5 6 20",  "R 15 6 20",
                      "R 15 6 2", "L 15 6 -8", "R 15 6 20", "R 0 6 20"};
  EXPECT_EQ(moves(p), near);
  // The same row named from its other end; where its last place is comes of an angle, and is reached anew.
  Moves other = moves(read("F100\nMCALL CYCLE81(20,1,1,-8,)\nHOLES1(15,6,180,0,10,2)\nMCALL\nG0 X0\n"));
  ASSERT_FALSE(other.empty());
  EXPECT_EQ(other.front(), "R 5 6 20");
  other.erase(other.begin());
  EXPECT_EQ(other, near);
}

// HOLES2: STA1 from +X, INDA further each time; INDA 0: NUM holes divide the circle.
TEST(SiemensCycles, ACircleOfHolesBeginsAtItsAngleAndGoesOnByTheNext) {
  const Moves quarter = {"R 10 6 20", "R 10 6 2", "L 10 6 -8", "R 10 6 20",
                         "R 5 11 20", "R 5 11 2", "L 5 11 -8", "R 5 11 20"};
  EXPECT_EQ(moves(read("F100\nMCALL CYCLE81(20,1,1,-8,)\nHOLES2(5,6,5,0,90,2)\nMCALL\n")), quarter);
  const Moves half = {"R 10 6 20", "R 10 6 2", "L 10 6 -8", "R 10 6 20",
                      "R 0 6 20",  "R 0 6 2",  "L 0 6 -8",  "R 0 6 20"};
  EXPECT_EQ(moves(read("F100\nMCALL CYCLE81(20,1,1,-8,)\nHOLES2(5,6,5,0,0,2)\nMCALL\n")), half);
}

TEST(SiemensCycles, APatternThatIsNotFollowedIsAFault) {
  const std::string call = "F100\nMCALL CYCLE81(20,1,1,-8,)\n";
  EXPECT_TRUE(finds(read("F100\nHOLES2(5,6,5,0,90,2)\n"), "CHK-CYCLE"));  // nothing is called modally
  EXPECT_TRUE(finds(read("MCALL HOLES2(5,6,5,0,90,2)\nMCALL\n"), "CHK-CYCLE"));
  EXPECT_TRUE(finds(read(call + "HOLES2(5,6,0,0,90,2)\nMCALL\n"), "CHK-CYCLE"));  // no radius
  EXPECT_TRUE(finds(read(call + "HOLES2(5,6,5,0,90)\nMCALL\n"), "CHK-CYCLE"));    // no number
  EXPECT_TRUE(finds(read(call + "HOLES2(5,6,5,0,90,1.5)\nMCALL\n"), "CHK-CYCLE"));
  EXPECT_TRUE(finds(read(call + "HOLES2(5,6,5,270,90,2)\nMCALL\n"), "CHK-CYCLE"));  // STA1
  EXPECT_TRUE(finds(read(call + "HOLES1(0,6,0,0,-10,2)\nMCALL\n"), "CHK-CYCLE"));
  EXPECT_TRUE(finds(read(call + "HOLES2(5,6,5,0,90,2,,1)\nMCALL\n"), "CHK-UNVERIFIABLE"));  // on the arc
  EXPECT_TRUE(finds(read(call + "HOLES1(0,6,0,0,10,2)\nMCALL\n"), "CHK-UNVERIFIABLE"));     // equally far
}

// CYCLE84: PIT with the sign of the thread, SST down and SST1 up, the spindle behind it as SDAC says.
TEST(SiemensCycles, TappingHoldsStepBothWaysAndLeavesTheSpindleAsItSays) {
  const auto p = read("CYCLE84(15,4,1,-12,,0,5,,1.5,0,400,600)\n");
  EXPECT_EQ(faults(p), "");
  EXPECT_EQ(moves(p), (Moves{"R 5 6 5", "T 5 6 -12", "T 5 6 5", "R 5 6 15"}));
  const Block &down = p.blocks[p.blocks.size() - 4], &up = p.blocks[p.blocks.size() - 3];
  EXPECT_EQ(down.spindle_rpm, 400.0);
  EXPECT_EQ(down.feed_mm_min, 600.0);
  EXPECT_EQ(up.spindle_rpm, -600.0);
  EXPECT_EQ(up.feed_mm_min, 900.0);
  EXPECT_EQ(p.blocks[p.blocks.size() - 2].spindle_rpm, 0.0);
  const auto left = read("CYCLE84(15,4,1,-12,,0,4,,-1.5,0,400,400)\n");
  EXPECT_EQ(left.blocks[left.blocks.size() - 4].spindle_rpm, -400.0);
  EXPECT_EQ(left.blocks[left.blocks.size() - 2].spindle_rpm, -1000.0);  // M4 at the programmed speed
  // M8 has a pitch of 1.25 mm (ISO 261).
  const auto size = read("CYCLE84(15,4,1,-12,,0,5,8,,0,400,400)\n");
  EXPECT_EQ(size.blocks[size.blocks.size() - 4].pitch_mm, 1.25);
  EXPECT_TRUE(finds(read("CYCLE84(15,4,1,-12,,0,5,,,0,400,400)\n"), "CHK-TAP-FEED"));
  EXPECT_TRUE(finds(read("CYCLE84(15,4,1,-12,,0,,,1,0,400,400)\n"), "CHK-CYCLE"));
}

// CYCLE840 with the encoder: down as the spindle turns (M3 S1000), back with SDR, behind it as SDAC says.
TEST(SiemensCycles, TappingInAChuckFollowsTheSpindleByTheLead) {
  const auto p = read("CYCLE840(15,4,1,-12,,0,4,3,0,,1.5)\nG0 X9\n");
  EXPECT_EQ(faults(p), "");
  EXPECT_EQ(moves(p), (Moves{"R 5 6 5", "T 5 6 -12", "T 5 6 5", "R 5 6 15", "R 9 6 15"}));
  const Block &down = p.blocks[p.blocks.size() - 5], &up = p.blocks[p.blocks.size() - 4];
  EXPECT_TRUE(down.in_chuck && up.in_chuck);
  EXPECT_EQ(down.pitch_mm, 1.5);
  EXPECT_EQ(down.feed_mm_min, 1500.0);
  EXPECT_EQ(down.spindle_rpm, 1000.0);
  EXPECT_EQ(up.spindle_rpm, -1000.0);
  EXPECT_EQ(p.blocks[p.blocks.size() - 2].spindle_rpm, 1000.0);
  EXPECT_EQ(read("CYCLE840(15,4,1,-12,,0,4,5,0,,1.5)\nG0 X9\n").blocks.rbegin()[1].spindle_rpm, 0.0);
  // M8 has a pitch of 1.25 mm (ISO 261); SDR 0 reverses by itself.
  EXPECT_EQ(faults(read("CYCLE840(15,4,1,-12,,0,0,,0,8)\n")), "");
  EXPECT_TRUE(finds(read("CYCLE840(15,4,1,-12,,0,3,3,0,,1.5)\n"), "CHK-CYCLE"));
  EXPECT_TRUE(finds(read("CYCLE840(15,4,1,-12,,0,4,,0,,1.5)\n"), "CHK-CYCLE"));
  EXPECT_TRUE(finds(read("CYCLE840(15,4,1,-12,,0,4,3,0)\n"), "CHK-TAP-FEED"));
  EXPECT_TRUE(finds(read("M5\nCYCLE840(15,4,1,-12,,0,4,3,0,,1.5)\n"), "CHK-SPINDLE"));
  EXPECT_TRUE(finds(read("F1500\nCYCLE840(15,4,1,-12,,0,4,3,1,,1.5)\n"), "CHK-UNVERIFIABLE"));
}

// CYCLE86: the spindle stands turned to POSS, off the wall by RPA and RPO, up, and back over the hole.
TEST(SiemensCycles, BoringLiftsOffTheWallBeforeItComesUp) {
  const auto p = read("F100\nCYCLE86(15,1,1,-8,,0,3,-0.5,0.25,0,45)\n");
  EXPECT_EQ(faults(p), "");
  EXPECT_EQ(moves(p), (Moves{"R 5 6 2", "L 5 6 -8", "R 4.5 6.25 -8", "R 4.5 6.25 15", "R 5 6 15"}));
  for (const char* before : {"M5\n", "M4\n"})
    EXPECT_TRUE(finds(read(before + std::string("F100\nCYCLE86(15,1,1,-8,,0,3,0,0,0,0)\n")), "CHK-SPINDLE"));
}

TEST(SiemensCycles, WhatWouldBreakTheToolOrIsNotFollowedIsAFault) {
  for (const char* body : {
           "F100\nCYCLE81(1,1,1,-8)\n",    // RTP below RFP + SDIS
           "F100\nCYCLE81(15,1,-1,-8)\n",  // SDIS has no sign
           "F100\nCYCLE81(15,1,1,2)\n",    // above RFP
           "F100\nCYCLE81(15,,1,-8)\n",    // no RFP
           "F100\nCYCLE81(35,25,1,-8)\n",  // starts above the tool
           "F100\nMCALL CYCLE81(15,1,1,-8)\nG0 SUPA Z0 D0\n",
           "F100\nMCALL CYCLE81(15,1,1,-8)\nMCALL CYCLE81(15,1,1,-8)\n",
           "F100\nG0 X5 CYCLE81(15,1,1,-8)\n",  // not alone
       })
    EXPECT_TRUE(finds(read(body), "CHK-CYCLE")) << body << faults(read(body));
  for (const char* body :
       {"CYCLE81(15,1,1,R5)\n", "CYCLE81(15,1,1,-8,,0,10)\n", "CYCLE72(1,2)\n", "CYCLE832(0.01,112001)\n",
        "R1=5\n", "TRANS X5\n", "GOTOF END\n", "X=R1\n", "G4 S100\n", "I=AC(5)\n"})
    EXPECT_TRUE(finds(read(body), "CHK-UNVERIFIABLE")) << body << faults(read(body));
  for (const char* body : {"G58 X5\n", "G74 Z=0\n", "G18\n", "G500.5\n"})
    EXPECT_FALSE(read(body).faults.empty()) << body;
}

// Two full circles and three quarters, from (5, 6) about (1, 6): half turns, 1.5 mm down with each.
TEST(SiemensArcs, AHelixWithTurnsIsThatManyWholeOnesAndTheRest) {
  const auto p = read("G3 X1 Y2 Z11.75 I-4 J0 TURN=2 F100\n");
  EXPECT_EQ(faults(p), "");
  EXPECT_EQ(moves(p),
            (Moves{"A -3 6 18.5", "A 5 6 17", "A -3 6 15.5", "A 5 6 14", "A -3 6 12.5", "A 1 2 11.75"}));
  // Back where it began: one whole circle, and one further.
  EXPECT_EQ(moves(read("G2 X5 Y6 Z16 I-4 J0 TURN=1 F100\n")),
            (Moves{"A -3 6 19", "A 5 6 18", "A -3 6 17", "A 5 6 16"}));
  EXPECT_TRUE(finds(read("G3 X1 Y2 Z11 I-4 J0 TURN=1.5 F100\n"), "CHK-ARC"));
}

// From (17.3, 50) half a turn and four about a centre that was rounded: 9.0001 half turns are nine.
TEST(SiemensArcs, WhatRoundingLeavesOfAHelixIsNoMoveOfItsOwn) {
  const auto p = read("G0 X17.3 Y50 Z18\nG3 X22.7 Y50 Z14 I2.7 J-0.00023 TURN=4 F100\n");
  EXPECT_EQ(faults(p), "");
  EXPECT_EQ(moves(p).size(), 1U + 9U);
  EXPECT_EQ(moves(p).back(), "A 22.7 50 14");
}

TEST(SiemensArcs, ByRadiusAreTheShorterWayAndBelowZeroTheLonger) {
  const auto shorter = read("G3 X1 Y10 CR=4 F100\n"), longer = read("G3 X1 Y10 CR=-4 F100\n");
  ASSERT_EQ(faults(shorter) + faults(longer), "");
  const auto centre = [](const Program& p) { return p.blocks[p.blocks.size() - 2].centre; };
  EXPECT_NEAR(norm(centre(shorter) - geometry::Vec2{1, 6}), 0.0, 1e-9);
  EXPECT_NEAR(norm(centre(longer) - geometry::Vec2{5, 10}), 0.0, 1e-9);
  EXPECT_TRUE(finds(read("G3 X1 Y10 CR=4 I-4 F100\n"), "CHK-ARC"));
}

TEST(SiemensState, SupaSaysWhereTheAxisGoesOnlyWithoutTheToolsLength) {
  const auto off = read("G0 SUPA Z0 D0\nM5\n");
  EXPECT_EQ(faults(off), "");
  EXPECT_TRUE(off.blocks[off.blocks.size() - 2].machine_z);
  const auto on = read("G0 SUPA Z0\n");
  EXPECT_TRUE(finds(on, "CHK-MACHINE-MOVE"));
  EXPECT_FALSE(on.blocks[on.blocks.size() - 2].machine_z);
}

TEST(SiemensState, TheLengthIsOffBehindAChangeUntilD1AndAnotherEdgeIsAFault) {
  const auto p = read_program("G17 G40 G90 G94 G710\nG54\nT7 M6\nG0 Z20\nG0 D1 Z20\n", machine());
  ASSERT_EQ(p.blocks.size(), 3U);
  EXPECT_EQ(p.blocks[1].length_offset, -1);
  EXPECT_EQ(p.blocks[2].length_offset, 7);
  EXPECT_TRUE(finds(read("G0 D2 Z20\n"), "CHK-TOOL-NUMBER"));
}

TEST(SiemensState, AToolCalledByNameIsThatOfTheHeader) {
  const std::string head = ";CAPSTAN TOOL T4 H4 length=50 diameter=8 id=\"d8%20long\" twist_drill\n";
  const auto p = read_program(head + "T=\"d8 long\" M6\n", machine());
  ASSERT_EQ(p.blocks.size(), 1U);
  EXPECT_EQ(p.blocks[0].tool, 4);
  EXPECT_TRUE(finds(read_program(head + "T=\"d9\" M6\n", machine()), "CHK-TOOL"));
}

TEST(SiemensState, ToleranceIsWhatCornersMayBeRoundedBy) {
  const auto of = [](const std::string& body) {
    const auto p = read(body + "G0 X9\n");
    return p.blocks[p.blocks.size() - 2].tolerance_mm;
  };
  EXPECT_EQ(of("CYCLE832(0.02,3,1)\n"), 0.02);
  EXPECT_EQ(of("CYCLE832(0.02,_FINISH,1)\n"), 0.02);
  EXPECT_EQ(of("CYCLE832(0.02,3,1)\nCYCLE832(0,0,1)\n"), kNoTolerance);
  EXPECT_EQ(of("CYCLE832(0.02,3,1)\nG60\n"), 0.0);
  EXPECT_EQ(of("G642 CTOL=0.03\n"), 0.03);
  EXPECT_EQ(of("G641 ADIS=0.03 ADISPOS=0.05\n"), 0.05);
  EXPECT_EQ(of("G64\n"), kNoTolerance);
  EXPECT_EQ(of("G641\n"), kNoTolerance);
}

// CYCLE832 states CTOL itself; CTOL behind it is the newer word, and G642 behind it rounds by what it stated.
TEST(SiemensState, TheLastOfCycle832AndCtolIsTheTolerance) {
  const auto of = [](const std::string& body) {
    const auto p = read(body + "G0 X9\n");
    EXPECT_EQ(faults(p), "") << body;
    return p.blocks[p.blocks.size() - 2].tolerance_mm;
  };
  EXPECT_EQ(of("CYCLE832(0.02,3,1)\nCTOL=0.5\n"), 0.5);
  EXPECT_EQ(of("CTOL=0.5\nCYCLE832(0.02,3,1)\n"), 0.02);
  EXPECT_EQ(of("CTOL=0.5\nCYCLE832(0.02,3,1)\nG642\n"), 0.02);
  EXPECT_EQ(of("CTOL=0.5\nCYCLE832(0,0,1)\nG642\n"), kNoTolerance);
  EXPECT_EQ(of("G642 CTOL=0.03\nCTOL=0.04\n"), 0.04);
  EXPECT_EQ(of("G60\nCTOL=0.04\n"), 0.0);  // nothing is rounded
  EXPECT_EQ(of("G642 CTOL=0.03\nCTOL=-1\n"), kNoTolerance);
}

TEST(SiemensState, OnlySupaLeavesNoShiftOnInAMoveOfTheMachine) {
  for (const char* body : {"G0 G53 Z0 D0\n", "G0 G153 Z0 D0\n"}) {
    const auto p = read(body);
    EXPECT_TRUE(finds(p, "CHK-MACHINE-MOVE")) << body;
    EXPECT_FALSE(p.blocks[p.blocks.size() - 2].machine_z) << body;
  }
}

TEST(SiemensText, ACycleHasOneName) {
  for (const char* body : {"F100\nCYCLE081(15,1,1,-8)\n", "F100\nCYCLE81.0(15,1,1,-8)\n"})
    EXPECT_FALSE(read(body).faults.empty()) << body;
}

TEST(SiemensText, AMessageIsTakenAwayByAnEmptyOne) {
  EXPECT_EQ(faults(read("MSG(\"wait\")\nM0\nMSG()\n")), "");
}

TEST(SiemensText, BlocksAreReadAsTheControlReadsThem) {
  // Small letters, =, block numbers, blanks, a comment with a quote, a text with a semicolon.
  EXPECT_EQ(faults(read("n10 g0 x=9 y6\nMSG(\"a;b\")\n  G0   X8\t;it's \"so\n/M1\nG4 F0.5\n")).substr(0, 3),
            "");
  EXPECT_EQ(moves(read("n10 g0 x=9 y6\nG4 F0.5\n")), (Moves{"R 9 6 20", "D 0.5"}));
  for (const char* body : {"G0 X\n", "G0 X5 X6\n", "G0 G1 X5\n", "MSG(\"a\n", "T=\"a\n", "G0 X1.2.3\n",
                           "+5\n", "G4 X5\n", "G4 F1 X5\n", "G0 X5 N10\n", "N1.5 G0 X5\n",
                           "N123456789 G0 X5\n", "F1000000\n", "%\n", "G0 Z5 A3\n", "M6 D1\n"})
    EXPECT_FALSE(read(body).faults.empty()) << body;
  // What stands in G4's F is no feed.
  const auto p = read("F100\nG4 F3\nG1 X9\n");
  EXPECT_EQ(p.blocks[p.blocks.size() - 2].feed_mm_min, 100.0);
}

TEST(SiemensText, MarkersStandBehindASemicolon) {
  const auto p = read(";CAPSTAN STEP id=\"a%20b\" n=2 tool=1 setup=1\nG0 X9\n");
  ASSERT_EQ(p.markers.size(), 1U);
  EXPECT_EQ(p.markers[0].id, "a b");
  EXPECT_EQ(p.blocks[p.blocks.size() - 2].marker, 0);
}

}  // namespace
}  // namespace capstan::verify::siemens
