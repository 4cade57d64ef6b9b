#include "planner/controls/siemens/siemens.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "planner/controls/controls.h"
#include "tests/controls/control_plans.h"
#include "tests/support/corpus.h"

namespace capstan::controls::siemens {
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
using ::testing::Not;

std::string golden(const char* name) { return plans::golden("siemens", name); }

/// Down a helix of 5 mm radius in half turns, so many, a millimetre each, and a last piece of a quarter.
Plan helix_plan(int half_turns, bool and_a_quarter) {
  Plan plan = plan_for("siemens");
  CutterPath p;
  p.start({5, 0, 10});
  p.rapid({5, 0, 1});
  double z = 1.0;
  for (int i = 0; i < half_turns; ++i)
    p.arc({i % 2 == 0 ? -5.0 : 5.0, 0, z -= 1.0}, {0, 0}, false, MoveRole::kRamp);
  const double side = half_turns % 2 == 0 ? 1.0 : -1.0;
  if (and_a_quarter) p.arc({0, 5.0 * side, z - 0.5}, {0, 0}, false, MoveRole::kRamp);
  p.rapid({and_a_quarter ? 0.0 : 5.0 * side, and_a_quarter ? 5.0 * side : 0.0, 10}, MoveRole::kRetract);
  capstan::testing::add_step(plan, "bore", "em18", std::move(p), 3000);
  return plan;
}

TEST(SiemensGolden, APocketIsWrittenAsReviewed) {
  EXPECT_EQ(program_of(pocket_plan("siemens")), golden("pocket.mpf"));
}

TEST(SiemensGolden, HolesAreWrittenAsReviewedWithCyclesAndWithExplicitMoves) {
  EXPECT_EQ(program_of(holes_plan("siemens")), golden("holes_cycles.mpf"));
  Plan plan = holes_plan("siemens");
  choose(plan, "cycles", "explicit");
  EXPECT_EQ(program_of(plan), golden("holes_explicit.mpf"));
}

// Row: 20 mm apart from X20 on. Circle: six holes of 60 degrees. The grid of four is neither.
TEST(SiemensProgram, EqualHolesOnALineOrACircleAreAPatternOfTheControlAndOthersAreItsPlaces) {
  const std::string row = program_of(plans::pattern_plan("siemens", {{20, 20}, {40, 20}, {60, 20}}));
  EXPECT_THAT(row, HasSubstr("\nF180\nMCALL CYCLE81(10,1,1,-18.2,)\nHOLES1(20,20,0,0,20,3)\nMCALL\n"));
  const std::string ring = program_of(plans::pattern_plan("siemens", plans::ring({50, 40}, 30, 0, 60, 6)));
  EXPECT_THAT(ring, HasSubstr("\nMCALL CYCLE81(10,1,1,-18.2,)\nHOLES2(50,40,30,0,60,6)\nMCALL\n"));
  const std::string four =
      program_of(plans::pattern_plan("siemens", {{10, 10}, {86, 10}, {10, 70}, {86, 70}}));
  EXPECT_THAT(four, HasSubstr("\nMCALL CYCLE81(10,1,1,-18.2,)\nG0 X10 Y10\nG0 X86\nG0 X10 Y70\nG0 "
                              "X86\nMCALL\n"));
  EXPECT_THAT(four, Not(HasSubstr("HOLES")));
}

TEST(SiemensProgram, EqualPecksBehindTheFirstAreCYCLE83AndOthersAreMoves) {
  // RFP is a peck of 8 above the first bottom, and SDIS from there to where the tool comes back to, 6.
  EXPECT_THAT(program_of(plans::pecked_plan("siemens", {-10, -18, -26}, true)),
              HasSubstr("\nF180\nMCALL CYCLE83(10,-2,8,-26,,-10,,0,0,0,1,1,,,,0,0.5)\nG0 X20 Y20\nMCALL\n"));
  // Fed from 2, and 0.5 up after each.
  EXPECT_THAT(program_of(plans::pecked_plan("siemens", {-10, -18, -26}, false)),
              HasSubstr("\nF180\nMCALL CYCLE83(10,-2,4,-26,,-10,,0,0,0,1,0,,,0.5,0)\nG0 X20 Y20\nMCALL\n"));
  // 6 mm at the end: how the control divides its last two pecks is not looked up.
  EXPECT_THAT(program_of(plans::pecked_plan("siemens", {-10, -18, -24}, true)), Not(HasSubstr("CYCLE83(")));
}

TEST(SiemensProgram, ABarThatComesOutStoppedIsCYCLE86WhereTheSpindleCanBeOrientedElseMoves) {
  Plan plan = plans::bored_plan("siemens");
  EXPECT_THAT(program_of(plan), HasSubstr("\nG1 Z-18.2 F180\nM5\nG0 Z10\n"));
  choose(plan, "oriented_stop", "yes");
  EXPECT_THAT(program_of(plan),
              HasSubstr("\nF180\nMCALL CYCLE86(10,1,1,-18.2,,0,3,0,0,0,0)\nG0 X20 Y20\nMCALL\n"));
}

TEST(SiemensProgram, EachOptionOfTheMachineChangesWhatItSays) {
  const auto with = [](const char* name, const char* value) {
    Plan plan = holes_plan("siemens");
    choose(plan, name, value);
    return program_of(plan);
  };
  EXPECT_THAT(with("next_tool", "staged"), HasSubstr("\nT3 M6\nT4\n"));
  EXPECT_THAT(with("next_tool", "called"), Not(HasSubstr("\nT4\n")));
  EXPECT_THAT(with("tool_call", "name"), HasSubstr("\nT=\"d8\" M6\n"));
  EXPECT_THAT(with("smoothing", "g642"), HasSubstr("\nG642 CTOL=0.01\n"));
  EXPECT_THAT(with("smoothing", "g641"), HasSubstr("\nG641 ADIS=0.01 ADISPOS=0.01\n"));
  EXPECT_THAT(with("smoothing", "g642"), Not(HasSubstr("CYCLE832")));
  EXPECT_THAT(with("block_numbers", "all"), HasSubstr("\nN10 G17 G40 G90 G94 G710\nN20 MCALL\n"));
  EXPECT_THAT(with("prove_out", "none"), Not(HasSubstr("\nM1\n")));
  EXPECT_THAT(with("prove_out", "skip_m0"), HasSubstr("\nM5\nM9\n/M0\n"));
}

TEST(SiemensProgram, AHelixOfMoreThanOneTurnIsOneBlockWithItsFurtherTurns) {
  // Five half turns and a quarter: 2.75 turns, two of them further ones, from Z1 to Z-4.5.
  EXPECT_THAT(program_of(helix_plan(5, true)), HasSubstr("\nG3 X0 Y-5 Z-4.5 I-5 J0 TURN=2 F"));
  // Two whole turns: one, and a further one; it ends where it began.
  EXPECT_THAT(program_of(helix_plan(4, false)), HasSubstr("\nG3 X5 Y0 Z-3 I-5 J0 TURN=1 F"));
  // One turn is two arcs.
  EXPECT_THAT(program_of(helix_plan(2, false)), Not(HasSubstr("TURN")));
  Plan plan = helix_plan(5, true);
  choose(plan, "turns", "no");
  EXPECT_THAT(program_of(plan), Not(HasSubstr("TURN")));
}

TEST(SiemensProgram, WithoutATolerancePathsAreExact) {
  Plan plan = pocket_plan("siemens");
  plan.machine.control.path_tolerance_mm = 0.0;
  EXPECT_THAT(program_of(plan), HasSubstr("\nCYCLE832(0,0,1)\nG60\n"));
}

TEST(SiemensProgram, WorkOffsetsBeyondG57GoOnWithG505) {
  Plan plan = pocket_plan("siemens");
  plan.setups[0].work_offset = "G505";
  EXPECT_THAT(program_of(plan), HasSubstr("\nG505\n"));
  plan.setups[0].work_offset = "G58";  // a programmed shift on this control
  EXPECT_EQ(written(plan).error().code, "OUT-SETUP");
}

TEST(SiemensProgram, AToolIsCalledByItsIdOnlyWhereThatMayBeAName) {
  Plan plan = holes_plan("siemens");
  choose(plan, "tool_call", "name");
  plan.cutters[0].id = "em 18 long";
  EXPECT_EQ(written(plan).error().code, "OUT-TOOL");
  EXPECT_TRUE(is_tool_name("generic/endmill_4f_short/12"));
  EXPECT_FALSE(is_tool_name("a\"b"));
  EXPECT_FALSE(is_tool_name(std::string(33, 'a')));
}

// A ramp has a lower speed than the cut behind it. Nothing stands between the two.
TEST(SiemensProgram, ANewSpeedWithinAPathStandsInTheBlockOfItsMove) {
  Plan plan = pocket_plan("siemens");
  model::FeedSchedule s = *plan.steps[0].schedule;
  s.spindle_rpm[3] = s.spindle_rpm[4] = 2000.0;  // the helix
  plan.steps[0].schedule = std::make_shared<const model::FeedSchedule>(std::move(s));
  const std::string text = program_of(plan);
  EXPECT_THAT(text, HasSubstr("\nG2 X6 Y0 Z-1 I3 J0 S2000\nG2 X0 Y0 Z-2.5 I-3 J0\nG1 Y-5.5 S3000\n"));
  EXPECT_THAT(text, Not(HasSubstr("S2000 M3")));
}

// 124 characters are shown; what has no room stands in the comments before it.
TEST(SiemensProgram, TheMessageOfAClampingIsWholeAndTakenAwayBehindItsStop) {
  Plan plan = pocket_plan("siemens");
  plan.setups.push_back(plan.setups[0]);
  plan.setups[1].work_offset = "G55";
  auto second = plan.steps[0];
  second.setup = 1;
  plan.steps.push_back(second);
  const std::string text = program_of(plan);
  const std::size_t at = text.find("MSG(\"set-up 2: clamp ");
  ASSERT_NE(at, std::string::npos);
  const std::string line = text.substr(at, text.find('\n', at) - at);
  EXPECT_LE(line.size(), 124 + std::string("MSG(\"\")").size());
  EXPECT_THAT(line, HasSubstr("set G55"));
  EXPECT_THAT(line, HasSubstr("then continue\")"));
  EXPECT_THAT(line, Not(HasSubstr("...")));
  EXPECT_THAT(text, HasSubstr(line + "\nM0\nMSG()\n"));
}

TEST(SiemensProgram, AnOptionThatTheControlDoesNotHaveIsRefused) {
  Plan plan = pocket_plan("siemens");
  choose(plan, "dwell", "seconds");
  EXPECT_EQ(written(plan).error().code, "OUT-OPTION");
}

// Left-hand threads have a pitch below zero; the return plane is above the reference plane.
TEST(SiemensProgram, ALeftHandTapHasItsPitchBelowZero) {
  Plan plan = holes_plan("siemens");
  auto& tap = plan.steps.back();
  model::FeedSchedule s = *tap.schedule;
  for (double& rpm : s.spindle_rpm) rpm = -rpm;
  tap.schedule = std::make_shared<const model::FeedSchedule>(std::move(s));
  EXPECT_THAT(program_of(plan),
              HasSubstr("\nMCALL CYCLE84(5,4,1,-12,,0,5,,-1,0,400,400)\nG0 X60 Y20\nMCALL\n"));
}

}  // namespace
}  // namespace capstan::controls::siemens
