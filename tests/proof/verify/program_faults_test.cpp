#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <optional>

#include "planner/proof/verify/verify.h"
#include "tests/proof/verify/checked.h"

namespace capstan::verify {
namespace {

using testing::PlanMaker;
using testing::replaced;
using testing::told;

long line_of(const std::string& text, const std::string& part) {
  return 1 + std::count(text.begin(), text.begin() + static_cast<long>(text.find(part)), '\n');
}

std::vector<model::Finding> check(const std::string& text, const model::Plan& plan, bool with_plan = true,
                                  const std::string& table = {}) {
  Job job;
  auto out =
      check_program({"part.ngc", text, table}, with_plan ? &plan : nullptr, plan.machine, plan.cutters, job);
  // That a program alone is not held against all is always noted.
  std::erase_if(out, [](const auto& f) { return f.code == "CHK-NOT-JUDGED"; });
  return out;
}

/// The good plan with an arc at its end, above the work, so that arcs are read back, too.
model::Plan plan_with_arc() {
  PlanMaker k = testing::good_plan();
  testing::edit_path(k.plan, 0, [](auto& p) {
    p.arc({35, 55, 10}, {35, 45}, false, model::MoveRole::kLink);
  });
  testing::edit_schedule(k.plan, 0, [](auto& s) {
    s.feed_mm_min.push_back(600);
    s.spindle_rpm.push_back(3000);
    s.dwell_s.push_back(0);
  });
  return k.plan;
}

TEST(CheckProgram, AProgramThatIsRightHasNoFindingWithItsPlan) {
  const model::Plan plan = plan_with_arc();
  const auto findings = check(testing::program_of(plan), plan, true, testing::tool_table_of(plan));
  EXPECT_TRUE(findings.empty()) << told(findings);
}

TEST(CheckProgram, AProgramThatIsRightHasNoFindingAlone) {
  const model::Plan plan = plan_with_arc();
  const auto findings = check(testing::program_of(plan), plan, false, testing::tool_table_of(plan));
  EXPECT_TRUE(findings.empty()) << told(findings);
}

TEST(CheckProgram, APlainProgramByHandWithoutMarkersHasNoFinding) {
  const std::string text =
      "G21 G17 G90 G94 G40 G80\nG54\nG53 G0 Z0\nT2 M6\nG43 H2\nS1500 M3\nG0 X15 Y15\nG0 Z5\n"
      "G98 G83 X15 Y15 Z-20 R2 Q5 F225\nX30\nG80\nM5\nG53 G0 Z0\nM2\n";
  const auto findings = check(text, testing::good_plan().plan, false);
  EXPECT_TRUE(findings.empty()) << told(findings);
}

struct TextFault {
  const char* name;
  int property;
  const char* from;  ///< text that is replaced, once
  const char* to;
  bool alone = true;  ///< also found without the plan
};
void PrintTo(const TextFault& f, std::ostream* out) { *out << f.name; }

class PlantedInText : public ::testing::TestWithParam<TextFault> {};

TEST_P(PlantedInText, IsFound) {
  const TextFault& f = GetParam();
  const model::Plan plan = plan_with_arc();
  const std::string text = replaced(testing::program_of(plan), f.from, f.to);
  ASSERT_FALSE(text.empty()) << "the program has no " << f.from;
  const auto found = [&](const auto& findings) {
    return std::any_of(findings.begin(), findings.end(), [&](const auto& x) {
      return x.property == f.property && x.severity == Severity::kError;
    });
  };
  EXPECT_TRUE(found(check(text, plan))) << told(check(text, plan));
  if (f.alone) {
    EXPECT_TRUE(found(check(text, plan, false))) << told(check(text, plan, false));
  }
}

const TextFault kFaults[] = {
    {"NumberMissing", 1, "G0 X35 Y35 Z10", "G0 Xnan Y35 Z10"},
    {"UnitSwitched", 2, "G64 P0.01", "G20"},
    {"UnitNeverStated", 2, "G21 G17 G90 G94 G40 G80 G49\n(CAPSTAN STEP id=\"pocket\" n=1)\nG21", "\n"},
    {"OffsetNeverStated", 3, "G54\n", "\n"},
    {"ToolNotInTheLibrary", 4, "T1 M6", "T7 M6"},
    {"ToolBeyondTheMagazine", 4, "T1 M6", "T21 M6"},
    {"LengthOffsetOfAnotherTool", 5, "G43 H1", "G43 H2"},
    {"RadiusOffsetOfAnotherTool", 5, "G0 X50 Y50\n", "G41 D2 G0 X50 Y50\n"},
    {"ToolChangeWithTheSpindleOn", 7, "M5\nG53 G0 Z0\nT2 M6", "G53 G0 Z0\nT2 M6"},
    {"ToolChangeInTheWork", 7, "M5\nG53 G0 Z0\nT2 M6", "M5\nG0 Z1\nT2 M6"},
    {"NoLengthOffset", 8, "G43 H1\n", "\n"},
    {"RapidThroughMaterial", 9, "G0 X35 Y35 Z10\n", "G0 X10 Y35 Z-5\nG0 X35 Y35 Z10\n", false},
    {"RapidDownIntoMaterial", 10, "G0 X15 Y15 Z2", "G0 X15 Y15 Z-2", false},
    {"Gouge", 11, "G1 X65 Y35 Z-10", "G1 X66 Y35 Z-10", false},
    {"TipTooDeep", 13, "X15 Y15 Z-22.4034", "X15 Y15 Z-55", false},
    {"NoSpindle", 15, "S1500 M3", "S1500", false},
    {"SpindleBackwards", 15, "S1500 M3", "S1500 M4", false},
    {"SpindleTooFast", 16, "S1500 M3", "S999999 M3"},
    {"DrillFeed", 18, "F225", "F3000", false},
    {"FeedBeyondTheAxis", 18, "F225", "F60000"},
    {"FeedNeverStated", 18, " F600", ""},
    {"MachineCoordinateOutsideTheTravel", 22, "M5 M9\nG53 G0 Z0", "M5 M9\nG53 G0 Z25"},
    {"ArcRadiiDisagree", 23, "I0 J10", "I0 J10.05"},
    {"ArcWithoutACentre", 23, " I0 J10", ""},
    {"ArcThatIsNothing", 24, "G3 X35 Y55 Z10 I0 J10", "G3 X35.0005 Y35 Z10 I0 J10"},
    {"PeckZero", 26, "G1 X15 Y15 Z-22.4034 F225", "G83 X15 Y15 Z-22.4034 R2 Q0 F225"},
    {"RBelowTheBottom", 26, "G1 X15 Y15 Z-22.4034 F225", "G81 X15 Y15 Z-22.4034 R-30 F225"},
    {"CycleNotCancelled", 26, "M5 M9\nG53 G0 Z0", "G81 X15 Y15 Z1 R2 F225\nM5 M9"},
    {"StepWithoutItsModalState", 27, "n=2)\nG21 G17 G90 G94 G40 G80", "n=2)"},
    {"StepWithoutItsSpeed", 27, "S1500 M3", "M3"},
    {"NoEnd", 32, "M30\n", "\n"},
    {"EndsTurning", 32, "M5 M9\nG53", "M9\nG53"},
    {"EndsInTheWork", 32, "M5 M9\nG53 G0 Z0", "M5 M9\nG0 Z1"},
    {"AnotherCoordinate", 33, "G1 X65 Y65 Z-5", "G1 X65.001 Y65 Z-5", false},
    {"AnotherFeed", 33, "F225", "F226", false},
    {"AnotherSpeed", 33, "S1500", "S1600", false},
    {"AMoveLost", 33, "G1 X65 Y65 Z-10 F600\n", "", false},
    {"AStepOfAnotherPlan", 33, "id=\"drill\"", "id=\"bore\"", false},
};

INSTANTIATE_TEST_SUITE_P(Program, PlantedInText, ::testing::ValuesIn(kFaults),
                         [](const auto& i) { return std::string(i.param.name); });

TEST(CheckProgram, AReversedSpindleIsFoundWithoutAPlan) {
  const model::Plan plan = plan_with_arc();
  std::string text = testing::program_of(plan);
  for (std::size_t at = text.find(" M3"); at != std::string::npos; at = text.find(" M3", at))
    text[at + 2] = '4';
  const auto findings = check(text, plan, false);
  ASSERT_FALSE(findings.empty());
  for (const auto& f : findings) {
    EXPECT_EQ(f.property, 15) << told(findings);
    EXPECT_EQ(f.severity, Severity::kError);
  }
}

TEST(CheckProgram, NamesTheLine) {
  const model::Plan plan = testing::good_plan().plan;
  const std::string text = replaced(testing::program_of(plan), "F225", "F60000");
  const auto findings = check(text, plan, false);
  ASSERT_EQ(findings.size(), 1U) << told(findings);
  EXPECT_EQ(findings[0].code, "CHK-FEED-AXIS");
  EXPECT_EQ(findings[0].step, "drill");
  EXPECT_EQ(findings[0].move, line_of(text, "F60000"));
}

struct TableFault {
  int property;
  const char* from;
  const char* to;
};

TEST(CheckProgram, AToolTableThatDoesNotFitTheToolsIsFound) {
  const model::Plan plan = testing::good_plan().plan;
  const std::string text = testing::program_of(plan);
  const std::string table = testing::tool_table_of(plan);
  for (const TableFault& f : {TableFault{4, "T2 P2", "T9 P9"},
                              {5, "T2 P2", "T1 P1"},
                              {6, "Z+100.000000", "Z+2540.0"},
                              {6, "Z+130.000000", "Z+5.11811"},
                              {6, "D+8.0", "D+9.0"},
                              {6, "Z+100.000000", "Z+Q"}}) {
    const std::string wrong = replaced(table, f.from, f.to);
    ASSERT_FALSE(wrong.empty());
    const auto findings = check(text, plan, false, wrong);
    EXPECT_TRUE(std::any_of(findings.begin(), findings.end(),
                            [&](const auto& x) { return x.property == f.property; }))
        << f.to << "\n"
        << told(findings);
  }
}

/// What a check of a program and a table alone finds in the lengths of the table's tools.
std::vector<std::string> unmeasured(const std::string& table, std::optional<bool> reference = {}) {
  model::Plan plan = testing::good_plan().plan;
  plan.machine.control.offsets_against_reference = reference;
  for (auto& c : plan.cutters) c.functional_length_mm = 0.0;  // nobody else knows them
  std::vector<std::string> out;
  for (const auto& f : check(testing::program_of(plan), plan, false, table)) {
    if (f.code != "CHK-TOOL-OFFSET" || f.severity != Severity::kError || f.property != 6) continue;
    for (std::size_t at = 0; (at = f.message.find(" has Z", at)) != std::string::npos; ++at)
      out.push_back(f.message.substr(at - 2, 2));
  }
  return out;
}

TEST(CheckProgram, ALengthOfZeroInTheTableIsFoundWhateverTheHeaderSays) {
  using Tools = std::vector<std::string>;
  EXPECT_EQ(unmeasured("T1 P1 Z+0 D+10\nT2 P2 Z+130 D+8\n"), Tools{"T1"});
  EXPECT_EQ(unmeasured("T1 P1 Z+0 D+10\nT2 P2 Z+0 D+8\n"), (Tools{"T1", "T2"}));
  EXPECT_EQ(unmeasured("T1 P1 Z+100 D+10\nT2 P2 Z+130 D+8\n"), Tools{});
}

TEST(CheckProgram, ALengthShorterThanTheToolsFlutesIsFound) {
  // The flutes of T1 are 22 mm long: 20 mm from the gage line would end inside them.
  ASSERT_EQ(testing::good_plan().plan.cutters.front().maximum_depth_of_cut_mm, 22.0);
  EXPECT_EQ(unmeasured("T1 P1 Z+20 D+10\nT2 P2 Z+130 D+8\n"), std::vector<std::string>{"T1"});
}

TEST(CheckProgram, ALengthShorterThanAnyHoldersFlangeIsFoundWhereASpindleHasATaper) {
  // Flutes of 3 mm would fit into 5 mm, and do in a collet of the spindle's own.
  for (const auto& [taper, faults] : {std::pair("BT40", 1), std::pair("ER20", 0), std::pair("none", 0)}) {
    model::Plan plan = testing::good_plan().plan;
    plan.machine.spindle.taper = taper;
    plan.cutters.front().maximum_depth_of_cut_mm = 3.0;
    plan.cutters.front().functional_length_mm = 0.0;
    const auto findings = check(testing::program_of(plan), plan, false, "T1 P1 Z+5 D+10\nT2 P2 Z+130 D+8\n");
    EXPECT_EQ(std::count_if(findings.begin(), findings.end(),
                            [](const auto& f) { return f.code == "CHK-TOOL-OFFSET"; }),
              faults)
        << taper << "\n"
        << told(findings);
  }
}

TEST(CheckProgram, ALengthShorterThanTheWayThatTheToolIsFedDownIsFound) {
  // T2 drills from Z2 to Z-22.4034, 24.4034 mm: at 24 mm its gage line would come below Z2. Nobody knows its
  // flutes, and the spindle holds it in a collet of its own.
  for (const auto& [length, said] : {std::pair("24", 1), std::pair("25", 0)}) {
    model::Plan plan = testing::good_plan().plan;
    plan.machine.spindle.taper = "ER20";
    for (auto& c : plan.cutters) c.functional_length_mm = c.maximum_depth_of_cut_mm = 0.0;
    const auto findings = check(testing::program_of(plan), plan, false,
                                std::string("T1 P1 Z+100 D+10\nT2 P2 Z+") + length + " D+8\n");
    EXPECT_EQ(std::count_if(findings.begin(), findings.end(),
                            [](const auto& f) {
                              return f.code == "CHK-TOOL-REACH" && f.property == 6 &&
                                     f.message.starts_with("T2 is " + std::string("24 mm"));
                            }),
              said)
        << length << "\n"
        << told(findings);
  }
}

TEST(CheckProgram, ALengthOfZeroInTheHeaderAloneIsFound) {
  const auto errors = [](const std::string& tools) {
    const std::string text = "(CAPSTAN PROGRAM version=1)\n" + tools +
                             "G21 G17 G90 G94 G40 G80\nG54\nG53 G0 Z0\nT2 M6\nG43 H2\nS1500 M3\nG0 X15 Y15\n"
                             "G0 Z5\nG98 G83 X15 Y15 Z-20 R2 Q5 F225\nG80\nM5\nG53 G0 Z0\nM2\n";
    Job job;
    const auto findings =
        check_program({"part.ngc", text, {}}, nullptr, testing::good_plan().plan.machine, {}, job);
    return std::count_if(findings.begin(), findings.end(),
                         [](const auto& f) { return f.code == "CHK-TOOL-OFFSET"; });
  };
  const std::string one = "(CAPSTAN TOOL T1 H1 length=", two = "(CAPSTAN TOOL T2 H2 length=";
  const std::string end = " diameter=8 id=\"d\" twist_drill)\n";
  EXPECT_EQ(errors(two + "0" + end), 1);
  EXPECT_EQ(errors(two + "-20" + end + one + "100" + end), 1);
  EXPECT_EQ(errors(two + "130" + end), 0);
  EXPECT_EQ(errors(two + "0" + end + one + "-12.5" + end), 0) << "they count from a reference";
}

TEST(CheckProgram, OfOffsetsThatCountFromAReferenceZeroIsTheReferencesAlone) {
  using Tools = std::vector<std::string>;
  // Negative ones with a 0 among them, or none above 0: they count from a reference.
  EXPECT_EQ(unmeasured("T1 P1 Z+0 D+10\nT2 P2 Z-12.5 D+8\n"), Tools{});
  EXPECT_EQ(unmeasured("T1 P1 Z-40 D+10\nT2 P2 Z-12.5 D+8\n"), Tools{});
  EXPECT_EQ(unmeasured("T1 P1 Z+0 D+10\nT2 P2 Z-12.5 D+8\nT3 P3 Z+0 D+6\n"), Tools{"T1"});
  // One negative length is rather a sign that was mistyped.
  EXPECT_EQ(unmeasured("T1 P1 Z+100 D+10\nT2 P2 Z-130 D+8\n"), Tools{"T2"});
  // The machine's description may say it either way.
  EXPECT_EQ(unmeasured("T1 P1 Z+0 D+10\nT2 P2 Z+12.5 D+8\n", true), Tools{});
  EXPECT_EQ(unmeasured("T1 P1 Z+0 D+10\nT2 P2 Z-12.5 D+8\n", false), (Tools{"T1", "T2"}));
}

TEST(CheckProgram, ALengthInInchesIsCalledThat) {
  const model::Plan plan = testing::good_plan().plan;
  const std::string wrong = replaced(testing::tool_table_of(plan), "Z+100.000000", "Z+2540.000000");
  const auto findings = check(testing::program_of(plan), plan, false, wrong);
  ASSERT_EQ(findings.size(), 1U) << told(findings);
  EXPECT_NE(findings[0].message.find("unit"), std::string::npos) << findings[0].message;
}

TEST(CheckProgram, WhatItCannotFollowIsAWarning) {
  const model::Plan plan = testing::good_plan().plan;
  for (const char* line : {"O100 while [1]", "#1=3", "G1 X[1+2]", "G18", "M98", "/G0 X1"}) {
    const std::string text = replaced(testing::program_of(plan), "G64 P0.01", line);
    const auto findings = check(text, plan, false);
    EXPECT_TRUE(std::any_of(
        findings.begin(), findings.end(),
        [](const auto& f) { return f.code == "CHK-UNVERIFIABLE" && f.severity == Severity::kWarning; }))
        << line << "\n"
        << told(findings);
  }
}

TEST(CheckProgram, AnExponentIsToldAsTheFormOfItsNumber) {
  const model::Plan plan = testing::good_plan().plan;
  const struct {
    const char *written, *told;
  } kWritten[] = {{"F1e9", "write F1000000000"}, {"F2.5E+2", "write F250"}, {"F1e400", "all its digits"}};
  for (const auto& [written, told_as] : kWritten) {
    const std::string text = replaced(testing::program_of(plan), "F225", written);
    const auto findings = check(text, plan, false);
    const auto f = std::find_if(findings.begin(), findings.end(),
                                [](const auto& one) { return one.code == "CHK-NUMBER"; });
    ASSERT_NE(f, findings.end()) << told(findings);
    EXPECT_EQ(f->move, line_of(text, written));
    EXPECT_NE(f->message.find("no exponent"), std::string::npos) << f->message;
    EXPECT_NE(f->message.find(told_as), std::string::npos) << f->message;
    EXPECT_EQ(told(findings).find("word E"), std::string::npos) << told(findings);
  }
}

TEST(CheckProgram, AWordEBehindASpaceIsAWordAndNoExponent) {
  const model::Plan plan = testing::good_plan().plan;
  const auto findings = check(replaced(testing::program_of(plan), "F225", "F225 E9"), plan, false);
  EXPECT_NE(told(findings).find("word E"), std::string::npos) << told(findings);
}

TEST(CheckProgram, APathToleranceWiderThanTheStepAllowsIsFoundOncePerStep) {
  model::Plan plan = testing::good_plan().plan;
  const std::string text = testing::program_of(plan);
  plan.steps.front().contour_tolerance_mm = 0.01;
  EXPECT_TRUE(check(text, plan).empty()) << told(check(text, plan));
  for (const char* wide : {"G64 P0.0101", "G64", "G20 G64 P0.001\nG21"}) {
    const auto findings = check(replaced(text, "G64 P0.01", wide), plan);
    EXPECT_EQ(std::count_if(findings.begin(), findings.end(),
                            [](const auto& f) { return f.code == "CHK-TEXT-TOLERANCE" && f.property == 33; }),
              1)
        << wide << "\n"
        << told(findings);
  }
  // What is tighter gouges nothing, but it is another state than the plan's.
  const auto exact = check(replaced(text, "G64 P0.01", "G61"), plan);
  EXPECT_EQ(exact.size(), 1U) << told(exact);
  EXPECT_EQ(exact.front().code, "CHK-TEXT-TOLERANCE");
}

TEST(CheckProgram, InchesAndRadiusArcsAreRead) {
  // The same motion in inches, the arc by its radius: within the travel, nothing to say.
  const std::string text =
      "G20 G17 G90 G94 G40 G80\nG54\nG53 G0 Z0\nT1 M6\nG43 H1\nS3000 M3\nG0 X1 Y1\nG0 Z1\n"
      "G2 X2 Y1 R0.5 F20\nG3 X2 Y3 R-1.2\nM5\nG53 G0 Z0\nM2\n";
  const auto findings = check(text, testing::good_plan().plan, false);
  EXPECT_TRUE(findings.empty()) << told(findings);
}

TEST(CheckProgram, RandomBytesNeverHurt) {
  unsigned state = 12345;
  const model::Plan plan = testing::empty_plan().plan;
  const std::string letters = "GMXYZIJKRFSTHDPQ0123456789.-+ \n()%;/[]#O";
  for (int round = 0; round < 200; ++round) {
    std::string text;
    for (int i = 0; i < 400; ++i) {
      state = state * 1664525U + 1013904223U;
      text.push_back(letters[(state >> 16U) % letters.size()]);
    }
    (void)check(text, plan, false, text);
  }
  SUCCEED();
}

}  // namespace
}  // namespace capstan::verify
