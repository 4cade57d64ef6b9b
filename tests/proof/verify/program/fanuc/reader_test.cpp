#include "planner/proof/verify/program/fanuc/reader.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "tests/proof/verify/plans.h"

// What a FANUC and a Haas make of blocks, by their manuals: each test names the place.

namespace capstan::verify::fanuc {
namespace {

using Kind = Block::Kind;
using model::MoveKind;

model::Machine machine(const char* dialect, std::vector<model::ControlOption> options = {}) {
  model::Machine m = testing::machine();
  m.control.dialect = dialect;
  if (!options.empty()) m.control_options = model::ControlOptions{std::move(options)};
  return m;
}

constexpr const char* kStart =
    "%\nO1\nG21\nG17 G40 G80 G90 G94\nG54\nT1 M6\nS1000 M3\nG0 X5. Y6.\nG0 G43 H1 Z20.\n";

Program read(const std::string& body, const char* dialect = "fanuc",
             std::vector<model::ControlOption> options = {}) {
  return read_program(kStart + body + "M30\n%\n", machine(dialect, std::move(options)));
}

/// "R 5 6 2" for a rapid to X5 Y6 Z2, "L" a line, "D 0.5" a dwell; those behind the start.
std::vector<std::string> moves(const Program& p) {
  std::vector<std::string> out;
  for (const Block& b : p.blocks) {
    if (b.line <= 9 || (b.kind != Kind::kMove && b.kind != Kind::kDwell)) continue;
    const char* kind = b.kind == Kind::kDwell       ? "D "
                       : b.move == MoveKind::kRapid ? "R "
                       : b.synchronised             ? "T "
                                                    : "L ";
    out.push_back(kind + (b.kind == Kind::kDwell
                              ? shortest(b.dwell_s)
                              : shortest(b.to.x) + " " + shortest(b.to.y) + " " + shortest(b.to.z)));
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

// B-63944EN-2/02, 5.1.4 G81: positioning, rapid to R, feed to Z, rapid out.
TEST(FanucCycles, DrillingGoesByRapidToRAtFeedToZAndByRapidBackToTheInitialLevelOrToR) {
  const auto initial = read("G98 G81 X10. Y6. Z-8. R2. F100.\nX12.\nG80\n");
  EXPECT_EQ(faults(initial), "");
  EXPECT_EQ(moves(initial), (Moves{"R 10 6 20", "R 10 6 2", "L 10 6 -8", "R 10 6 20", "R 12 6 20", "R 12 6 2",
                                   "L 12 6 -8", "R 12 6 20"}));
  const auto to_r = read("G99 G81 X10. Y6. Z-8. R2. F100.\nX12.\nG80\n");
  EXPECT_EQ(moves(to_r),
            (Moves{"R 10 6 20", "R 10 6 2", "L 10 6 -8", "R 10 6 2", "R 12 6 2", "L 12 6 -8", "R 12 6 2"}));
}

// 5.1.5 G82 and 5.1.12 G89: P at the bottom; 5.1.9 G85: out at feed to R.
TEST(FanucCycles, WaitAtTheBottomAndComeOutAtFeedAsTheirCodesSay) {
  EXPECT_EQ(moves(read("G98 G82 X5. Y6. Z-8. R2. P500 F100.\nG80\n")),
            (Moves{"R 5 6 2", "L 5 6 -8", "D 0.5", "R 5 6 20"}));
  EXPECT_EQ(moves(read("G98 G85 X5. Y6. Z-8. R2. F100.\nG80\n")),
            (Moves{"R 5 6 2", "L 5 6 -8", "L 5 6 2", "R 5 6 20"}));
  EXPECT_EQ(moves(read("G98 G89 X5. Y6. Z-8. R2. P250 F100.\nG80\n")),
            (Moves{"R 5 6 2", "L 5 6 -8", "D 0.25", "L 5 6 2", "R 5 6 20"}));
}

// 5.1.6 G83: back to R after each Q, by rapid to d above where the last ended; 5.1.1 G73: d up.
TEST(FanucCycles, PeckByQFromRAndComeBackToDAboveTheLastBottom) {
  const std::vector<model::ControlOption> d = {{"peck_clearance_mm", "0.5"}, {"chip_break_mm", "0.3"}};
  EXPECT_EQ(moves(read("G98 G83 X5. Y6. Z-6. R2. Q4. F100.\nG80\n", "fanuc", d)),
            (Moves{"R 5 6 2", "L 5 6 -2", "R 5 6 2", "R 5 6 -1.5", "L 5 6 -6", "R 5 6 20"}));
  EXPECT_EQ(moves(read("G98 G73 X5. Y6. Z-6. R2. Q4. F100.\nG80\n", "fanuc", d)),
            (Moves{"R 5 6 2", "L 5 6 -2", "R 5 6 -1.7", "L 5 6 -6", "R 5 6 20"}));
}

// 9.9 mm in pecks of 3.3, and 14.4 in pecks of 4.8, are three each, whatever the sums round to.
TEST(FanucCycles, PecksThatDivideTheDepthAreNotOneMoreByRounding) {
  for (const char* hole : {"Z-7.9 R2. Q3.3", "Z-13.4 R1. Q4.8"}) {
    for (const char* mode : {"G83", "G73"}) {
      const auto all = moves(read("G98 " + std::string(mode) + " X5. Y6. " + hole + " F100.\nG80\n", "fanuc",
                                  {{"peck_clearance_mm", "0.5"}, {"chip_break_mm", "0.3"}}));
      EXPECT_EQ(std::count_if(all.begin(), all.end(), [](const auto& m) { return m.starts_with("L"); }), 3)
          << mode << " " << hole;
    }
  }
}

// Haas 96-8000, G83 and G73: the first pass cuts in by I, each succeeding one J less, the least is K; P waits
// behind the last one. Setting 22 is d of both.
TEST(FanucCycles, AHaasPecksByIThenLessByJAndNoLessThanK) {
  const std::vector<model::ControlOption> d = {{"peck_clearance_mm", "0.5"}};
  const auto deep = read("G98 G83 X5. Y6. Z-9. R2. I5. J2. K2. P0.4 F100.\nG80\n", "haas", d);
  EXPECT_EQ(faults(deep), "");
  // Pecks of 5, 3, 2 and the 1 that is left.
  EXPECT_EQ(moves(deep), (Moves{"R 5 6 2", "L 5 6 -3", "R 5 6 2", "R 5 6 -2.5", "L 5 6 -6", "R 5 6 2",
                                "R 5 6 -5.5", "L 5 6 -8", "R 5 6 2", "R 5 6 -7.5", "L 5 6 -9", "D 0.4",
                                "R 5 6 20"}));
  const auto chips = read("G98 G73 X5. Y6. Z-6. R2. I5. J2. K2. F100.\nG80\n", "haas", d);
  EXPECT_EQ(moves(chips), (Moves{"R 5 6 2", "L 5 6 -3", "R 5 6 -2.5", "L 5 6 -6", "R 5 6 20"}));
  EXPECT_TRUE(finds(read("G98 G73 X5. Y6. Z-6. R2. I5. J2. K2. Q3. F100.\nG80\n", "haas", d),
                    "CHK-UNVERIFIABLE"));
  EXPECT_TRUE(finds(read("G98 G83 X5. Y6. Z-6. R2. I5. J2. F100.\nG80\n", "haas", d), "CHK-CYCLE"));
  EXPECT_TRUE(finds(read("G98 G83 X5. Y6. Z-6. R2. I5. J2. K2 F100.\nG80\n", "haas", d), "CHK-POINT"));
  // Of a FANUC I and J are words of nothing, and K counts repeats.
  EXPECT_TRUE(finds(read("G98 G83 X5. Y6. Z-6. R2. I5. J2. K2 F100.\nG80\n", "fanuc", d), "CHK-WORD"));
}

// 5.1.10 G86: the spindle stops at the bottom.
TEST(FanucCycles, G86StopsTheSpindleBeforeItComesOut) {
  const auto p = read("G98 G86 X5. Y6. Z-8. R2. F100.\nG80\n");
  const auto out = std::find_if(p.blocks.begin(), p.blocks.end(), [](const Block& b) {
    return b.move == MoveKind::kRapid && b.from.z == -8.0;
  });
  ASSERT_NE(out, p.blocks.end());
  EXPECT_EQ(out->spindle_rpm, 0.0);
}

// 5.2.1 rigid tapping: F is the pitch in G95, F / S in G94; the spindle stands still behind it.
TEST(FanucCycles, RigidTappingHoldsThePitchOfFAndTurnsBack) {
  for (const char* body : {"G95\nM29 S400\nG98 G84 X5. Y6. Z-8. R5. F1.25\nG80\nG94\n",
                           "M29 S400\nG98 G84 X5. Y6. Z-8. R5. F500.\nG80\n"}) {
    const auto p = read(body);
    EXPECT_EQ(faults(p), "") << body;
    EXPECT_EQ(moves(p), (Moves{"R 5 6 5", "T 5 6 -8", "T 5 6 5", "R 5 6 20"})) << body;
    for (const Block& b : p.blocks) {
      if (!b.synchronised) continue;
      EXPECT_NEAR(b.pitch_mm, 1.25, 1e-12);
      EXPECT_EQ(b.spindle_rpm, b.to.z < b.from.z ? 400.0 : -400.0);
    }
    EXPECT_EQ(p.blocks.back().spindle_rpm, 0.0);
  }
}

TEST(FanucCycles, ATapWithoutM29IsNotHeldInStepOnAFanucAndIsOnAHaas) {
  EXPECT_TRUE(finds(read("G98 G84 X5. Y6. Z-8. R5. F1250.\nG80\n"), "CHK-TAP-FEED"));
  const auto haas = read("G98 G84 X5. Y6. Z-8. R5. F1250. J2\nG80\n", "haas");
  EXPECT_EQ(faults(haas), "");
  EXPECT_EQ(moves(haas), (Moves{"R 5 6 5", "T 5 6 -8", "T 5 6 5", "R 5 6 20"}));
}

TEST(FanucCycles, WhatNeedsTheMachineOrTheOperatorIsNotFollowed) {
  for (const char* code : {"G76", "G87", "G88"})
    EXPECT_TRUE(finds(read(std::string(code) + " X5. Y6. Z-8. R2. F100.\nG80\n"), "CHK-CYCLE")) << code;
}

// B-63944EN-2/02, 5.1: the data of a cycle are cancelled with it, by G80 or by a motion.
TEST(FanucCycles, TakeNoPeckAndNoDwellFromACycleThatWasCancelled) {
  for (const char* cancel : {"G80\n", "G0 X5.\n"}) {
    const std::string before = "G98 G83 X5. Y6. Z-6. R2. Q4. F100.\n" + std::string(cancel);
    EXPECT_TRUE(finds(read(before + "G98 G83 X9. Y6. Z-6. R2. F100.\nG80\n"), "CHK-CYCLE")) << cancel;
    const std::string waits = "G98 G82 X5. Y6. Z-8. R2. P500 F100.\n" + std::string(cancel);
    const auto second = moves(read(waits + "G98 G82 X5. Y6. Z-8. R2. F100.\nG80\n"));
    EXPECT_EQ(std::count(second.begin(), second.end(), "D 0.5"), 1) << cancel;
  }
  EXPECT_EQ(faults(read("G98 G83 X5. Y6. Z-6. R2. Q4. F100.\nX9.\nG80\n")), "");
}

// 5.1: "unless the block contains X, Y, Z, R or any additional axis, drilling is not performed".
TEST(FanucCycles, ABlockOfACycleWithRAloneIsAFaultForItDrillsOnSomeControls) {
  EXPECT_TRUE(finds(read("G98 G81 X5. Y6. Z-8. R2. F100.\nR5.\nG80\n"), "CHK-CYCLE"));
  EXPECT_TRUE(finds(read("G98 G81 R2. F100.\nX5. Y6. Z-8.\nG80\n"), "CHK-CYCLE"));
  EXPECT_FALSE(read("G98 G81 X5. Y6. Z-8. R2. F100.\nG4 R5. P100\nG80\n").faults.empty());
  EXPECT_EQ(faults(read("G98 G81 X5. Y6. Z-8. R2. F100.\nX9. R5.\nG80\n")), "");
}

// B-63844EN/02, 5.1: P counts milliseconds without a point; Haas: seconds with one.
TEST(FanucReader, WaitsAsLongAsTheControlOfTheMachineDoes) {
  EXPECT_EQ(moves(read("G4 P1500\n")), (Moves{"D 1.5"}));
  EXPECT_EQ(moves(read("G4 X1.5\n")), (Moves{"D 1.5"}));
  EXPECT_TRUE(finds(read("G4 P1.5\n"), "CHK-WORD"));
  EXPECT_EQ(moves(read("G4 P1.5\n", "haas")), (Moves{"D 1.5"}));
  EXPECT_EQ(moves(read("G4 P1500\n", "haas")), (Moves{"D 1.5"}));
}

// 3.3 Decimal point programming.
TEST(FanucReader, ALengthWithoutItsPointIsAFaultAndAFeedPerMinuteIsNone) {
  EXPECT_TRUE(finds(read("G0 X10\n"), "CHK-POINT"));
  EXPECT_TRUE(finds(read("G2 X7. Y6. I1 J0.\n"), "CHK-POINT"));
  EXPECT_FALSE(finds(read("G0 X0\n"), "CHK-POINT"));
  EXPECT_FALSE(finds(read("G1 X10. F100\n"), "CHK-POINT"));
  EXPECT_TRUE(finds(read("G1 X10. F100\n", "haas"), "CHK-POINT"));
}

// 14.1.1 and 14.1.2: G43 and G49 alone move Z; G53 and G28 take the offset away as Z moves.
TEST(FanucReader, LengthOffsetsMoveZWhereTheyStandAlone) {
  EXPECT_TRUE(finds(read("G43 H1\n"), "CHK-LENGTH-MOVE"));
  EXPECT_TRUE(finds(read("G49\n"), "CHK-LENGTH-MOVE"));
  EXPECT_FALSE(finds(read("G0 G49 G53 Z0.\n"), "CHK-LENGTH-MOVE"));
  EXPECT_FALSE(finds(read("G91 G28 Z0.\nG90 G49\n"), "CHK-LENGTH-MOVE"));
  for (const char* home : {"G0 G53 Z0.\nG1 Z-5. F100.\n", "G91 G28 Z0.\nG90 G1 Z-5. F100.\n"}) {
    const auto p = read(home);
    EXPECT_EQ(p.blocks[p.blocks.size() - 2].length_offset, -1) << home;
  }
}

// 6.1: G28 goes by way of the point that it names.
TEST(FanucReader, TheWayHomeGoesByItsIntermediatePoint) {
  const auto up = read("G91 G28 Z0.\nG90 G49\n");
  EXPECT_EQ(faults(up), "");
  EXPECT_TRUE(up.blocks[up.blocks.size() - 2].in_machine);
  EXPECT_TRUE(finds(read("G28 Z0.\n"), "CHK-MACHINE-MOVE"));
  EXPECT_EQ(moves(read("G28 Z0.\n")).front(), "R 5 6 0");
  EXPECT_TRUE(finds(read("G28\n"), "CHK-CODE"));
  EXPECT_TRUE(finds(read("G91 G28 X0. Y0.\nG90\n"), "CHK-MACHINE-MOVE"));
}

TEST(FanucReader, CornersAreRoundedByTheMachinesDataOrByG187) {
  const auto tolerance = [](const Program& p) { return p.blocks[p.blocks.size() - 2].tolerance_mm; };
  EXPECT_EQ(tolerance(read("G64\nG1 X9. F100.\n")), 0.01);
  EXPECT_EQ(tolerance(read("G61\nG1 X9. F100.\n")), 0.0);
  EXPECT_EQ(tolerance(read("G64\nG187 P3 E0.05\nG1 X9. F100.\n", "haas")), 0.05);
  EXPECT_TRUE(finds(read("G187 P3 E0.05\n"), "CHK-CODE"));
}

TEST(FanucReader, WorkOffsetsBeyondG59AreThoseThatTheMachineHas) {
  EXPECT_TRUE(finds(read("G54.1 P3\n"), "CHK-WORK-OFFSET"));
  const auto own = read("G54.1 P3\nG0 X1. Y1.\n", "fanuc", {{"extended_offsets", "48"}});
  EXPECT_EQ(faults(own), "");
  EXPECT_EQ(offset_name(own.blocks[own.blocks.size() - 2].work_offset), "G54.1P3");
  EXPECT_EQ(faults(read("G154 P99\nG0 X1. Y1.\n", "haas")), "");
  EXPECT_TRUE(finds(read("G154 P3\n"), "CHK-WORK-OFFSET"));
}

TEST(FanucReader, AStopThatMayBePassedOverStopsNobodyAndNoOtherBlockMay) {
  EXPECT_EQ(faults(read("/M0\nM1\n")), "");
  EXPECT_TRUE(read("/M0\nM1\n").stops.empty());
  EXPECT_EQ(read("M0\n").stops.size(), 1u);
  EXPECT_TRUE(finds(read("/G0 X1.\n"), "CHK-UNVERIFIABLE"));
}

TEST(FanucReader, WhatIsNotFollowedIsAFault) {
  for (const char* block : {"G92 X1.",
                            "G10 L2 P1 X1.",
                            "G52 X1.",
                            "G68 X0. Y0. R5.",
                            "G51 X0. Y0. P2",
                            "G30 Z0.",
                            "M98 P2",
                            "G65 P9000",
                            "#1=5",
                            "G1 X[1+2]",
                            "G0 A5.",
                            "g0 x1.",
                            "G0 X1. Q2.",
                            "G0 G1 X1. F100.",
                            "M3 M5",
                            "G18",
                            "O2",
                            "G0 X1.2.3",
                            "(A % B)",
                            "S100.5",
                            "G44 H1 Z5.",
                            "G20",
                            "G17 G21 X1."})
    EXPECT_FALSE(read(std::string(block) + "\n").faults.empty()) << block;
}

// FANUC B-63844EN/02, 13.3; Haas 96-8000, M98: a program of the control's list.
TEST(FanucReader, ASubprogramBehindTheEndIsRunByAFanucAndByNoHaas) {
  const std::string text = std::string(kStart) + "M98 P7001\nM30\nO7001\nG0 Z2.\nG0 Z20.\nM99\n%\n";
  EXPECT_EQ(faults(read_program(text, machine("fanuc"))), "");
  EXPECT_EQ(moves(read_program(text, machine("fanuc"))), (Moves{"R 5 6 2", "R 5 6 20"}));
  const Program haas = read_program(text, machine("haas"));
  const std::string at_call = "10 CHK-";
  EXPECT_NE(faults(haas).find(at_call), std::string::npos) << faults(haas);
  EXPECT_EQ(moves(haas).size(), 0u);
}

TEST(FanucReader, ABlockWithMoreCodesThanItKeepsIsAFault) {
  constexpr int kMostG = 32, kMostM = 16;  // BlockSaid
  const auto block = [](const char* code, int times) {
    std::string out;
    for (int i = 0; i < times; ++i) out += code;
    return out + "\n";
  };
  EXPECT_FALSE(finds(read(block("G90", kMostG)), "CHK-CODE"));
  EXPECT_TRUE(finds(read(block("G90", kMostG + 1)), "CHK-CODE"));
  EXPECT_FALSE(finds(read(block("M8", kMostM)), "CHK-CODE"));
  EXPECT_TRUE(finds(read(block("M8", kMostM + 1)), "CHK-CODE"));
}

// What the machine's file says that its control does not take: the writer refuses it, and programs are
// edited.
TEST(FanucReader, ACodeThatIsNotInTheMachinesListIsAFaultOnce) {
  const std::string listed = "G0 G01 G17 G21 G40 G43 G54 G80 G90 G94 M3 M06 M30";
  const auto program = [&](const std::string& codes) {
    return read("G1 X9. F100.\nM8\nM9\nM8\nG54.1 P1\n", "fanuc",
                {{"codes", codes}, {"extended_offsets", "48"}});
  };
  EXPECT_EQ(faults(program("")), "");
  EXPECT_EQ(faults(program(listed + " M8 M9 G54.1")), "");
  const auto p = program(listed);
  ASSERT_EQ(p.faults.size(), 3u) << faults(p);  // M8, M9 and G54.1
  for (const auto& f : p.faults) EXPECT_EQ(f.code, "CHK-CODE");
  EXPECT_NE(p.faults[0].message.find("no M8"), std::string::npos);
  EXPECT_NE(p.faults[2].message.find("no G54.1"), std::string::npos);
}

// 4.5: helical interpolation is an option.
TEST(FanucReader, AHelixIsAFaultWhereTheMachineHasNone) {
  const std::string helix = "G1 Z0. F100.\nG2 X7. Y6. Z-1. I1. J0.\n", level = "G2 X7. Y6. I1. J0. F100.\n";
  EXPECT_EQ(faults(read(helix)), "");
  EXPECT_TRUE(finds(read(helix, "fanuc", {{"helices", "no"}}), "CHK-ARC"));
  EXPECT_EQ(faults(read(level, "fanuc", {{"helices", "no"}})), "");
}

TEST(FanucReader, AnArcLargerThanTheMachineTakesIsAFault) {
  const std::string arc = "G2 X25. Y6. I10. J0. F100.\n";  // of radius 10 mm
  EXPECT_EQ(faults(read(arc, "fanuc", {{"largest_radius_mm", "10"}})), "");
  EXPECT_TRUE(finds(read(arc, "fanuc", {{"largest_radius_mm", "9.999"}}), "CHK-ARC"));
  const std::string huge = "G2 X15405. Y-15394. I0. J-15400. F100.\n";
  EXPECT_EQ(faults(read(huge, "haas")), "");
  EXPECT_TRUE(finds(read("G2 X15415. Y-15404. I0. J-15410. F100.\n", "haas"), "CHK-ARC"));
}

// From (5, 6): arcs about (6, 6), clockwise by way of (6, 7), and against it by way of (6, 5).
TEST(FanucReader, AnArcOverAQuadrantsEndIsAFaultWhereTheMachineStopsThere) {
  const std::vector<model::ControlOption> stops = {{"arcs", "quadrant"}};
  for (const char* within :
       {"G2 X6. Y7. I1. J0. F100.\nG2 X7. Y6. I0. J-1.\n", "G3 X6. Y5. I1. J0. F100.\nG3 X7. Y6. I0. J1.\n",
        "G2 X5.293 Y6.707 I1. J0. F100.\nG2 X6. Y7. I0.707 J-0.707\n"})
    EXPECT_EQ(faults(read(within, "fanuc", stops)), "") << within;
  for (const char* over :
       {"G2 X7. Y6. I1. J0. F100.\n", "G3 X7. Y6. I1. J0. F100.\n", "G2 X5. Y6. I1. J0. F100.\n",
        "G2 X6.707 Y6.707 I1. J0. F100.\n", "G3 X6.707 Y5.293 I1. J0. F100.\n"}) {
    EXPECT_TRUE(finds(read(over, "fanuc", stops), "CHK-ARC")) << over;
    EXPECT_EQ(faults(read(over)), "") << over;
  }
}

TEST(FanucReader, ABlockLongerThanTheMachineTakesIsAFaultAndItsCommentIsNotCounted) {
  const std::vector<model::ControlOption> least = {{"line_length", "72"}};
  const std::string block = "G1 X9. F100.";
  const std::string full = block + std::string(72 - block.size(), ' ');
  EXPECT_EQ(faults(read(full + "\n", "fanuc", least)), "");
  EXPECT_EQ(faults(read(full + "(" + std::string(80, 'A') + ")\r\n", "fanuc", least)), "");
  EXPECT_TRUE(finds(read(full + " \n", "fanuc", least), "CHK-SYNTAX"));
  EXPECT_EQ(faults(read(full + " \n")), "");
}

TEST(FanucReader, TheTapeBeginsAndEndsWithPercent) {
  EXPECT_EQ(faults(read("")), "");
  const model::Machine m = machine("fanuc");
  EXPECT_TRUE(finds(read_program("O1\nG21\nM30\n", m), "CHK-END"));
  EXPECT_TRUE(finds(read_program("%\nO1\nG21\nM30\n", m), "CHK-END"));
  EXPECT_TRUE(finds(read("%\nG0 X1.\n"), "CHK-END"));
}

TEST(FanucReader, ContourControlEndsBeforeCyclesToolsAndTheEnd) {
  EXPECT_EQ(faults(read("G5.1 Q1\nG1 X9. F100.\nG5.1 Q0\n")), "");
  EXPECT_TRUE(finds(read("G5.1 Q1\nG98 G81 X5. Y6. Z-8. R2. F100.\nG80\nG5.1 Q0\n"), "CHK-CYCLE"));
  EXPECT_TRUE(finds(read("G5.1 Q1\nT2 M6\n"), "CHK-SMOOTH"));
  EXPECT_TRUE(finds(read("G5.1 Q1\n"), "CHK-END"));
}

/// Faults and blocks are of lines that the text has, blocks stand in its order, and all numbers are finite.
bool all_in_place(const Program& p) {
  long before = 1;
  for (const Block& b : p.blocks) {
    if (b.line < before || b.line > p.lines) return false;
    before = b.line;
    for (const double v : {b.to.x, b.to.y, b.to.z, b.feed_mm_min, b.spindle_rpm, b.dwell_s})
      if (!std::isfinite(v)) return false;
  }
  return std::all_of(p.faults.begin(), p.faults.end(), [&](const auto& f) {
    return f.line >= 1 && f.line <= p.lines && !f.code.empty() && !f.message.empty();
  });
}

TEST(FanucReader, ReadsAnyBytesToTheirEndAndSaysWhatItDoesNotFollow) {
  constexpr int kTexts = 4000;
  const std::string whole =
      std::string(kStart) +
      "G98 G83 X5. Y6. Z-6. R2. Q4. F100.\nG80\nM29 S400\nG84 X5. Y6. Z-8. R5. F500.\nG80\n"
      "G2 X7. Y6. I1. J0.\nG0 Z20.\nG91 G28 Z0.\nG90 G49\nG4 P100\n(CAPSTAN STEP ID=\"<A>$20\" "
      "N=1)\nM30\n%\n";
  std::mt19937 random(3);
  const Program unspoilt = read_program(whole, machine("fanuc"));
  ASSERT_EQ(faults(unspoilt), "");
  const auto whole_moves = moves(unspoilt);
  int changed = 0, changed_unsaid = 0;
  for (int i = 0; i < kTexts; ++i) {
    std::string text = whole;
    for (int k = 0; k < 6; ++k) {
      const std::size_t at = random() % text.size();
      if (random() % 3 == 0) text.erase(at, 1 + random() % 3);
      text.insert(std::min(at, text.size()), 1, static_cast<char>(random() % 256));
    }
    const auto lines = std::count(text.begin(), text.end(), '\n') + (text.back() == '\n' ? 0 : 1);
    const Program p = read_program(text, machine(i % 2 == 0 ? "fanuc" : "haas"));
    ASSERT_EQ(p.lines, lines) << text;
    ASSERT_TRUE(all_in_place(p)) << text;
    if (i % 2 != 0 || moves(p) == whole_moves) continue;  // of Fanuc's: Haas has no M29
    ++changed;
    changed_unsaid += p.faults.empty() ? 1 : 0;
  }
  // Six bytes at random leave few programs that move otherwise and have no fault of their own.
  EXPECT_GT(changed, kTexts / 4);
  EXPECT_LT(changed_unsaid, changed / 10);
}

TEST(FanucComments, InCapitalsSayWhatTheySaidInSmallLetters) {
  EXPECT_EQ(plain_comment("CAPSTAN STEP ID=\"<FINISH>$20A$3C\" N=3 TOOL=2 SETUP=1"),
            "CAPSTAN STEP id=\"finish%20A%3C\" n=3 tool=2 setup=1");
  EXPECT_EQ(plain_comment("CAPSTAN TOOL T1 H1 LENGTH=50. DIAMETER=18. ID=\"<EM>18\" TWIST_DRILL"),
            "CAPSTAN TOOL T1 H1 length=50. diameter=18. id=\"em18\" twist_drill");
  EXPECT_EQ(plain_comment("CAPSTAN SETUP N=1 OFFSET=G54.1P2 SECURITY=20."),
            "CAPSTAN SETUP n=1 offset=G54.1P2 security=20.");
  EXPECT_EQ(plain_comment("MAKE IT SO"), "MAKE IT SO");
}

// 12.2: the slash of a block that may be skipped stands before its number.
TEST(FanucStops, OneThatMayBeSkippedMayHaveANumber) {
  EXPECT_EQ(faults(read("G0 G49 G53 Z0.\nM5\nM9\n/N40 M0\n", "fanuc", {{"prove_out", "skip_m0"}})), "");
  EXPECT_TRUE(finds(read("N40 /M0\n", "fanuc", {{"prove_out", "skip_m0"}}), "CHK-SYNTAX"));
}

TEST(FanucWords, NumbersThatNoControlTakesAreFaults) {
  for (const char* body : {"N123456 G0 X1.\n", "G1 X1. F250000.\n", "G0 X100000.\n", "S100000\n",
                           "G95\nG1 X1. F501.\n", "T123456789\n"})
    EXPECT_TRUE(finds(read(body), "CHK-WORD")) << body;
  EXPECT_EQ(faults(read("N99999 G1 X1. F240000.\n")), "");
}

}  // namespace
}  // namespace capstan::verify::fanuc
