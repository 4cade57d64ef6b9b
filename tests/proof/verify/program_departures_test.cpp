#include <gtest/gtest.h>

#include <algorithm>

#include "planner/proof/verify/program/linuxcnc/reader.h"
#include "planner/proof/verify/verify.h"
#include "tests/proof/verify/checked.h"
#include "tests/support/rs274.h"

// Departures of a program from its plan that once passed the check, each under its own name.

namespace capstan::verify {
namespace {

using testing::replaced;
using testing::told;

std::vector<model::Finding> check(const std::string& text, const model::Plan& plan, bool with_plan = true,
                                  const std::string& table = {}) {
  Job job;
  return check_program({"part.ngc", text, table.empty() ? testing::tool_table_of(plan) : table},
                       with_plan ? &plan : nullptr, plan.machine, plan.cutters, job);
}

bool refused(const std::vector<model::Finding>& findings) {
  return std::any_of(findings.begin(), findings.end(),
                     [](const auto& f) { return f.severity == Severity::kError; });
}

/// Pocket (T1), drilling (T2), reaming (T3); a wait of two seconds for the spindle; an arc and a helix at the
/// end of the pocket, above the work, and a dwell.
model::Plan full_plan() {
  auto k = testing::good_plan();
  testing::with_reamer(k, 300.0);
  k.plan.machine.spindle.spin_up_s = 2.0;
  testing::edit_path(k.plan, 0, [](auto& p) {
    p.arc({35, 55, 10}, {35, 45}, false, model::MoveRole::kLink);
    p.arc({35, 35, 8}, {35, 45}, false, model::MoveRole::kLink);
    p.dwell();
    p.rapid({35, 35, 10}, model::MoveRole::kRetract);
  });
  testing::edit_schedule(k.plan, 0, [](auto& s) {
    for (int i = 0; i < 4; ++i) {
      s.feed_mm_min.push_back(600);
      s.spindle_rpm.push_back(3000);
      s.dwell_s.push_back(i == 2 ? 0.5 : 0.0);
    }
  });
  return k.plan;
}

std::string full_program(const model::Plan& plan) {
  std::string out;
  const std::string text = testing::program_of(plan);
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = text.find('\n', at) + 1;
    out += text.substr(at, end - at);
    if (text.substr(at, end - at).find(" M3\n") != std::string::npos) out += "G4 P2\n";
    at = end;
  }
  return out;
}

TEST(Departures, TheProgramThatTheyArePlantedInIsRight) {
  const model::Plan plan = full_plan();
  const auto with = check(full_program(plan), plan);
  EXPECT_TRUE(with.empty()) << told(with);
  const auto alone = check(full_program(plan), plan, false);
  EXPECT_FALSE(refused(alone)) << told(alone);
}

struct Departure {
  const char* name;
  const char* from;
  const char* to;
  bool alone = false;  ///< dangerous in any program, so found without the plan
};
void PrintTo(const Departure& d, std::ostream* out) { *out << d.name; }

class DepartureInText : public ::testing::TestWithParam<Departure> {};

TEST_P(DepartureInText, IsAnError) {
  const Departure& d = GetParam();
  const model::Plan plan = full_plan();
  const std::string text = replaced(full_program(plan), d.from, d.to);
  ASSERT_FALSE(text.empty()) << "the program has no " << d.from;
  EXPECT_TRUE(refused(check(text, plan))) << "with the plan";
  if (d.alone) {
    EXPECT_TRUE(refused(check(text, plan, false))) << "alone";
  }
}

const Departure kDepartures[] = {
    {"AMachineRapidAcrossAtDepth", "G1 X65 Y65 Z-10 F600\n", "G1 X65 Y65 Z-10 F600\nG53 G0 X10 Y10\n", true},
    {"AMachineRapidDown", "G1 X65 Y65 Z-10 F600\n", "G1 X65 Y65 Z-10 F600\nG53 G0 Z-300\n", true},
    {"AMachineFeed", "G1 X65 Y65 Z-10 F600\n", "G1 X65 Y65 Z-10 F600\nG53 G1 Z-300\n", true},
    {"NoRetractBeforeALongerTool", "M5\nG53 G0 Z0\nT2 M6", "M5\nT2 M6", true},
    {"ARetractThatGoesDown", "G53 G0 Z0\nT2 M6", "G53 G0 Z-100\nT2 M6", true},
    {"AMoveBeforeTheUnit", "G21 G17 G90 G94 G40 G80 G49\n", "G17 G90 G94 G40 G80 G49\nG53 G0 Z0\n", true},
    {"NoFirstRetract", "G53 G0 Z0\nT1 M6", "T1 M6", true},
    {"ARapidDownBesideThePartAtTheEnd", "M5 M9\nG53", "G0 X-20\nG0 Z-40\nM5 M9\nG53"},
    {"ARapidDownAfterTheLastPath", "M5 M9\nG53", "G0 Z-40\nM5 M9\nG53"},
    {"APlungeInAHelix", "G3 X35 Y35 Z8", "G1 X35 Y55 Z-5\nG3 X35 Y35 Z8"},
    {"ATurnTooManyInAHelix", "G3 X35 Y35 Z8", "G3 X35 Y55 Z10 I0 J-10\nG3 X35 Y35 Z8"},
    {"AnArcAsALine", "G3 X35 Y55 Z10 I0 J10", "G1 X35 Y55 Z10"},
    {"ADwellWithWordsOfAxes", "G4 P2\n", "G4 P2 X5\n", true},
    {"ARotaryWord", "G1 X65 Y65 Z-10 F600\n", "G1 X65 Y65 Z-10 A30 F600\n", true},
    {"ASecondAxisWord", "G1 X65 Y65 Z-10 F600\n", "G1 X65 Y65 Z-10 W-30 F600\n", true},
    {"PointsLeftOut", "G64 P0.01", "G64 P0.01 Q5"},
    {"AWiderTolerance", "G64 P0.01", "G64 P0.05 Q5"},
    {"NoTolerance", "G64 P0.01", "G64"},
    {"NoWaitForTheSpindle", "S3000 M3\nG4 P2\n", "S3000 M3\n"},
    {"AShorterWaitForTheSpindle", "S3000 M3\nG4 P2\n", "S3000 M3\nG4 P0.2\n"},
    {"AWaitTooMany", "G1 X65 Y65 Z-10 F600\n", "G1 X65 Y65 Z-10 F600\nG4 P1\n"},
    {"APlannedWaitRemoved", "G4 P0.5\n", ""},
    {"APlannedWaitMadeLonger", "G4 P0.5\n", "G4 P5\n"},
    {"AnAbortInAComment", "G1 X65 Y65 Z-10 F600\n", "(ABORT,stop)\nG1 X65 Y65 Z-10 F600\n", true},
    {"AnAbortBesideAMove", "G1 X65 Y65 Z-10 F600\n", "G1 X65 Y65 Z-10 F600 (x) ( abort,)\n", true},
    {"AFileOpenedByAComment", "G1 X65 Y65 Z-10 F600\n", "(LOGOPEN,log.txt)\nG1 X65 Y65 Z-10 F600\n", true},
    {"APercentInTheMiddle", "G1 X65 Y65 Z-10 F600\n", "G1 X65 Y65 Z-10 F600\n%\n", true},
    {"AnotherDrillBeforeTheReamer", "T3 M6\nG43 H3", "T2 M6\nG43 H2"},
    {"ADrillInPlaceOfTheReamer", "M9\nM5\nG53 G0 Z0\nT3 M6\nG43 H3", "G43 H2"},
    {"AToolChangedForItself", "T2 M6\n", "T2 M6\nT2 M6\n"},
    {"CoolantOffInTheCut", "G0 X15 Y15\nM8", "G0 X15 Y15\nM9"},
    {"MistForFlood", "G0 X15 Y15\nM8", "G0 X15 Y15\nM7"},
    {"MistBesideFlood", "G0 X15 Y15\nM8", "G0 X15 Y15\nM8\nM7"},
    {"CoolantOnInAToolChange", "M9\nM5\nG53 G0 Z0\nT2", "M5\nG53 G0 Z0\nT2"},
    {"ABlockThatReturnsToAnEarlierPoint", "G1 X65 Y65 Z-10 F600\n",
     "G1 X65 Y65 Z-10 F600\nG1 X65 Y35 Z-10\nG1 X65 Y65 Z-10\n"},
    {"AnArcTwice", "G3 X35 Y55 Z10 I0 J10 F600\n", "G3 X35 Y55 Z10 I0 J10 F600\nG3 X35 Y55 Z10 I0 J10\n"},
    {"AStopInTheCut", "G1 X65 Y65 Z-10 F600\n", "G1 X65 Y65 Z-10 F600\nM0\n"},
    {"AnOptionalStop", "G1 X65 Y65 Z-10 F600\n", "G1 X65 Y65 Z-10 F600\nM1\n"},
    {"OverridesLocked", "G64 P0.01", "G64 P0.01\nM49"},
    {"ABlockThatMayBeSkipped", "G1 X65 Y65 Z-10 F600\n", "/G1 X65 Y65 Z-10 F600\n"},
    {"AFeedModeThatForgetsTheFeed", "G1 X65 Y65 Z-10 F600\n", "G94\nG1 X65 Y65 Z-10\n", true},
    {"AShiftOfTheWork", "G64 P0.01", "G64 P0.01\nG92 X5", true},
    {"AReferencePoint", "G1 X65 Y65 Z-10 F600\n", "G1 X65 Y65 Z-10 F600\nG28\n", true},
    {"NoLengthOffsetByH0", "G43 H2", "G43 H0", true},
};

INSTANTIATE_TEST_SUITE_P(Program, DepartureInText, ::testing::ValuesIn(kDepartures),
                         [](const auto& i) { return std::string(i.param.name); });

TEST(Departures, AToolTableThatTheControlReadsOtherwiseIsAnError) {
  const model::Plan plan = full_plan();
  const std::string table = testing::tool_table_of(plan);
  struct Row {
    const char* from;
    const char* to;
  };
  for (const Row& r : {Row{"Z+100.000000 ", ""},                // without length
                       {"Z+100.000000", "X+5.0 Z+100.000000"},  // the work shifted
                       {"Z+100.000000", "Z+100.000000e1"},      // ten times as long
                       {"T2 P2", "T2 P1"},                      // two tools in one pocket
                       {"T1 P1 ", "T1P1"},                      // nothing behind T1 is read
                       {"Z+100.000000", "Z 100.000000"},        // the line is dropped
                       {"Z+100.000000", "Z+100,000000"},        // the same as 100, by luck
                       {"Z+100.000000", "Z+100.000000 U2"},     // an axis that is not there
                       {"T1 P1", "T1\tP1"}}) {
    const std::string wrong = replaced(table, r.from, r.to);
    ASSERT_FALSE(wrong.empty()) << r.from;
    EXPECT_TRUE(refused(check(full_program(plan), plan, true, wrong))) << r.to << " with the plan";
    EXPECT_TRUE(refused(check(full_program(plan), plan, false, wrong))) << r.to << " alone";
  }
  EXPECT_FALSE(refused(check(full_program(plan), plan, true, replaced(table, "Z+100.000000", "z1.0E2 X0"))))
      << "the same length, written otherwise";
}

TEST(Departures, WhatSaysTheSameInOtherWordsIsNone) {
  const model::Plan plan = full_plan();
  const std::string text = full_program(plan);
  struct Same {
    const char* from;
    const char* to;
  };
  for (const Same& s : {Same{"G1 X65 Y65 Z-10 F600\n", "N10 G1 X65 Y65 Z-10 F600\n"},
                        {"G1 X65 Y65 Z-10 F600\n", "(here) G01 x+65.0 y65. z-10.0000 f600 ; there\n"},
                        {"G1 X65 Y65 Z-10 F600\n", "  X 65   Y65 Z - 10\n\n"},
                        {"G1 X65 Y65 Z-10 F600\n", "G1 X65 Y65 Z-10 F600\nG1 X65 Y65 Z-10 F600\n"},
                        {"G1 X65 Y65 Z-10 F600\n", "G1 X65 Y65 Z-10 F600 M8 S3000\n"},
                        {"G54\n", "G54\nG54\nG90 G21\n"},
                        {"G0 X15 Y15\n", "G0 X15\nG0 Y15\n"}}) {
    const std::string same = replaced(text, s.from, s.to);
    ASSERT_FALSE(same.empty()) << s.from;
    const auto with = check(same, plan);
    EXPECT_TRUE(with.empty()) << s.to << told(with);
    EXPECT_FALSE(refused(check(same, plan, false))) << s.to;
  }
}

TEST(Departures, WhatLinuxCncRefusesIsAnError) {
  CAPSTAN_NEEDS_RS274();
  const model::Plan plan = testing::good_plan().plan;
  const std::string begin = "G21 G17 G90 G94 G40 G80 G49\nG54\nF100 S100 M3\nG0 X0 Y0 Z5\n";
  for (const std::string block : {"G0 X1 )",
                                  "G0 X1 M3 M7 M0 M48 M6",
                                  "N5 N6 G0 X1",
                                  "G0 X1 N5",
                                  "N5/G0 X1",
                                  "G0 X1Y",
                                  "G1 X1 S-1",
                                  "G1 X1 F-1",
                                  "G81 X1 Y1 Z-1 R1 L1.5",
                                  "G81 X1 Y1 Z-1 R1 L-1",
                                  "G81 X1 Y1 Z-1 R1 L0",
                                  "G0 X1 L1",
                                  "G12",
                                  "M10",
                                  "G4 P1 G53",
                                  "G0 X1,5",
                                  "M3.5",
                                  "G0 X1 Y1 X2",
                                  "T1 T2",
                                  "G93 G1 X1",
                                  "G17 G18",
                                  "G3 X1 Y1 R-0.1",
                                  "G3",
                                  "G0 X1 W3",
                                  "G0 X1 U3",
                                  "$ G0 X1",
                                  "G0 X1 D2",
                                  "G0 X1 Q2",
                                  "G0 X1 I2",
                                  "G0 X1 R2",
                                  "G0 X1 H2",
                                  "G0 X1 K2",
                                  "G0 X1 E2",
                                  "G0 X1 P2",
                                  "G0 X1 /",
                                  "G59.4",
                                  "M5 M5",
                                  "M7 M8",
                                  "G0 G0 X1",
                                  "G0 G1 X1",
                                  "G83 X1 Z-1 R1",
                                  "G82 X1 Z-1 R1",
                                  "G0 X1 ((",
                                  "G0 X1 (a (b) c)",
                                  "G91 G53 G0 Z5",
                                  "G0 X1.2.3",
                                  "G80 X1",
                                  "G0 X1e2",
                                  "T1.5",
                                  "G1.05 X1",
                                  "G21 G20"}) {
    const auto run = capstan::testing::run_rs274("T1 P1 Z0\n", begin + block + "\nM2\n");
    const bool ended = run.output.find("PROGRAM_END()") != std::string::npos;
    EXPECT_FALSE(ended) << block << ": LinuxCNC takes it\n" << run.output;
    const Program read = linuxcnc::read_program(begin + block + "\nM2\n");
    EXPECT_TRUE(std::any_of(read.faults.begin(), read.faults.end(), [](const auto& f) {
      return !f.undecided;
    })) << block;
  }
}

// As rs274 takes them: blanks before the name, any case, the last comment of a line; not behind a semicolon.
TEST(Departures, OnlyACommentThatLinuxCncCarriesOutIsACommand) {
  const auto faults = [](const std::string& line) {
    return linuxcnc::read_program("G21\n" + line + "\nM2\n").faults.size();
  };
  for (const char* command :
       {"(ABORT,stop)", "( abort,stop)", "(ABORT,)", "G4 P0 (ABORT,x)", "(x)(ABORT,stop)",
        "(LogAppend,/tmp/l)", "(PY,x=1)", ";py,x=1", "(PYRELOAD)", "(PROBEOPEN points.txt)"})
    EXPECT_EQ(faults(command), 1U) << command;
  for (const char* words : {"(abort)", "( abort , stop)", "(ABORT stop)", "(ABORT,stop)(x)", ";ABORT,stop",
                            "(MSG,hello)", "(DEBUG,x)", "(PRINT,x)", "(LOG,x)", "(LOGCLOSE)", "(PROBECLOSE)"})
    EXPECT_EQ(faults(words), 0U) << words;
}

TEST(Departures, AProgramWithoutMarkersIsToldOnceThatItCannotBeHeldAgainstItsPlan) {
  const model::Plan plan = full_plan();
  std::string text = full_program(plan);
  for (std::size_t at = text.find("(CAPSTAN STEP"); at != std::string::npos; at = text.find("(CAPSTAN STEP"))
    text.erase(at, text.find('\n', at) + 1 - at);
  const auto found = check(text, plan);
  EXPECT_TRUE(refused(found));
  EXPECT_EQ(
      std::count_if(found.begin(), found.end(), [](const auto& f) { return f.severity == Severity::kError; }),
      1)
      << told(found);
}

TEST(Departures, AProgramWithNeitherPlanNorTableIsHeldAgainstTheToolsOfItsHeader) {
  const model::Plan plan = testing::good_plan().plan;
  const auto found = [&](const std::string& text) {
    Job job;
    return check_program({"part.ngc", text, ""}, nullptr, plan.machine, {}, job);
  };
  const std::string text = testing::program_of(plan);
  const auto missing = found(text);
  EXPECT_EQ(std::count_if(missing.begin(), missing.end(),
                          [](const auto& f) { return f.severity == Severity::kError; }),
            1)
      << told(missing);
  EXPECT_NE(told(missing).find("no tool table is at hand"), std::string::npos) << told(missing);
  const std::string named = replaced(text, "(a part)\n",
                                     "(CAPSTAN TOOL T1 H1 length=100 diameter=10 id=\"em10\" endmill)\n"
                                     "(CAPSTAN TOOL T2 H2 length=130 diameter=8 id=\"d8\" twist_drill)\n");
  EXPECT_FALSE(refused(found(named))) << told(found(named));
  EXPECT_TRUE(refused(found(replaced(replaced(named, "T2 M6", "T7 M6"), "G43 H2", "G43 H7"))));
}

TEST(Departures, ALineLongerThanLinuxCncReadsIsAnError) {
  const auto with_comment = [](std::size_t length) {
    return "G21\n(" + std::string(length - 2, 'a') + ")\nM2\n";
  };
  EXPECT_TRUE(linuxcnc::read_program(with_comment(252)).faults.empty());
  EXPECT_EQ(linuxcnc::read_program(with_comment(253)).faults.size(), 1U);
  CAPSTAN_NEEDS_RS274();
  EXPECT_NE(capstan::testing::run_rs274("T1 P1 Z0\n", with_comment(252)).output.find("PROGRAM_END()"),
            std::string::npos);
  EXPECT_EQ(capstan::testing::run_rs274("T1 P1 Z0\n", with_comment(253)).output.find("PROGRAM_END()"),
            std::string::npos);
}

TEST(Departures, AThousandRepeatsOfAPeckCycleAreBounded) {
  std::string text =
      "G21 G17 G90 G94 G40 G80\nG54\nG53 G0 Z0\nT2 M6\nG43 H2\nS1500 M3\nG0 X15 Y15\nG0 Z5\nF225\n";
  for (int i = 0; i < 1500; ++i) text += "G83 X" + std::to_string(i % 90) + " Y15 Z-20 R2 Q0.01 L1000\n";
  const Program read = linuxcnc::read_program(text + "G80\nM5\nG53 G0 Z0\nM2\n");
  EXPECT_LE(read.blocks.size(), kCycleBlockCap + 100);
  EXPECT_TRUE(std::any_of(read.faults.begin(), read.faults.end(),
                          [](const auto& f) { return f.code == "CHK-TOO-LARGE" && !f.undecided; }));
}

}  // namespace
}  // namespace capstan::verify
