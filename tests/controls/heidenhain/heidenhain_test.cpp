#include "planner/controls/heidenhain/heidenhain.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "planner/controls/controls.h"
#include "tests/controls/control_plans.h"
#include "tests/support/corpus.h"

namespace capstan::controls::heidenhain {
namespace {

using model::CutterPath;
using model::MoveRole;
using model::Plan;
using plans::choose;
using plans::holes_plan;
using plans::plan_for;
using plans::pocket_plan;
using plans::program_of;
using plans::written;
using ::testing::HasSubstr;
using ::testing::MatchesRegex;
using ::testing::Not;

/// Without the numbers of blocks.
std::string bare(const Plan& plan) {
  std::string out;
  const std::string text = program_of(plan);
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = text.find('\n', at);
    std::string line = text.substr(at, end - at + 1);
    if (line.front() != ' ') line.erase(0, line.find(' ') + 1);
    out += line;
    at = end + 1;
  }
  return out;
}
std::string golden(const char* name) { return plans::golden("heidenhain", name); }

/// Down a helix of 5 mm radius in half turns, so many, a millimetre each, and a quarter of one.
Plan helix_plan(int half_turns) {
  Plan plan = plan_for("heidenhain");
  CutterPath p;
  p.start({5, 0, 10});
  p.rapid({5, 0, 1});
  double z = 1.0;
  for (int i = 0; i < half_turns; ++i)
    p.arc({i % 2 == 0 ? -5.0 : 5.0, 0, z -= 1.0}, {0, 0}, false, MoveRole::kRamp);
  const double side = half_turns % 2 == 0 ? 1.0 : -1.0;
  p.arc({0, 5.0 * side, z - 0.5}, {0, 0}, false, MoveRole::kRamp);
  p.line({3, 5.0 * side, z - 0.5}, MoveRole::kCut);
  p.rapid({3, 5.0 * side, 10}, MoveRole::kRetract);
  capstan::testing::add_step(plan, "bore", "em18", std::move(p), 3000);
  return plan;
}

TEST(HeidenhainGolden, APocketIsWrittenAsReviewed) {
  EXPECT_EQ(program_of(pocket_plan("heidenhain")), golden("pocket.h"));
}

TEST(HeidenhainGolden, HolesAreWrittenAsReviewedWithCyclesAndWithExplicitMoves) {
  EXPECT_EQ(program_of(holes_plan("heidenhain")), golden("holes_cycles.h"));
  Plan plan = holes_plan("heidenhain");
  choose(plan, "cycles", "explicit");
  EXPECT_EQ(program_of(plan), golden("holes_explicit.h"));
}

TEST(HeidenhainProgram, BlocksAreNumberedFromZeroWithoutAGapAndNoneIsBlank) {
  for (const Plan& plan : {pocket_plan("heidenhain"), holes_plan("heidenhain")}) {
    const std::string text = program_of(plan);
    long next = 0;
    bool goes_on = false;
    for (std::size_t at = 0; at < text.size();) {
      const std::size_t end = text.find('\n', at);
      const std::string line = text.substr(at, end - at);
      at = end + 1;
      if (goes_on) {
        EXPECT_EQ(line.substr(0, 3), "  Q") << line;
      } else {
        EXPECT_EQ(line.substr(0, line.find(' ')), std::to_string(next++)) << line;
      }
      goes_on = line.ends_with('~');
    }
  }
}

TEST(HeidenhainProgram, EachOptionOfTheMachineChangesWhatItSays) {
  const auto with = [](const char* name, const char* value) {
    Plan plan = holes_plan("heidenhain");
    choose(plan, name, value);
    return bare(plan);
  };
  EXPECT_THAT(with("next_tool", "staged"), HasSubstr("\nTOOL CALL 3 Z S1200\nTOOL DEF 4\n"));
  EXPECT_THAT(with("next_tool", "called"), Not(HasSubstr("TOOL DEF")));
  EXPECT_THAT(with("prove_out", "none"), Not(HasSubstr("\nM1\n")));
  EXPECT_THAT(with("plane_reset", "yes"), HasSubstr("\nPLANE RESET STAY\nM129\n"));
  EXPECT_THAT(with("plane_reset", "no"), Not(HasSubstr("PLANE")));
}

// IPA turns as DR says; the place behind it is stated whole, for the angle is rounded otherwise.
TEST(HeidenhainProgram, AHelixIsOneBlockOfItsWholeAngle) {
  // Five half turns and a quarter: 990 degrees, from Z1 to Z-4.5.
  EXPECT_THAT(bare(helix_plan(5)), HasSubstr("\nCC X+0 Y+0\nCP IPA+990 IZ-5.5 DR+ F600\nL X+3 Y-5 R0\n"));
  // A turn and a half in two arcs of half a turn and one of a quarter.
  EXPECT_THAT(bare(helix_plan(2)), HasSubstr("\nCP IPA+450 IZ-2.5 DR+ F600\n"));
}

/// Three holes in one step; the last is `deeper` mm deeper.
Plan row_of_holes(double deeper) {
  Plan plan = plan_for("heidenhain");
  model::Cutter drill = plan.cutters[0];
  drill.id = "d8";
  drill.cutter_class = model::CutterClass::kTwistDrill;
  drill.pocket = 3;
  plan.cutters.push_back(drill);
  CutterPath p;
  p.start({10, 0, 10});
  for (int i = 1; i <= 3; ++i) {
    const double x = 10.0 * i, bottom = i == 3 ? -8.0 - deeper : -8.0;
    p.rapid({x, 0, 10});
    p.rapid({x, 0, 2});
    p.line({x, 0, bottom}, MoveRole::kDrill);
    p.rapid({x, 0, 10}, MoveRole::kRetract);
  }
  capstan::testing::add_step(plan, "row", "d8", std::move(p), 1200, 180);
  return plan;
}
std::size_t count(const std::string& text, const std::string& part) {
  std::size_t n = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++n;
  return n;
}

TEST(HeidenhainProgram, EqualHolesOfAStepAreCallsOfOneDefinition) {
  const std::string equal = bare(row_of_holes(0.0));
  EXPECT_EQ(count(equal, "CYCL DEF 200"), 1U) << equal;
  EXPECT_THAT(equal, HasSubstr("\nCYCL CALL\nL X+20 R0 FMAX M99\nL X+30 R0 FMAX M99\n"));
  EXPECT_EQ(count(equal, "\nCYCL CALL\n"), 1U);
  EXPECT_EQ(count(equal, " M99\n"), 2U);
  const std::string other = bare(row_of_holes(1.0));
  EXPECT_EQ(count(other, "CYCL DEF 200"), 2U) << other;
  EXPECT_EQ(count(other, "\nCYCL CALL\n"), 2U);
  EXPECT_EQ(count(other, " M99\n"), 1U);
}

// Fed from 2; pecks of 8 mm from Q203, which lies a peck above the first bottom, and 6 mm at the end.
TEST(HeidenhainProgram, BrokenChipsAreCycle203) {
  EXPECT_THAT(bare(plans::pecked_plan("heidenhain", {-10, -18, -24}, false)),
              HasSubstr("\nCYCL DEF 203 UNIVERSAL DRILLING ~\n  Q200=+4 ;SET-UP CLEARANCE ~\n"
                        "  Q201=-22 ;DEPTH ~\n  Q206=180 ;FEED RATE FOR PLNGNG ~\n"
                        "  Q202=+8 ;PLUNGING DEPTH ~\n  Q210=+0 ;DWELL TIME AT TOP ~\n"
                        "  Q203=-2 ;SURFACE COORDINATE ~\n  Q204=+12 ;2ND SET-UP CLEARANCE ~\n"
                        "  Q212=+0 ;DECREMENT ~\n  Q213=+3 ;NR OF BREAKS ~\n"
                        "  Q205=+0 ;MIN. PLUNGING DEPTH ~\n  Q211=+0 ;DWELL TIME AT DEPTH ~\n"
                        "  Q208= MAX ;RETRACTION FEED RATE ~\n  Q256=+0.5 ;DIST FOR CHIP BRKNG\n"
                        "CYCL CALL\n"));
}

// Straight up with the spindle stopped: off the wall it is not moved.
TEST(HeidenhainProgram, ABarThatComesOutStoppedIsCycle202WhereTheSpindleCanBeOriented) {
  Plan plan = plans::bored_plan("heidenhain");
  EXPECT_THAT(bare(plan), Not(HasSubstr("CYCL DEF 202")));
  choose(plan, "oriented_stop", "yes");
  EXPECT_THAT(bare(plan),
              HasSubstr("\nCYCL DEF 202 BORING ~\n  Q200=+1 ;SET-UP CLEARANCE ~\n  Q201=-19.2 ;DEPTH ~\n"
                        "  Q206=180 ;FEED RATE FOR PLNGNG ~\n  Q211=+0 ;DWELL TIME AT DEPTH ~\n"
                        "  Q208= MAX ;RETRACTION FEED RATE ~\n  Q203=+1 ;SURFACE COORDINATE ~\n"
                        "  Q204=+9 ;2ND SET-UP CLEARANCE ~\n  Q214=+0 ;DISENGAGING DIRECTN ~\n"
                        "  Q336=+0 ;ANGLE OF SPINDLE\nCYCL CALL\n"));
}

// Comes back to 6 after each, and is fed again 0.5 mm above the last bottom.
TEST(HeidenhainProgram, AClearedHoleIsCycle205WithTheParametersOfTheControlsVersion) {
  const auto with = [](const char* version) {
    Plan plan = plans::pecked_plan("heidenhain", {-10, -18, -24}, true);
    choose(plan, "pecking_cycle", version);
    return bare(plan);
  };
  const std::string first =
      "\nCYCL DEF 205 UNIVERSAL PECKING ~\n  Q200=+8 ;SET-UP CLEARANCE ~\n  Q201=-22 ;DEPTH ~\n"
      "  Q206=180 ;FEED RATE FOR PLNGNG ~\n  Q202=+8 ;PLUNGING DEPTH ~\n"
      "  Q203=-2 ;SURFACE COORDINATE ~\n  Q204=+12 ;2ND SET-UP CLEARANCE ~\n  Q212=+0 ;DECREMENT ~\n"
      "  Q205=+0 ;MIN. PLUNGING DEPTH ~\n  Q258=+0.5 ;UPPER ADV. STOP DIST. ~\n"
      "  Q259=+0.5 ;LOWER ADV. STOP DIST. ~\n  Q257=+0 ;DEPTH FOR CHIP BRKNG ~\n"
      "  Q256=+0.2 ;DIST FOR CHIP BRKNG ~\n  Q211=+0 ;DWELL TIME AT DEPTH";
  const std::string deepened = " ~\n  Q379=+0 ;STARTING POINT ~\n  Q253=+750 ;F PRE-POSITIONING";
  EXPECT_THAT(with("tnc430"), HasSubstr(first + "\nCYCL CALL\n"));
  EXPECT_THAT(with("itnc530"), HasSubstr(first + deepened + "\nCYCL CALL\n"));
  EXPECT_THAT(with("tnc640"), HasSubstr(first + deepened +
                                        " ~\n  Q208= MAX ;RETRACTION FEED RATE ~\n"
                                        "  Q395=+0 ;DEPTH REFERENCE\nCYCL CALL\n"));
  EXPECT_THAT(with("explicit"), Not(HasSubstr("CYCL DEF 205")));
}

TEST(HeidenhainProgram, PecksThatNoCycleMakesAreMoves) {
  Plan none = plans::pecked_plan("heidenhain", {-10, -18, -24}, true);  // its version is not stated
  EXPECT_THAT(bare(none), Not(HasSubstr("CYCL DEF 20")));
  const std::vector<std::vector<double>> unlike = {
      {-10, -14, -24}, {-10, -18, -24, -30}, {10.0 / 3.0 - 10, -8, -12}};
  for (const bool clears : {true, false}) {
    for (const auto& bottoms : unlike) {
      Plan plan = plans::pecked_plan("heidenhain", bottoms, clears);
      choose(plan, "pecking_cycle", "itnc530");
      EXPECT_THAT(bare(plan), Not(HasSubstr("CYCL DEF 20"))) << clears << " " << bottoms[1];
    }
  }
  // A wait at each bottom: Q211 waits at the last one only.
  Plan waits = plans::pecked_plan("heidenhain", {-10, -18, -24}, false);
  auto& step = waits.steps.back();
  CutterPath p;
  model::FeedSchedule s;
  p.start({20, 20, 10});
  p.rapid({20, 20, 2}, MoveRole::kApproach);
  for (const double z : {-10.0, -18.0}) {
    p.line({20, 20, z}, MoveRole::kDrill);
    if (z == -10.0) p.dwell();
    if (z == -10.0) p.line({20, 20, z + 0.5}, MoveRole::kLink);
  }
  p.rapid({20, 20, 10}, MoveRole::kRetract);
  s.feed_mm_min.assign(p.size(), 180.0);
  s.spindle_rpm.assign(p.size(), 1200.0);
  s.dwell_s.assign(p.size(), 0.5);
  step.path = std::make_shared<const CutterPath>(std::move(p));
  step.schedule = std::make_shared<const model::FeedSchedule>(std::move(s));
  EXPECT_THAT(bare(waits), Not(HasSubstr("CYCL DEF 203")));
}

TEST(HeidenhainProgram, AProgramIsNamedByThePartsFile) {
  Plan plan = pocket_plan("heidenhain");
  plan.file_name = "/parts/m\xc3\xbcller bracket-2.p21";
  EXPECT_EQ(program_name(plan), "M__LLER_BRACKET-2");
  plan.file_name = "a_name_that_no_control_would_take.stp";
  EXPECT_EQ(program_name(plan), "A_NAME_THAT_NO_CONTR");
  plan.file_name = "";
  EXPECT_EQ(program_name(plan), "CAPSTAN");
}

TEST(HeidenhainProgram, WithoutATolerancePathsHaveNoWord) {
  Plan plan = pocket_plan("heidenhain");
  plan.machine.control.path_tolerance_mm = 0.0;
  EXPECT_EQ(written(plan).error().code, "OUT-CONTROL");
  EXPECT_THAT(written(plan).error().hint, HasSubstr("path_tolerance_mm"));
}

// Cycle 32.1 without a number would leave the tolerance to machine data.
TEST(HeidenhainProgram, AToleranceOfAStepThatRoundsToNothingIsRefused) {
  Plan plan = pocket_plan("heidenhain");
  plan.steps[0].contour_tolerance_mm = 0.0004;
  const auto refused = written(plan);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, "OUT-CONTROL");
  EXPECT_EQ(refused.error().path, "rough pocket");
  EXPECT_THAT(refused.error().message,
              HasSubstr("tolerance of 0.0004 mm is 0 with the machine's 3 decimals"));
  EXPECT_THAT(refused.error().expected, HasSubstr("0.001 mm"));
  plan.steps[0].contour_tolerance_mm = 0.0006;
  EXPECT_THAT(bare(plan), HasSubstr("\nCYCL DEF 32.1 T0.001\n"));
  plan.steps[0].contour_tolerance_mm = 0.0;  // the machine's own
  EXPECT_THAT(bare(plan), Not(HasSubstr("32.1 T\n")));
  plan.steps[0].contour_tolerance_mm = 0.0004;
  plan.machine.control.decimals = 4;
  EXPECT_THAT(bare(plan), HasSubstr("\nCYCL DEF 32.1 T0.0004\n"));
}

// Four decimals, of places and of circles' centres: CC has what is left of them.
TEST(HeidenhainProgram, NoNumberHasMoreDecimalsThanTheControlTakes) {
  for (const int decimals : {1, 2, 3, 4}) {
    Plan plan = plan_for("heidenhain");
    CutterPath p;
    p.start({5, 0, 10});
    p.rapid({5, 0, 1});
    p.arc({0, 5, 1}, {1.0 / 3.0, 1.0 / 3.0}, false, MoveRole::kCut);
    p.rapid({0, 5, 10}, MoveRole::kRetract);
    capstan::testing::add_step(plan, "arc", "em18", std::move(p), 3000);
    plan.machine.control.decimals = decimals;
    plan.machine.control.path_tolerance_mm = 0.1;
    const std::string text = bare(plan);
    EXPECT_THAT(text, HasSubstr("\nCC X")) << decimals;
    for (std::size_t at = text.find('.'); at != std::string::npos; at = text.find('.', at + 1)) {
      const std::size_t end = text.find_first_not_of("0123456789", at + 1);
      EXPECT_LE(end - at - 1, 4U) << decimals << ": " << text.substr(at < 20 ? 0 : at - 20, 40);
    }
  }
  Plan plan = pocket_plan("heidenhain");
  plan.machine.control.decimals = 5;
  EXPECT_EQ(written(plan).error().code, "OUT-CONTROL");
  EXPECT_THAT(written(plan).error().message, HasSubstr("5 decimals"));
}

// M0 stops the spindle and the coolant: both are off before it, and stated again before the next cut.
TEST(HeidenhainProgram, BehindAStopTheSpindleAndTheCoolantAreStatedAgain) {
  Plan plan = holes_plan("heidenhain");
  Job job;
  const auto text = write_program(plan, job, {{"H2 drill", "PIP-EXCESS", "too much"}});
  ASSERT_TRUE(text) << to_text(text.error());
  bool turns = false, cools = false;
  int stops = 0;
  for (std::size_t at = 0; at < text->size();) {
    const std::size_t end = text->find('\n', at);
    std::string line = text->substr(at, end - at);
    at = end + 1;
    if (line.front() != ' ') line.erase(0, line.find(' ') + 1);
    if (line == "M3" || line == "M5") turns = line == "M3";
    if (line == "M8" || line == "M9") cools = line == "M8";
    if (line == "M0") {
      ++stops;
      EXPECT_FALSE(turns || cools);
    }
    if (line == "CYCL CALL") {
      EXPECT_TRUE(turns && cools) << stops;
    }
    if (line.starts_with("CYCL DEF 207")) break;  // the spindle stands behind it
  }
  EXPECT_EQ(stops, 1);
}

TEST(HeidenhainProgram, WorkOffsetsAreRowsOfThePresetTable) {
  Plan plan = pocket_plan("heidenhain");
  plan.setups[0].work_offset = "PRESET12";
  EXPECT_THAT(bare(plan), HasSubstr("\nCYCL DEF 247 DATUM SETTING ~\n  Q339=+12 ;DATUM NUMBER\n"));
  plan.setups[0].work_offset = "G54";
  EXPECT_EQ(written(plan).error().code, "OUT-SETUP");
}

TEST(HeidenhainProgram, AnOptionThatTheControlDoesNotHaveIsRefused) {
  Plan plan = pocket_plan("heidenhain");
  choose(plan, "tool_call", "name");
  EXPECT_EQ(written(plan).error().code, "OUT-OPTION");
}

TEST(HeidenhainProgram, ALeftHandTapHasItsPitchBelowZero) {
  Plan plan = holes_plan("heidenhain");
  auto& tap = plan.steps.back();
  model::FeedSchedule s = *tap.schedule;
  for (double& rpm : s.spindle_rpm) rpm = -rpm;
  tap.schedule = std::make_shared<const model::FeedSchedule>(std::move(s));
  EXPECT_THAT(bare(plan), HasSubstr("  Q239=-1 ;THREAD PITCH ~\n"));
  EXPECT_THAT(bare(plan), HasSubstr("\nM4\n"));
}

}  // namespace
}  // namespace capstan::controls::heidenhain
