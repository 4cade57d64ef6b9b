#include "planner/controls/fanuc/fanuc.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <regex>
#include <sstream>

#include "planner/controls/controls.h"
#include "tests/controls/control_plans.h"
#include "tests/support/canon.h"
#include "tests/support/corpus.h"
#include "tests/support/rs274.h"

namespace capstan::controls::fanuc {
namespace {

using model::CutterPath;
using model::MoveRole;
using model::Plan;
using plans::choose;
using plans::holes_plan;
using plans::plan_for;
using plans::pocket;
using plans::pocket_plan;
using plans::program_of;
using plans::written;
using ::testing::HasSubstr;
using ::testing::Not;

std::string golden(const char* name) { return plans::golden("fanuc", name); }

TEST(FanucGolden, APocketIsWrittenAsReviewed) {
  EXPECT_EQ(program_of(pocket_plan("fanuc")), golden("pocket.nc"));
  EXPECT_EQ(program_of(pocket_plan("haas")), golden("pocket_haas.nc"));
}

TEST(FanucGolden, HolesAreWrittenAsReviewedWithCyclesAndWithExplicitMoves) {
  EXPECT_EQ(program_of(holes_plan("fanuc")), golden("holes_cycles.nc"));
  EXPECT_EQ(program_of(holes_plan("haas")), golden("holes_haas.nc"));
  Plan plan = holes_plan("fanuc");
  choose(plan, "cycles", "explicit");
  EXPECT_EQ(program_of(plan), golden("holes_explicit.nc"));
}

TEST(FanucProgram, EqualHolesOfAStepAreFurtherPlacesOfOneCycle) {
  EXPECT_THAT(program_of(plans::pattern_plan("fanuc", {{10, 10}, {86, 10}, {10, 70}, {86, 70}})),
              HasSubstr("\nG98 G81 X10. Y10. Z-18.2 R2. F180.\nX86.\nX10. Y70.\nX86.\nG80\n"));
}

TEST(FanucProgram, EqualPecksFromRAreACycleWhereTheMachineSaysWhereItComesBackTo) {
  Plan plan = plans::pecked_plan("fanuc", {-4, -14, -22.4}, true);
  EXPECT_THAT(program_of(plan), Not(HasSubstr("G83")));
  choose(plan, "peck_clearance_mm", "0.2");
  EXPECT_THAT(program_of(plan), HasSubstr("\nG98 G83 X20. Y20. Z-22.4 R6. Q10. F180.\nG80\n"));
  // A first peck of 14 mm and then 10 is no cycle of this control.
  Plan other = plans::pecked_plan("fanuc", {-8, -18, -22.4}, true);
  choose(other, "peck_clearance_mm", "0.2");
  EXPECT_THAT(program_of(other), Not(HasSubstr("G83")));
}

TEST(FanucProgram, AChipIsBrokenByACycleOnlyWhereTheMachineComesUpAsFarAsThePlan) {
  // From 2: pecks of 8 mm, 0.5 up.
  Plan plan = plans::pecked_plan("fanuc", {-6, -14, -22}, false);
  choose(plan, "chip_break_mm", "0.5");
  EXPECT_THAT(program_of(plan), HasSubstr("\nG98 G73 X20. Y20. Z-22. R2. Q8. F180.\nG80\n"));
  Plan less = plans::pecked_plan("fanuc", {-6, -14, -22}, false);
  choose(less, "chip_break_mm", "0.4");
  EXPECT_THAT(program_of(less), Not(HasSubstr("G73")));
}

TEST(FanucProgram, AFirstPeckOfItsOwnIsSaidToAHaas) {
  Plan plan = plans::pecked_plan("haas", {-10, -18, -22.4}, true);
  EXPECT_THAT(program_of(plan), Not(HasSubstr("G83")));
  choose(plan, "peck_clearance_mm", "0.5");
  // From 6: 16, and 8 less to 8.
  EXPECT_THAT(program_of(plan), HasSubstr("\nG98 G83 X20. Y20. Z-22.4 R6. I16. J8. K8. F180.\nG80\n"));
  Plan chips = plans::pecked_plan("haas", {-10, -18, -22.4}, false);
  choose(chips, "peck_clearance_mm", "0.5");
  EXPECT_THAT(program_of(chips), HasSubstr("\nG98 G73 X20. Y20. Z-22.4 R2. I12. J4. K8. F180.\nG80\n"));
}

TEST(FanucProgram, ABarThatComesOutWithTheSpindleStoppedIsG86) {
  for (const char* dialect : {"fanuc", "haas"})
    EXPECT_THAT(program_of(plans::bored_plan(dialect)),
                HasSubstr("\nG98 G86 X20. Y20. Z-18.2 R2. F180.\nG80\nM5\n"))
        << dialect;
}

TEST(FanucProgram, EachOptionOfTheMachineChangesWhatItSays) {
  const auto with = [](const char* name, const char* value) {
    Plan plan = holes_plan("fanuc");
    choose(plan, name, value);
    return program_of(plan);
  };
  EXPECT_THAT(with("retract", "g28"), HasSubstr("\nG91 G28 Z0.\nG90 G49\n"));
  EXPECT_THAT(with("tap", "g84"), Not(HasSubstr("M29")));
  EXPECT_THAT(with("tap_feed", "per_minute"),
              HasSubstr("\nM29 S400\nG98 G84 X60. Y20. Z-12. R5. F400.\nG80\n"));
  EXPECT_THAT(with("dwell", "seconds"), HasSubstr("\nG4 P1.5\n"));
  EXPECT_THAT(with("next_tool", "called"), Not(HasSubstr("\nT4\n")));
  EXPECT_THAT(with("block_numbers", "all"), HasSubstr("%\nO0001\n"));
  EXPECT_THAT(with("block_numbers", "all"), HasSubstr("\nN20 G17 G40 G80 G90 G94 G98\n"));
  EXPECT_THAT(with("block_numbers", "none"), Not(HasSubstr("\nN")));
  EXPECT_THAT(with("program_number", "1234"), HasSubstr("%\nO1234\n"));
  EXPECT_THAT(with("prove_out", "none"), Not(HasSubstr("\nM1\n")));
  EXPECT_THAT(with("prove_out", "m0"), HasSubstr("\nM5\nM9\nM0\n"));
  EXPECT_THAT(with("prove_out", "skip_m0"), HasSubstr("\nM5\nM9\n/M0\n"));
  EXPECT_THAT(with("comments", "mixed"), HasSubstr("(CAPSTAN STEP id=\"H1$20drill\" n=1 tool=3 setup=1)"));
}

TEST(FanucProgram, NumbersAStepOnlyWhereARestartCallsItsTool) {
  // H1 and H2 share T3: a restart at H2 would drill with whatever is in the spindle.
  const std::string text = program_of(holes_plan("fanuc"));
  EXPECT_THAT(text, HasSubstr("\nN1 G21\n"));
  EXPECT_THAT(text, HasSubstr("\nN3 G21\n"));
  EXPECT_THAT(text, Not(HasSubstr("\nN2 ")));
}

TEST(FanucProgram, ABlockThatMayBeSkippedHasItsSlashBeforeItsNumber) {
  Plan plan = holes_plan("fanuc");
  choose(plan, "prove_out", "skip_m0");
  choose(plan, "block_numbers", "all");
  const std::string text = program_of(plan);
  EXPECT_TRUE(std::regex_search(text, std::regex(R"(\n/N\d+ M0\n)"))) << text;
  EXPECT_THAT(text, Not(HasSubstr(" /M0")));
}

TEST(FanucProgram, StatesTheReturnToTheInitialLevelInItsSafeStart) {
  EXPECT_THAT(program_of(pocket_plan("fanuc")), HasSubstr("\nG17 G40 G80 G90 G94 G98\n"));
}

TEST(FanucProgram, NoCommentLosesItsEndWhereLinesAreShort) {
  const auto words_of_comments = [](const std::string& program) {
    std::string out;
    for (const char c : program) out += c == '(' || c == ')' || c == '\n' ? ' ' : c;
    std::istringstream all(out);
    std::vector<std::string> words;
    for (std::string w; all >> w;) words.push_back(w);
    return words;
  };
  Plan plan = pocket_plan("fanuc");
  const auto longest = words_of_comments(program_of(plan));
  choose(plan, "line_length", "72");
  EXPECT_EQ(words_of_comments(program_of(plan)), longest);
}

TEST(FanucProgram, SmoothsMillingStepsOnlyWhereTheMachineSaysThatItCan) {
  Plan plan = pocket_plan("fanuc");
  EXPECT_THAT(program_of(plan), Not(HasSubstr("G5.1")));
  choose(plan, "ai_contour", "yes");
  const std::string text = program_of(plan);
  EXPECT_THAT(text, HasSubstr("\nM8\nG0 G43 H1 Z10.\nG5.1 Q1\nG0 Z2.\n"));
  EXPECT_THAT(text, HasSubstr("\nG0 Z10.\nG5.1 Q0\n"));
}

TEST(FanucProgram, ArcsEndAtQuadrantsWhereTheMachineSaysSo) {
  Plan plan = pocket_plan("fanuc");
  choose(plan, "arcs", "quadrant");
  // The half turn about (0, 0) ends at the top first.
  EXPECT_THAT(program_of(plan), HasSubstr("\nG3 X0. Y15.123 I-15.123 J0.\nG3 X-15.123 Y0. I0. J-15.123\n"));
}

TEST(FanucProgram, WhatTheControlDoesNotTakeIsNamedByWorkingstep) {
  Plan plan = pocket_plan("fanuc");
  testing::add_step(plan, "second pocket", "em18", pocket());
  choose(plan, "helices", "no");
  const auto text = written(plan);
  ASSERT_FALSE(text);
  EXPECT_EQ(text.error().code, "OUT-CONTROL");
  EXPECT_THAT(text.error().message, HasSubstr("step 'rough pocket', move 3: an arc that goes up or down"));
  EXPECT_THAT(text.error().message, HasSubstr("step 'second pocket', move 3"));
}

TEST(FanucProgram, AnArcLargerThanTheControlTakesIsNamedByWorkingstep) {
  Plan plan = pocket_plan("fanuc");
  choose(plan, "largest_radius_mm", "10");
  const auto text = written(plan);
  ASSERT_FALSE(text);
  EXPECT_EQ(text.error().code, "OUT-CONTROL");
  EXPECT_THAT(text.error().message, HasSubstr("step 'rough pocket', move 9: an arc of radius 15.123 mm"));
}

TEST(FanucProgram, ACodeThatTheMachineLacksIsNamedByWorkingstep) {
  Plan plan = holes_plan("fanuc");
  choose(plan, "codes",
         "G0 G1 G4 G17 G21 G40 G43 G49 G53 G54 G64 G80 G81 G82 G85 G90 G94 G95 G98 M0 M1 M3 M5 M6 M8 M9 M30");
  const auto text = written(plan);
  ASSERT_FALSE(text);
  EXPECT_EQ(text.error().code, "OUT-CODE");
  EXPECT_THAT(text.error().message, HasSubstr("M29 in step ID=\"H4$20<TAP>\""));
  EXPECT_THAT(text.error().message, HasSubstr("G84 in step"));
  EXPECT_THAT(text.error().message, Not(HasSubstr("G81")));
}

TEST(FanucProgram, WorkOffsetsBeyondG59AreWrittenWhereTheMachineHasThem) {
  Plan plan = pocket_plan("fanuc");
  plan.setups[0].work_offset = "G54.1P2";
  EXPECT_EQ(written(plan).error().code, "OUT-SETUP");
  choose(plan, "extended_offsets", "48");
  EXPECT_THAT(program_of(plan), HasSubstr("\nG54.1P2\n"));
  Plan haas = pocket_plan("haas");
  haas.setups[0].work_offset = "G154P7";
  EXPECT_THAT(program_of(haas), HasSubstr("\nG154P7\n"));
}

TEST(FanucProgram, AnOptionThatTheControlDoesNotHaveIsRefused) {
  Plan plan = pocket_plan("fanuc");
  choose(plan, "smoothness", "yes");
  const auto text = written(plan);
  ASSERT_FALSE(text);
  EXPECT_EQ(text.error().code, "OUT-OPTION");
}

TEST(FanucProgram, EqualHolesOfExplicitMovesAreCallsOfASubprogramWhereTheMachineStatesItsNumber) {
  const auto with = [](const std::vector<geometry::Vec2>& places) {
    Plan plan = plans::pattern_plan("fanuc", places);
    plan.machine.control_options = model::ControlOptions{{{"cycles", "explicit"}, {"subprograms", "7001"}}};
    return program_of(plan);
  };
  const std::vector<geometry::Vec2> four{{10, 10}, {86, 10}, {10, 70}, {86, 70}};
  const std::string text = with(four);
  EXPECT_THAT(text,
              HasSubstr("\nM98 P7001\nG0 X86.\nM98 P7001\nG0 X10. Y70.\nM98 P7001\nG0 X86.\nM98 P7001\n"));
  EXPECT_THAT(text, HasSubstr("\nM30\nO7001\nG0 Z2.\nG1 Z-18.2 F180.\nG0 Z10.\nM99\n%\n"));
  Plan unstated = plans::pattern_plan("fanuc", four);
  choose(unstated, "cycles", "explicit");
  EXPECT_THAT(program_of(unstated), Not(HasSubstr("M98")));
  EXPECT_THAT(with({{10, 10}, {86, 10}}), Not(HasSubstr("M98")));
  Plan numbered = plans::pattern_plan("fanuc", four);
  numbered.machine.control_options =
      model::ControlOptions{{{"cycles", "explicit"}, {"subprograms", "7001"}, {"block_numbers", "all"}}};
  EXPECT_THAT(program_of(numbered), Not(HasSubstr("M98")));
}

/// Four equal holes, and in a second step four that go to -9.
Plan two_patterns() {
  const std::vector<geometry::Vec2> four{{10, 10}, {86, 10}, {10, 70}, {86, 70}};
  Plan plan = plans::pattern_plan("fanuc", four);
  CutterPath p;
  p.start({10, 10, 10});
  for (const geometry::Vec2 at : four) {
    if (at != four.front()) p.rapid({at.x, at.y, 10});
    p.rapid({at.x, at.y, 2});
    p.line({at.x, at.y, -9}, MoveRole::kDrill);
    p.rapid({at.x, at.y, 10}, MoveRole::kRetract);
  }
  testing::add_step(plan, "shallow pattern", "d8", std::move(p), 1200, 180);
  choose(plan, "cycles", "explicit");
  return plan;
}

// Haas 96-8000, M98: it calls a program of the control's list, not one behind M30 of the file.
TEST(FanucProgram, AHaasHasNoSubprogramsInItsFile) {
  Plan plan = plans::pattern_plan("haas", {{10, 10}, {86, 10}, {10, 70}, {86, 70}});
  choose(plan, "cycles", "explicit");
  EXPECT_THAT(program_of(plan), Not(HasSubstr("M98")));
  choose(plan, "subprograms", "7001");
  const auto text = written(plan);
  ASSERT_FALSE(text);
  EXPECT_EQ(text.error().code, "OUT-OPTION");
  EXPECT_THAT(text.error().message, HasSubstr("subprograms"));
}

// FANUC B-63844EN/02, 12.1: O9000 and up are the machine builder's, O8000 and up can be locked.
TEST(FanucProgram, NoSubprogramHasANumberAbove7999) {
  Plan plan = two_patterns();
  choose(plan, "subprograms", "7998");
  EXPECT_THAT(program_of(plan), HasSubstr("\nO7999\nG0 Z2.\nG1 Z-9. F180.\nG0 Z10.\nM99\n%\n"));
  plan = two_patterns();
  choose(plan, "subprograms", "7999");
  const std::string last = program_of(plan);
  EXPECT_THAT(last, HasSubstr("\nM98 P7999\n"));
  EXPECT_THAT(last, Not(HasSubstr("M98 P8000")));
  EXPECT_THAT(last, HasSubstr("\nG1 Z-9. F180.\nG0 Z10.\nG0 X86.\n"));
  for (const char* number : {"0", "8000", "9001"}) {
    plan = two_patterns();
    choose(plan, "subprograms", number);
    const auto text = written(plan);
    ASSERT_FALSE(text) << number;
    EXPECT_EQ(text.error().code, "OUT-OPTION");
    EXPECT_THAT(text.error().message, HasSubstr("no whole number from 1 to 7999"));
  }
}

TEST(FanucProgram, AProgramWithTheNumberOfOneOfItsSubprogramsIsRefused) {
  for (const char* number : {"7001", "7002"}) {
    Plan plan = two_patterns();
    choose(plan, "subprograms", "7001");
    choose(plan, "program_number", number);
    const auto text = written(plan);
    ASSERT_FALSE(text) << number;
    EXPECT_EQ(text.error().code, "OUT-OPTION");
    EXPECT_THAT(text.error().message, HasSubstr("program_number: O" + std::string(number)));
    EXPECT_THAT(text.error().message, HasSubstr("O7001 to O7002"));
    EXPECT_THAT(text.error().hint, HasSubstr("another program_number"));
  }
  for (const char* number : {"7000", "7003"}) {
    Plan plan = two_patterns();
    choose(plan, "subprograms", "7001");
    choose(plan, "program_number", number);
    EXPECT_THAT(program_of(plan), HasSubstr("%\nO" + std::string(number) + "\n"));
  }
}

TEST(FanucProgram, ADrillThatPecksIsWrittenWithItsOwnMoves) {
  Plan plan = holes_plan("fanuc");
  CutterPath p;
  p.start({20, 20, 10});
  p.rapid({20, 20, 2});
  p.line({20, 20, -5}, MoveRole::kDrill);
  p.rapid({20, 20, 10}, MoveRole::kRetract);
  p.line({20, 20, -4.5}, MoveRole::kLink);
  p.line({20, 20, -10}, MoveRole::kDrill);
  p.rapid({20, 20, 10}, MoveRole::kRetract);
  testing::add_step(plan, "H5 peck", "d8", std::move(p), 1200, 180);
  const std::string text = program_of(plan);
  EXPECT_THAT(text, Not(HasSubstr("G83")));
  EXPECT_THAT(text, HasSubstr("\nG0 Z10.\nG1 Z-4.5\nG1 Z-10.\nG0 Z10.\n"));
}

/// Without the program's number, which is a subroutine's name to LinuxCNC.
std::string for_linuxcnc(std::string text) {
  const std::size_t at = text.find("\nO");
  return text.erase(at, text.find('\n', at + 1) - at);
}

/// Feeds and arcs: rapids to the top come out at other heights, for G49 takes the length away before.
std::vector<testing::CanonMove> fed(const std::string& output) {
  auto moves = testing::motion_below(testing::read_canon(output).moves, 9.9);
  std::erase_if(moves, [](const auto& m) { return m.kind == testing::CanonMove::Kind::kTraverse; });
  return moves;
}

TEST(FanucInterpreter, LinuxCncMakesTheSameFeedsAndArcsOfItAsOfItsOwnProgramInWhatBothShare) {
  CAPSTAN_NEEDS_RS274();
  for (Plan plan : {pocket_plan("fanuc"), holes_plan("fanuc")}) {
    // G85 feeds to R only, and M29 is FANUC's.
    while (plan.steps.size() > 2) plan.steps.pop_back();
    Plan own = plan;
    own.machine.control.dialect = "linuxcnc";
    const std::string table = tool_table_of(own);
    const auto a = testing::run_rs274(table, for_linuxcnc(program_of(plan)));
    const auto b = testing::run_rs274(table, program_of(own));
    ASSERT_EQ(a.status, 0) << a.output;
    const auto fanuc = fed(a.output), linuxcnc = fed(b.output);
    ASSERT_EQ(fanuc.size(), linuxcnc.size()) << a.output;
    EXPECT_GE(fanuc.size(), 2u);
    for (std::size_t i = 0; i < fanuc.size(); ++i) {
      EXPECT_EQ(fanuc[i].kind, linuxcnc[i].kind) << i;
      for (const auto& [x, y] : {std::pair(fanuc[i].x, linuxcnc[i].x), std::pair(fanuc[i].y, linuxcnc[i].y),
                                 std::pair(fanuc[i].z, linuxcnc[i].z), std::pair(fanuc[i].cx, linuxcnc[i].cx),
                                 std::pair(fanuc[i].cy, linuxcnc[i].cy)})
        EXPECT_NEAR(x, y, 0.002) << i;
      EXPECT_EQ(fanuc[i].feed_mm_min, linuxcnc[i].feed_mm_min) << i;
    }
  }
}

TEST(FanucComments, HaveNoCharacterThatEndsTheTapeOrTheBlock) {
  EXPECT_EQ(comment_text("5 % wide; id=\"a%20B$<\"", true), "5 PERCENT WIDE, ID=\"<A$20>B$24$3C\"");
  EXPECT_EQ(comment_text("5 % wide; id=\"a%20B\"", false), "5 percent wide, id=\"a$20B\"");
}

}  // namespace
}  // namespace capstan::controls::fanuc
