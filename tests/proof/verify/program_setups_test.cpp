#include <gtest/gtest.h>

#include <algorithm>

#include "planner/proof/verify/verify.h"
#include "tests/proof/verify/checked.h"
#include "tests/proof/verify/told/two_setups.h"

namespace capstan::verify {
namespace {

using testing::PlanMaker;
using testing::replaced;
using testing::text_of_two;
using testing::told;
using testing::two_setups;

const model::Finding* find(const std::vector<model::Finding>& findings, const std::string& code) {
  const auto at =
      std::find_if(findings.begin(), findings.end(), [&](const auto& f) { return f.code == code; });
  return at == findings.end() ? nullptr : &*at;
}

std::vector<model::Finding> check(const std::string& text, const model::Plan& plan, bool with_plan,
                                  const std::string& table = {}) {
  Job job;
  return check_program({"part.ngc", text, table}, with_plan ? &plan : nullptr, plan.machine, plan.cutters,
                       job);
}

long line_of(const std::string& text, std::size_t at) {
  return 1 + std::count(text.begin(), text.begin() + static_cast<long>(at), '\n');
}

TEST(CheckProgramSetups, ASoundProgramOfTwoSetUpsHasNoFinding) {
  const auto with = check(text_of_two(), two_setups(), true, testing::tool_table_of(two_setups()));
  EXPECT_TRUE(with.empty()) << told(with);
  const auto alone = check(text_of_two(), two_setups(), false, testing::tool_table_of(two_setups()));
  ASSERT_EQ(alone.size(), 1U) << told(alone);
  EXPECT_EQ(alone[0].code, "CHK-NOT-JUDGED");
}

TEST(CheckProgramSetups, AnotherWorkOffsetThanTheSetUpsIsNamedWithStepLineAndBothOffsets) {
  const std::string text = replaced(text_of_two(), "\nG55\n", "\nG54\n");
  const std::size_t first = text.find("G0 X15 Y15");
  ASSERT_NE(first, std::string::npos);
  for (const bool with_plan : {true, false}) {
    const auto findings = check(text, two_setups(), with_plan);
    const auto* f = find(findings, "CHK-TEXT-OFFSET");
    ASSERT_NE(f, nullptr) << told(findings);
    EXPECT_EQ(f->property, 3);
    EXPECT_EQ(f->severity, Severity::kError);
    EXPECT_EQ(f->step, "drill");
    EXPECT_EQ(f->move, line_of(text, first));
    EXPECT_NE(f->message.find("G54"), std::string::npos) << f->message;
    EXPECT_NE(f->message.find("G55"), std::string::npos) << f->message;
  }
}

TEST(CheckProgramSetups, AHeaderOrMarkerOfAnotherSetUpThanThePlansIsFound) {
  const std::string text = text_of_two();
  const auto header = check(replaced(text, "n=2 offset=G55", "n=2 offset=G56"), two_setups(), true);
  EXPECT_NE(find(header, "CHK-HEADER-OFFSET"), nullptr) << told(header);
  const auto marker = check(replaced(text, "tool=2 setup=2", "tool=2 setup=1"), two_setups(), true);
  EXPECT_NE(find(marker, "CHK-TEXT-SETUP"), nullptr) << told(marker);
}

TEST(CheckProgramSetups, AMarkerThatNamesAnotherToolThanIsLoadedIsFoundWithAndWithoutThePlan) {
  const std::string text = replaced(text_of_two(), "n=2 tool=2", "n=2 tool=3");
  for (const bool with_plan : {true, false}) {
    const auto findings = check(text, two_setups(), with_plan);
    const auto* f = find(findings, "CHK-MARKER-TOOL");
    ASSERT_NE(f, nullptr) << told(findings);
    EXPECT_EQ(f->property, 4);
    EXPECT_EQ(f->severity, Severity::kError);
    EXPECT_EQ(f->step, "drill");
  }
}

TEST(CheckProgramSetups, AChangeOfSetUpNeedsAStopWithSpindleAndCoolantOffAndTheToolAway) {
  const std::string stop = "M5\nM9\nG53 G0 Z0\nM0\n";
  for (const char* wrong : {"M5\nM9\nG53 G0 Z0\n", "M5\nM9\nG53 G0 Z0\nM1\n", "M9\nG53 G0 Z0\nM0\n",
                            "M5\nM9\nG0 Z2\nM0\n", "M5\nG53 G0 Z0\nM0\n"}) {
    const std::string text = replaced(text_of_two(), stop, wrong);
    ASSERT_FALSE(text.empty());
    for (const bool with_plan : {true, false}) {
      const auto findings = check(text, two_setups(), with_plan);
      const auto* f = find(findings, "CHK-SETUP-STOP");
      ASSERT_NE(f, nullptr) << wrong << told(findings);
      EXPECT_EQ(f->property, 31);
      EXPECT_EQ(f->severity, Severity::kError);
      EXPECT_EQ(f->step, "drill");
    }
  }
}

TEST(CheckProgramSetups, AStopWithinASetUpDoesNotStandForTheChange) {
  std::string text = replaced(text_of_two(), "G53 G0 Z0\nM0\n", "G53 G0 Z0\n");
  text = replaced(text, "G43 H1\n", "G43 H1\nM0\n");
  const auto findings = check(text, two_setups(), false);
  EXPECT_NE(find(findings, "CHK-SETUP-STOP"), nullptr) << told(findings);
}

TEST(CheckProgramSetups, WhatIsNotJudgedWithoutThePlanIsNoted) {
  const auto findings = check(text_of_two(), two_setups(), false);
  const auto* f = find(findings, "CHK-NOT-JUDGED");
  ASSERT_NE(f, nullptr);
  EXPECT_EQ(f->severity, Severity::kNote);
  EXPECT_NE(f->message.find("100 x 100 x 50"), std::string::npos) << f->message;
  EXPECT_EQ(find(check(text_of_two(), two_setups(), true), "CHK-NOT-JUDGED"), nullptr);
}

TEST(CheckProgramHeader, AToolTableOfOtherSizesThanTheHeadersIsFoundWithoutAPlan) {
  model::Plan plan = two_setups();
  const std::string table = testing::tool_table_of(plan);
  plan.cutters.clear();
  const std::pair<const char*, const char*> lengths{"Z+100.000000", "Z+52.000000"};
  const std::pair<const char*, const char*> diameters{"D+10.000000", "D+12.000000"};
  for (const auto& [was, is] : {lengths, diameters}) {
    const std::string wrong = replaced(table, was, is);
    ASSERT_FALSE(wrong.empty());
    const auto findings = check(text_of_two(), plan, false, wrong);
    const auto* f = find(findings, is[0] == 'Z' ? "CHK-HEADER-LENGTH" : "CHK-HEADER-DIAMETER");
    ASSERT_NE(f, nullptr) << told(findings);
    EXPECT_EQ(f->property, 6);
    EXPECT_EQ(f->severity, Severity::kError);
  }
}

TEST(CheckProgramHeader, ALibraryOfOtherSizesThanTheHeadersIsFound) {
  model::Plan plan = two_setups();
  plan.cutters[0].cutting_diameter_mm = 12;
  const auto findings = check(text_of_two(), plan, false);
  const auto* f = find(findings, "CHK-HEADER-DIAMETER");
  ASSERT_NE(f, nullptr) << told(findings);
  EXPECT_NE(f->message.find("12 mm"), std::string::npos) << f->message;
}

TEST(CheckProgramHeader, ToolsThatTheMachineDoesNotTakeAreFound) {
  model::Plan plan = two_setups();
  plan.cutters.clear();
  plan.machine.tool_diameter_max_mm = 9;
  plan.machine.tool_length_max_mm = 120;
  const auto findings = check(text_of_two(), plan, false);
  const auto* wide = find(findings, "CHK-MACHINE-TOOL");
  const auto* tall = find(findings, "CHK-TOOL-LENGTH");
  ASSERT_NE(wide, nullptr) << told(findings);
  ASSERT_NE(tall, nullptr) << told(findings);
  EXPECT_EQ(wide->step, "pocket");
  EXPECT_EQ(tall->step, "drill");
}

TEST(CheckProgramHeader, TappingInStepNeedsAMachineThatCan) {
  model::Plan plan = testing::good_plan().plan;
  const std::string text =
      replaced(testing::program_of(plan), "G1 X15 Y15 Z-22.4034 F225", "G33.1 Z-20 K1.25");
  ASSERT_FALSE(text.empty());
  EXPECT_EQ(find(check(text, plan, false), "CHK-MACHINE-TAPPING"), nullptr);
  plan.machine.abilities.rigid_tapping = false;
  const auto* f = find(check(text, plan, false), "CHK-MACHINE-TAPPING");
  ASSERT_NE(f, nullptr);
}

TEST(CheckMachine, PlannedTappingAndWideToolsNeedAMachineForThem) {
  PlanMaker k = testing::good_plan();
  testing::edit_path(k.plan, 1, [](auto& p) { p.role[2] = model::MoveRole::kTap; });
  k.plan.machine.abilities.rigid_tapping = false;
  k.plan.machine.tool_diameter_max_mm = 9;
  Job job;
  const auto findings = check_plan(k.plan, job);
  const auto* taps = find(findings, "CHK-MACHINE-TAPPING");
  const auto* wide = find(findings, "CHK-MACHINE-TOOL");
  ASSERT_NE(taps, nullptr) << told(findings);
  ASSERT_NE(wide, nullptr) << told(findings);
  EXPECT_EQ(taps->step, "drill");
  EXPECT_EQ(wide->step, "pocket");
}

TEST(CheckMachine, AnAccuracyCoarserThanTheTightestToleranceIsAWarning) {
  PlanMaker k = testing::good_plan();
  const auto* ws = k.plan.model.get<model::MachiningWorkingstep>(k.plan.steps[0].step);
  const auto* pocket = k.plan.model.get<model::ClosedPocket>(ws->its_feature);
  const auto* outline = k.plan.model.get<model::RectangularClosedProfile>(pocket->feature_boundary);
  model::PlusMinusValue t;
  t.upper_limit = 0.004;
  t.lower_limit = 0.004;  // 0.008 wide
  k.plan.model.get<model::TolerancedLengthMeasure>(outline->profile_length)->implicit_tolerance =
      k.plan.model.add(t);
  Job job;
  for (const auto& [accuracy, told_so] : {std::pair{0.005, false}, {0.01, true}}) {
    k.plan.machine.abilities.positioning_accuracy_mm = accuracy;
    const auto findings = check_plan(k.plan, job);
    const auto* f = find(findings, "CHK-MACHINE-TOLERANCE");
    ASSERT_EQ(f != nullptr, told_so) << told(findings);
    if (f != nullptr) {
      EXPECT_EQ(f->severity, Severity::kWarning);
    }
  }
}

TEST(CheckMachine, AnAccuracyCoarserThanTheGeneralToleranceIsAWarning) {
  // Nothing of the part states a tolerance of its own; the machine positions to 0.005 mm.
  for (const auto& [general, told_so] : {std::pair{"+-0.001", true},
                                         {"+-0.1", false},
                                         {"ISO 22081 0.004", true},
                                         {"ISO 22081 +-0.003", false},
                                         {"ISO 2768-fH", false}}) {
    PlanMaker k = testing::good_plan();
    k.plan.machine.abilities.positioning_accuracy_mm = 0.005;
    k.plan.provenance.push_back({"general tolerance", general, "named by the user"});
    Job job;
    const auto findings = check_plan(k.plan, job);
    const auto* f = find(findings, "CHK-MACHINE-TOLERANCE");
    ASSERT_EQ(f != nullptr, told_so) << general << "\n" << told(findings);
    if (f != nullptr) {
      EXPECT_EQ(f->severity, Severity::kWarning);
      EXPECT_NE(f->message.find("what states no tolerance of its own"), std::string::npos) << f->message;
    }
  }
}

// The piece is 100 x 100 x 50 mm; axes travel 500 x 500 x 400.
TEST(CheckMachine, APieceLargerThanTheTableOrTheTravelIsNotCalledSafe) {
  const auto said = [](auto change) {
    PlanMaker k = testing::good_plan();
    change(k.plan.machine);
    Job job;
    const auto findings = check_plan(k.plan, job);
    const auto* f = find(findings, "CHK-MACHINE-PIECE");
    if (f != nullptr) {
      EXPECT_TRUE(f->unproved) << f->message;
    }
    return f == nullptr ? std::string() : f->message;
  };
  EXPECT_EQ(said([](model::Machine&) {}), "");
  const auto has = [](const std::string& text, const char* part) {
    return text.find(part) != std::string::npos;
  };
  EXPECT_TRUE(has(said([](model::Machine& m) { m.abilities.table_length_mm = 90; }),
                  "100 mm in X, where the table has 90 mm"));
  EXPECT_TRUE(has(said([](model::Machine& m) { m.abilities.table_width_mm = 99; }),
                  "100 mm in Y, where the table has 99 mm"));
  EXPECT_TRUE(has(said([](model::Machine& m) { m.axes[2].travel_min_mm = -49; }),
                  "50 mm in Z, where the axis travels 49 mm"));
  EXPECT_TRUE(has(said([](model::Machine& m) { m.axes[0].travel_max_mm = 95; }),
                  "100 mm in X, where the axis travels 95 mm"));
  // What stands on the table may be longer than the travel.
  EXPECT_EQ(said([](model::Machine& m) {
              m.axes[0].travel_max_mm = 95;
              m.abilities.table_length_mm = 120;
            }),
            "");
}

}  // namespace
}  // namespace capstan::verify
