#include "planner/proof/verify/program/heidenhain/reader.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "planner/ground/base/number.h"
#include "tests/proof/verify/plans.h"

// What a TNC makes of blocks, by its manuals (reader.h names them).

namespace capstan::verify::heidenhain {
namespace {

using Kind = Block::Kind;
using model::MoveKind;

model::Machine machine(std::vector<model::ControlOption> options = {}) {
  model::Machine m = testing::machine();
  m.control.dialect = "heidenhain";
  if (!options.empty()) m.control_options = model::ControlOptions{std::move(options)};
  return m;
}

constexpr const char* kStart =
    "BEGIN PGM A MM\nCYCL DEF 247 DATUM SETTING ~\n  Q339=+1 ;DATUM NUMBER\nTOOL CALL 1 Z S1000\nM3\n"
    "L X+5 Y+6 R0 FMAX\nL Z+20 R0 FMAX\n";
constexpr long kLinesOfStart = 7;

Program read(const std::string& body, const char* pecking_cycle = "tnc430") {
  return read_program(kStart + body + "M5\nM30\nEND PGM A MM\n", machine({{"pecking_cycle", pecking_cycle}}));
}

/// "R 5 6 2" for a rapid to X5 Y6 Z2, "L" a line, "A" an arc, "T" tapping, "D 0.5" a dwell; those behind the
/// start, rounded.
std::vector<std::string> moves(const Program& p) {
  std::vector<std::string> out;
  for (const Block& b : p.blocks) {
    if (b.line <= kLinesOfStart || (b.kind != Kind::kMove && b.kind != Kind::kDwell)) continue;
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
/// The last block but the end's.
const Block& last(const Program& p) { return p.blocks[p.blocks.size() - 2]; }

using Moves = std::vector<std::string>;

std::string drilling(const std::string& more = "") {
  return "CYCL DEF 200 DRILLING ~\n  Q200=+2 ;SET-UP CLEARANCE ~\n  Q201=-8 ;DEPTH ~\n  Q206=100 ;F ~\n"
         "  Q202=+8 ;PLUNGING DEPTH ~\n  Q210=+0 ;DWELL ~\n  Q203=+1 ;SURFACE ~\n  Q204=+15 ;2ND ~\n" +
         more + "  Q211=+0.5 ;DWELL\n";
}
std::string tapping(const std::string& pitch, const std::string& more = "") {
  return "CYCL DEF 207 RIGID TAPPING NEW ~\n  Q200=+2 ~\n  Q201=-8 ~\n  Q239=" + pitch + " ~\n  Q203=+1 ~\n" +
         more + "  Q204=+15\n";
}

// 200: by rapid to Q203 + Q200, at Q206 to Q203 + Q201, waits Q211, by rapid to Q203 + Q204.
TEST(HeidenhainCycles, ADrillingCycleRunsWhereItIsCalledAndNowhereElse) {
  const auto p = read(drilling() + "L X+10 R0 FMAX\nCYCL CALL\nL X+12 R0 FMAX M99\n");
  EXPECT_EQ(faults(p), "");
  EXPECT_EQ(moves(p), (Moves{"R 10 6 20", "R 10 6 3", "L 10 6 -7", "D 0.5", "R 10 6 16", "R 12 6 16",
                             "R 12 6 3", "L 12 6 -7", "D 0.5", "R 12 6 16"}));
  EXPECT_EQ(p.blocks[p.blocks.size() - 4].feed_mm_min, 100.0);
}

// 201: up at Q208, or at Q206 where that is 0, to Q203 + Q200.
TEST(HeidenhainCycles, AReamerComesOutAtItsFeed) {
  for (const auto& [out, feed] : {std::pair{"300", 300.0}, std::pair{"0", 100.0}}) {
    const auto p =
        read("CYCL DEF 201 REAMING ~\n  Q200=+2 ~\n  Q201=-8 ~\n  Q206=100 ~\n  Q211=+0 ~\n  Q208=" +
             std::string(out) + " ~\n  Q203=+1 ~\n  Q204=+15\nCYCL CALL\n");
    EXPECT_EQ(faults(p), "");
    EXPECT_EQ(moves(p), (Moves{"R 5 6 3", "L 5 6 -7", "L 5 6 3", "R 5 6 16"}));
    EXPECT_EQ(p.blocks[p.blocks.size() - 3].feed_mm_min, feed);
  }
}

std::string pecking(const std::string& cycle, const std::string& own) {
  return "CYCL DEF " + cycle +
         " ~\n  Q200=+2 ~\n  Q201=-20 ~\n  Q206=100 ~\n  Q202=+8 ~\n  Q203=+1 ~\n  Q204=+15 ~\n"
         "  Q212=+0 ~\n  Q205=+0 ~\n  Q211=+0.5 ~\n" +
         own + "\nCYCL CALL\n";
}
std::string replaced(std::string text, const std::string& from, const std::string& to) {
  return text.replace(text.find(from), from.size(), to);
}
constexpr const char* kOf203 = "  Q210=+0 ~\n  Q213=+4 ~\n  Q208= MAX ~\n  Q256=+0.3";
constexpr const char* kOf205 = "  Q258=+0.4 ~\n  Q259=+0.4 ~\n  Q257=+0 ~\n  Q256=+0.2";

// 203 with chips broken: Q202 from Q203 on, up by Q256 after each but the last, Q211 at the bottom, out at
// Q208. The last peck is what is left: "the depth does not have to be a multiple of the plunging depth".
TEST(HeidenhainCycles, UniversalDrillingBreaksTheChipByItsDistance) {
  const auto p = read(pecking("203 UNIVERSAL DRILLING", kOf203));
  EXPECT_EQ(faults(p), "");
  EXPECT_EQ(moves(p), (Moves{"R 5 6 3", "L 5 6 -7", "R 5 6 -6.7", "L 5 6 -15", "R 5 6 -14.7", "L 5 6 -19",
                             "D 0.5", "R 5 6 3", "R 5 6 16"}));
  // At a feed it comes out by feed; 0 is that of plunging.
  for (const auto& [out, feed] : {std::pair{"Q208=300", 300.0}, std::pair{"Q208=+0", 100.0}}) {
    const auto fed = read(replaced(pecking("203 UNIVERSAL DRILLING", kOf203), "Q208= MAX", out));
    EXPECT_EQ(faults(fed), "");
    const Block& up = fed.blocks[fed.blocks.size() - 3];
    EXPECT_EQ(up.move, MoveKind::kLine);
    EXPECT_EQ(up.feed_mm_min, feed);
  }
}

// 205: each plunge ends at Q203 + Q200 by rapid, and begins by rapid Q258 above the last bottom.
TEST(HeidenhainCycles, UniversalPeckingComesBackToAboveTheLastBottom) {
  const std::string start = " ~\n  Q379=+0 ~\n  Q253=750", out = start + " ~\n  Q208= MAX ~\n  Q395=+0";
  for (const auto& [version, more] : {std::pair{"tnc430", std::string()}, std::pair{"itnc530", start},
                                      std::pair{"tnc640", out}, std::pair{"explicit", out}}) {
    const auto p = read(pecking("205 UNIVERSAL PECKING", kOf205 + more), version);
    EXPECT_EQ(faults(p), "") << version;
    EXPECT_EQ(moves(p), (Moves{"R 5 6 3", "L 5 6 -7", "R 5 6 3", "R 5 6 -6.6", "L 5 6 -15", "R 5 6 3",
                               "R 5 6 -14.6", "L 5 6 -19", "D 0.5", "R 5 6 3", "R 5 6 16"}));
  }
  // A parameter that the control does not have, or one that it misses: what it does then is not known.
  for (const auto& [version, more] : {std::pair{"tnc430", start}, std::pair{"itnc530", std::string()},
                                      std::pair{"itnc530", out}, std::pair{"tnc640", start}})
    EXPECT_TRUE(finds(read(pecking("205 UNIVERSAL PECKING", kOf205 + more), version), "CHK-CYCLE"))
        << version;
  EXPECT_TRUE(finds(read(pecking("205 UNIVERSAL PECKING", kOf205 + start), "explicit"), "CHK-UNVERIFIABLE"));
}

// 202: the spindle stands on the way out, at Q208, and turns again behind the cycle.
TEST(HeidenhainCycles, BoringComesOutWithTheSpindleStoppedAndOverTheHole) {
  const std::string boring =
      "CYCL DEF 202 BORING ~\n  Q200=+2 ~\n  Q201=-8 ~\n  Q206=100 ~\n  Q211=+0.5 ~\n  Q208= MAX ~\n"
      "  Q203=+1 ~\n  Q204=+15 ~\n  Q214=+0 ~\n  Q336=+0\nCYCL CALL\nL X+9 R0 FMAX\n";
  const auto p = read(boring);
  EXPECT_EQ(faults(p), "");
  EXPECT_EQ(moves(p), (Moves{"R 5 6 3", "L 5 6 -7", "D 0.5", "R 5 6 3", "R 5 6 16", "R 9 6 16"}));
  std::vector<double> rpm;
  for (const Block& b : p.blocks) {
    if (b.line > kLinesOfStart && b.kind == Kind::kMove) rpm.push_back(b.spindle_rpm);
  }
  EXPECT_EQ(rpm, (std::vector<double>{1000, 1000, 0, 0, 1000}));
  EXPECT_TRUE(finds(read(replaced(boring, "Q214=+0", "Q214=+1")), "CHK-UNVERIFIABLE"));
  EXPECT_TRUE(finds(read(replaced(boring, "  Q336=+0", "  Q335=+0")), "CHK-UNVERIFIABLE"));
}

// Each plunge is less by Q212, and none is less than Q205.
TEST(HeidenhainCycles, PlungesBecomeLessByTheDecrement) {
  const auto p = read(replaced(replaced(pecking("205 UNIVERSAL PECKING", kOf205), "Q212=+0", "Q212=+3"),
                               "Q205=+0", "Q205=+4"));
  EXPECT_EQ(faults(p), "");
  std::vector<double> bottoms;
  for (const Block& b : p.blocks) {
    if (b.kind == Kind::kMove && b.move == MoveKind::kLine) bottoms.push_back(b.to.z);
  }
  EXPECT_EQ(bottoms, (std::vector<double>{-7, -12, -16, -19}));
}

TEST(HeidenhainCycles, PecksThatTheVersionsOfTheControlMakeOtherwiseAreNotFollowed) {
  const auto with = [](const char* cycle, const char* own, const std::string& from, const std::string& to) {
    return read(replaced(pecking(cycle, own), from, to));
  };
  // Cleared by 203, or after some breaks: from where it is fed again is each version's.
  for (const char* breaks : {"Q213=+0", "Q213=+2"})
    EXPECT_TRUE(finds(with("203 UNIVERSAL DRILLING", kOf203, "Q213=+4", breaks), "CHK-UNVERIFIABLE"));
  EXPECT_EQ(faults(with("203 UNIVERSAL DRILLING", kOf203, "Q213=+4", "Q213=+3")), "");
  EXPECT_TRUE(finds(with("205 UNIVERSAL PECKING", kOf205, "Q257=+0", "Q257=+3"), "CHK-UNVERIFIABLE"));
  EXPECT_TRUE(finds(with("205 UNIVERSAL PECKING", kOf205, "Q259=+0.4", "Q259=+1"), "CHK-UNVERIFIABLE"));
  const std::string deepened =
      pecking("205 UNIVERSAL PECKING", std::string(kOf205) + " ~\n  Q379=-5 ~\n  Q253=750");
  EXPECT_TRUE(finds(read(deepened, "itnc530"), "CHK-UNVERIFIABLE"));
  EXPECT_TRUE(finds(with("205 UNIVERSAL PECKING", kOf205, "Q202=+8", "Q202=+0"), "CHK-CYCLE"));
  EXPECT_TRUE(finds(with("205 UNIVERSAL PECKING", kOf205, "Q258=+0.4 ~\n  Q259=+0.4", "Q258=+0 ~\n  Q259=+0"),
                    "CHK-CYCLE"));
  EXPECT_TRUE(finds(with("205 UNIVERSAL PECKING", kOf205, "Q206=100", "Q206= MAX"), "CHK-UNVERIFIABLE"));
  EXPECT_TRUE(finds(with("205 UNIVERSAL PECKING", kOf205, "  Q212=+0 ~\n", ""), "CHK-CYCLE"));
}

// 207: Q239 with the sign of the thread; the spindle stands behind it.
TEST(HeidenhainCycles, TappingHoldsStepBothWaysAndStopsTheSpindle) {
  const auto p = read(tapping("+1.5") + "CYCL CALL\n");
  EXPECT_EQ(faults(p), "");
  EXPECT_EQ(moves(p), (Moves{"R 5 6 3", "T 5 6 -7", "T 5 6 3", "R 5 6 16"}));
  const Block &down = p.blocks[p.blocks.size() - 4], &up = p.blocks[p.blocks.size() - 3];
  EXPECT_EQ(down.spindle_rpm, 1000.0);
  EXPECT_EQ(down.pitch_mm, 1.5);
  EXPECT_EQ(down.feed_mm_min, 1500.0);
  EXPECT_EQ(up.spindle_rpm, -1000.0);
  EXPECT_EQ(last(p).spindle_rpm, 0.0);
  const auto left = read(tapping("-1.5") + "CYCL CALL\n");
  EXPECT_EQ(left.blocks[left.blocks.size() - 4].spindle_rpm, -1000.0);
}

// M3 acts before the block's move, M5 behind it: which of two holds is nowhere said.
TEST(HeidenhainBlocks, TwoMFunctionsOfOneKindInABlockAreAFault) {
  for (const char* m : {"M3 M4", "M3 M5", "M13 M4", "M8 M9", "M9 M7", "M13 M9", "M0 M1", "M0 M30"}) {
    EXPECT_TRUE(finds(read(std::string(m) + "\n"), "CHK-WORD")) << m;
    EXPECT_TRUE(finds(read("L X+6 R0 FMAX " + std::string(m) + "\n"), "CHK-WORD")) << m;
  }
  for (const char* m : {"M3 M8", "M3 M3", "M5 M9", "M7 M8", "M13", "M4 M7"})
    EXPECT_FALSE(finds(read(std::string(m) + "\n"), "CHK-WORD")) << m;
}

// 247 acts where it stands: the cycle that is defined stays so.
TEST(HeidenhainCycles, APresetLeavesTheCycleThatIsDefined) {
  const std::string preset = "CYCL DEF 247 DATUM SETTING ~\n  Q339=+1 ;DATUM NUMBER\n";
  const auto p = read(drilling() + preset + "CYCL CALL\n");
  EXPECT_EQ(faults(p), "");
  EXPECT_EQ(moves(p), (Moves{"R 5 6 3", "L 5 6 -7", "D 0.5", "R 5 6 16"}));
  EXPECT_TRUE(finds(read(drilling() + "CYCL DEF 203 UNIVERSAL DRILLING\nCYCL CALL\n"), "CHK-CYCLE"));
}

TEST(HeidenhainCycles, WhatWouldBreakTheToolOrIsNotFollowedIsAFault) {
  const auto edited = [](const std::string& from, const std::string& to) {
    std::string text = drilling();
    return read(text.replace(text.find(from), from.size(), to) + "CYCL CALL\n");
  };
  EXPECT_TRUE(finds(edited("Q201=-8", "Q201=+8"), "CHK-CYCLE"));
  EXPECT_TRUE(finds(edited("Q200=+2", "Q200=-2"), "CHK-CYCLE"));
  EXPECT_TRUE(finds(edited("Q203=+1", "Q203=+30"), "CHK-CYCLE"));  // begins above the tool
  EXPECT_TRUE(finds(edited("  Q203=+1 ;SURFACE ~\n", ""), "CHK-CYCLE"));
  EXPECT_TRUE(finds(edited("Q206=100", "Q206=+0"), "CHK-FEED"));
  EXPECT_TRUE(finds(edited("Q202=+8", "Q202=+3"), "CHK-UNVERIFIABLE"));  // pecks
  EXPECT_TRUE(finds(edited("Q206=100", "Q206=FMAX"), "CHK-UNVERIFIABLE"));
  EXPECT_TRUE(finds(edited("Q203=+1", "Q203=Q5"), "CHK-UNVERIFIABLE"));
  EXPECT_TRUE(finds(read(drilling("  Q395=+1 ~\n") + "CYCL CALL\n"), "CHK-UNVERIFIABLE"));
  EXPECT_TRUE(finds(read(drilling("  Q999=+1 ~\n") + "CYCL CALL\n"), "CHK-UNVERIFIABLE"));
  // Q403 is of cycle 209, Q0 of none.
  for (const char* other : {"  Q403=+1 ~\n", "  Q403=+2 ~\n", "  Q0=+1 ~\n"})
    EXPECT_TRUE(finds(read(tapping("+1.5", other) + "CYCL CALL\n"), "CHK-UNVERIFIABLE")) << other;
  EXPECT_TRUE(finds(read(drilling("  Q0=+1 ~\n") + "CYCL CALL\n"), "CHK-UNVERIFIABLE"));
  EXPECT_TRUE(finds(read(tapping("+0") + "CYCL CALL\n"), "CHK-TAP-FEED"));
  EXPECT_TRUE(finds(read("CYCL CALL\n"), "CHK-CYCLE"));
  EXPECT_TRUE(finds(read("L X+9 R0 FMAX M99\n"), "CHK-CYCLE"));
  for (const char* body : {"CYCL DEF 208 BORE MILLING\n",
                           "CYCL DEF 7.0 DATUM SHIFT\n",
                           "CYCL DEF 10.0 ROTATION\n",
                           "PLANE SPATIAL SPA+0 SPB+90 SPC+0 STAY\n",
                           "LBL 1\n",
                           "CALL PGM B\n",
                           "FN 0: Q5 = +3\n",
                           "Q5 = 3\n",
                           "RND R5\n",
                           "APPR LT X+5 Y+5 LEN10 RL F100\n",
                           "LN X+5 Y+5 Z+5 NX+1 NY+0 NZ+0\n",
                           "L X+Q5 R0 FMAX\n",
                           "L X+5 R0 F AUTO\n",
                           "L X+5 A+9 R0 FMAX\n",
                           "M6\n",
                           "M89\n",
                           "M128\n",
                           "TOOL CALL 2 Z S1000 DL+0.5\n",
                           "TOOL CALL \"D8\" Z S1000\n",
                           "TOOL DEF 2 L+5 R+3\n"})
    EXPECT_TRUE(finds(read(body), "CHK-UNVERIFIABLE") || finds(read(body), "CHK-CODE") ||
                finds(read(body), "CHK-NUMBER"))
        << body << faults(read(body));
}

TEST(HeidenhainArcs, TurnAboutTheirCentreAsDrSays) {
  const auto p = read("CC X+1 Y+6\nC X-3 Y+6 DR+ F100\nC X+5 Y+6 DR-\n");
  EXPECT_EQ(faults(p), "");
  EXPECT_EQ(moves(p), (Moves{"A -3 6 20", "A 5 6 20"}));
  EXPECT_EQ(last(p).move, MoveKind::kArcCw);
  EXPECT_EQ(last(p).centre.x, 1.0);
  EXPECT_TRUE(finds(read("C X-3 Y+6 DR+ F100\n"), "CHK-ARC"));               // no CC
  EXPECT_TRUE(finds(read("CC X+1 Y+6\nC X-3 Y+6 F100\n"), "CHK-ARC"));       // no DR
  EXPECT_TRUE(finds(read("CC IX+1 Y+6\nC X-3 Y+6 DR+ F100\n"), "CHK-ARC"));  // by increment
}

TEST(HeidenhainArcs, ByRadiusAreTheShorterWayAndBelowZeroTheLonger) {
  const auto shorter = read("CR X+1 Y+10 R+4 DR+ F100\n"), longer = read("CR X+1 Y+10 R-4 DR+ F100\n");
  ASSERT_EQ(faults(shorter) + faults(longer), "");
  EXPECT_NEAR(norm(last(shorter).centre - geometry::Vec2{1, 6}), 0.0, 1e-9);
  EXPECT_NEAR(norm(last(longer).centre - geometry::Vec2{5, 10}), 0.0, 1e-9);
}

// From (5, 6) about (1, 6): two turns and three quarters, 1.5 mm down with each half.
TEST(HeidenhainArcs, AHelixTurnsByItsAngleAndGoesDownInStep) {
  const auto p = read("CC X+1 Y+6\nCP IPA+990 IZ-8.25 DR+ F100\n");
  EXPECT_EQ(faults(p), "");
  EXPECT_EQ(moves(p),
            (Moves{"A -3 6 18.5", "A 5 6 17", "A -3 6 15.5", "A 5 6 14", "A -3 6 12.5", "A 1 2 11.75"}));
  EXPECT_EQ(moves(read("CC X+1 Y+6\nCP IPA-180 Z+19 DR- F100\n")), (Moves{"A -3 6 19"}));
  EXPECT_EQ(moves(read("CC X+1 Y+6\nCP IPA+540.01 IZ-3 DR+ F100\n")).size(), 3U);  // no fourth one
  EXPECT_TRUE(finds(read("CC X+1 Y+6\nCP IPA+180 IZ-1 DR- F100\n"), "CHK-ARC"));
  EXPECT_TRUE(finds(read("CC X+1 Y+6\nCP PA+180 IZ-1 DR+ F100\n"), "CHK-UNVERIFIABLE"));
}

// Helices beyond all bounds are not followed, however many they are: each of these turns by more than what a
// whole program may.
TEST(HeidenhainArcs, TurnsBeyondAllBoundsAreNotFollowed) {
  constexpr std::size_t kHelices = 4296;  // times the bound of half turns: more than an int holds
  std::string body = "CC X+1 Y+6\n";
  for (std::size_t i = 0; i < kHelices; ++i) body += "CP IPA+100000000 IZ-1 DR+ F100\n";
  const auto p = read(body);
  EXPECT_TRUE(finds(p, "CHK-TOO-LARGE"));
  EXPECT_LT(p.blocks.size(), kHelices + 10);
  EXPECT_TRUE(finds(read("CC X+1 Y+6\nCP IPA+100000 IZ-1 DR+ F100\n"), "CHK-WORD"));
  EXPECT_EQ(faults(read("CC X+1 Y+6\nCP IPA+99999.9999 IZ-1 DR+ F100\n")), "");
}

// FMAX holds for its block; behind it F is what it was.
TEST(HeidenhainState, FmaxIsOfItsBlockAndIncrementsOfTheirAxis) {
  const auto p = read("L X+9 R0 F100\nL IX+3 Z+15 R0 FMAX\nL Y+1\n");
  EXPECT_EQ(faults(p), "");
  EXPECT_EQ(moves(p), (Moves{"L 9 6 20", "R 12 6 15", "L 12 1 15"}));
  EXPECT_EQ(last(p).feed_mm_min, 100.0);
}

// M91 counts from the machine's datum without the tool's length.
TEST(HeidenhainState, M91SaysWhereTheAxisGoesInItsBlock) {
  const auto p = read("L Z+0 R0 FMAX M91\n");
  EXPECT_EQ(faults(p), "");
  EXPECT_TRUE(last(p).machine_z);
  EXPECT_FALSE(last(read("L Z+0 R0 FMAX M91\nL Z+10 R0 FMAX\n")).machine_z);
  EXPECT_FALSE(read("M91\n").faults.empty());
}

// An increment counts from the last place with M91, not from one of the work: Z+10 and IZ-10 are not Z0 of
// the machine.
TEST(HeidenhainState, AnIncrementWithM91IsNoPlaceOfTheMachine) {
  const auto p = read("L Z+10 R0 FMAX\nL IZ-10 R0 FMAX M91\n");
  EXPECT_TRUE(finds(p, "CHK-WORD")) << faults(p);
  EXPECT_FALSE(last(p).machine_z);
  EXPECT_TRUE(finds(read("L Z+0 IX+5 R0 FMAX M91\n"), "CHK-WORD"));
  EXPECT_TRUE(finds(read("L Z+0 M91 IX+5 R0 FMAX\n"), "CHK-WORD"));
}

// M0: "program STOP, spindle STOP, coolant OFF". STOP by itself leaves them.
TEST(HeidenhainState, M0StopsTheSpindleAndTheCoolantAndStopLeavesThem) {
  const auto behind = [](const std::string& stop) {
    return last(read("M8\nM7\n" + stop + "\nL X+9 R0 FMAX\n"));
  };
  for (const char* stop : {"M0", "STOP M0", "L X+7 R0 FMAX M0"}) {
    EXPECT_EQ(behind(stop).spindle_rpm, 0.0) << stop;
    EXPECT_FALSE(behind(stop).flood || behind(stop).mist) << stop;
    const auto p = read(std::string(stop) + "\n");
    EXPECT_EQ(p.stops.size(), 1U) << stop;
    EXPECT_EQ(p.stops[0].spindle_rpm, 1000.0) << stop;  // as it comes to the stop
  }
  EXPECT_EQ(behind("STOP").spindle_rpm, 1000.0);
  EXPECT_TRUE(behind("STOP").flood && behind("STOP").mist);
  EXPECT_EQ(read("STOP\n").stops.size(), 1U);
  EXPECT_EQ(behind("M0\nM3").spindle_rpm, 1000.0);
}

TEST(HeidenhainState, ToolCallChangesTheToolWithItsLengthOrStatesASpeed) {
  const auto p = read("TOOL CALL 7 Z S500\nTOOL CALL Z S600\nM3\nL X+9 R0 FMAX\n");
  EXPECT_EQ(faults(p), "");
  EXPECT_EQ(last(p).tool, 7);
  EXPECT_EQ(last(p).length_offset, 7);
  EXPECT_EQ(last(p).spindle_rpm, 600.0);
  EXPECT_FALSE(last(p).known_to[2]);
  const auto& before = p.blocks[p.blocks.size() - 3];
  EXPECT_EQ(before.kind, Kind::kToolChange);
  EXPECT_FALSE(read("TOOL CALL 7 S500\n").faults.empty());    // no axis
  EXPECT_FALSE(read("TOOL CALL 7 X S500\n").faults.empty());  // another one
  EXPECT_FALSE(read("TOOL CALL 7.5 Z S500\n").faults.empty());
  EXPECT_FALSE(read("TOOL CALL Z\n").faults.empty());
}

TEST(HeidenhainState, ToleranceIsThatOfCycle32) {
  const auto of = [](const std::string& body) { return last(read(body + "L X+9 R0 FMAX\n")).tolerance_mm; };
  EXPECT_EQ(of("CYCL DEF 32.0 TOLERANCE\nCYCL DEF 32.1 T0.02\nCYCL DEF 32.2 HSC-MODE:1 TA0.5\n"), 0.02);
  EXPECT_EQ(of("CYCL DEF 32.0 TOLERANCE\nCYCL DEF 32.1 T0.02\n"), 0.02);
  EXPECT_EQ(of("CYCL DEF 32.0 TOLERANCE\nCYCL DEF 32.1\n"), kNoTolerance);
  EXPECT_EQ(of(""), kNoTolerance);
  EXPECT_TRUE(finds(read("CYCL DEF 32.1 T0.02\n"), "CHK-UNVERIFIABLE"));
}

TEST(HeidenhainState, APresetIsTheWorkOffsetAndForgetsWhereTheToolIs) {
  const auto p = read("CYCL DEF 247 DATUM SETTING ~\n  Q339=+2 ;DATUM NUMBER\nL X+9 R0 FMAX\n");
  EXPECT_EQ(offset_name(last(p).work_offset), "PRESET2");
  EXPECT_FALSE(last(p).known_to[1]);
  EXPECT_TRUE(finds(read("CYCL DEF 247 DATUM SETTING ~\n  Q339=+0\n"), "CHK-WORK-OFFSET"));
}

TEST(HeidenhainText, BlocksAreReadAsTheControlReadsThem) {
  const std::string head =
      "0 BEGIN PGM A MM\n1 ; CAPSTAN STEP id=\"a%20b\" n=2 tool=1 setup=1\n2 * - a heading\n";
  const auto p =
      read_program(head +
                       "3 L  X+9\tY6.5 R0 FMAX ;over\n4 CYCL DEF 9.0 DWELL TIME\n5 CYCL DEF 9.1 DWELL 0.5\n"
                       "6 STOP\n7 M30\n8 END PGM A MM\n",
                   machine());
  EXPECT_EQ(faults(p), "");
  ASSERT_EQ(p.markers.size(), 1U);
  EXPECT_EQ(p.markers[0].id, "a b");
  ASSERT_EQ(p.blocks.size(), 4U);
  EXPECT_EQ(p.blocks[0].to.y, 6.5);
  EXPECT_EQ(p.blocks[1].dwell_s, 0.5);
  EXPECT_EQ(p.stops.size(), 1U);
  EXPECT_TRUE(p.ended);
}

TEST(HeidenhainText, AWordThatStandsTwiceInABlockIsAFault) {
  for (const char* body :
       {"L X+5 R0 RL FMAX\n", "L X+5 R0 R0 FMAX\n", "L X+5 R0 FMAX FMAX\n", "L X+5 R0 F100 F200\n",
        "L X+5 IX+6 R0 FMAX\n", "CC X+1 Y+6\nCP IPA+180 IPA+360 IZ-1 DR+ F100\n",
        "CR X+1 Y+10 R+4 R-4 DR+ F100\n", "CR X+1 Y+10 R+4 DR+ DR- F100\n", "TOOL CALL 7 Z Z S500\n",
        "TOOL CALL 7 Z S500 S600\n"})
    EXPECT_TRUE(finds(read(body), "CHK-WORD-TWICE")) << body << faults(read(body));
  EXPECT_EQ(faults(read("CR X+1 Y+10 R+4 DR+ R0 F100\n")), "");
}

TEST(HeidenhainText, WhatTheControlRefusesIsAFault) {
  for (const char* body : {"L X+5 X+6 R0 FMAX\n", "L X R0 FMAX\n", "L X+1.2.3 R0 FMAX\n", "L X+-5 R0 FMAX\n",
                           "L X+5 R0 F100 FMAX\n", "L X+5 R0 F100 F200\n", "L X+100000 R0 FMAX\n",
                           "TOOL CALL \"A\n", "BEGIN PGM A MM\n", "CYCL DEF 9.0 DWELL TIME\nL X+5 R0 FMAX\n",
                           "CYCL DEF 9.1 DWELL 1\n", "M5 X+5\n", "G0 X5\n", "N10 L X+5 R0 FMAX\n",
                           "L X+5 R0 FMAX DR+\n", "TOOL CALL 40000 Z S100\n", "TOOL CALL Z S200000\n"})
    EXPECT_FALSE(read(body).faults.empty()) << body;
  const auto whole = [](const std::string& text) { return read_program(text, machine()); };
  EXPECT_TRUE(finds(whole("BEGIN PGM A MM\nM30\n"), "CHK-END"));
  EXPECT_TRUE(finds(whole("BEGIN PGM A MM\nM30\nL X+5 R0 FMAX\nEND PGM A MM\n"), "CHK-END"));
  EXPECT_TRUE(finds(whole("BEGIN PGM A MM\nM30\nEND PGM B MM\n"), "CHK-SYNTAX"));
  EXPECT_TRUE(finds(whole("L X+5 R0 FMAX\nM30\nEND PGM A MM\n"), "CHK-SYNTAX"));
  EXPECT_TRUE(finds(whole("BEGIN PGM A INCH\nM30\nEND PGM A INCH\n"), "CHK-UNVERIFIABLE"));
  // A number that is missing says that a block is.
  EXPECT_TRUE(finds(whole("0 BEGIN PGM A MM\n2 M30\n3 END PGM A MM\n"), "CHK-SYNTAX"));
  EXPECT_TRUE(finds(whole("0 BEGIN PGM A MM\n1 M30\n2 END PGM A MM ~\n"), "CHK-SYNTAX"));
}

}  // namespace
}  // namespace capstan::verify::heidenhain
