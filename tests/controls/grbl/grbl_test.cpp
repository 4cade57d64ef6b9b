#include "planner/controls/grbl/grbl.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "planner/controls/controls.h"
#include "planner/ground/base/number.h"
#include "tests/controls/control_plans.h"
#include "tests/support/corpus.h"

namespace capstan::controls::grbl {
namespace {

using model::Plan;
using plans::choose;
using plans::holes_plan;
using plans::pocket_plan;
using plans::program_of;
using plans::written;
using ::testing::HasSubstr;
using ::testing::Not;

std::string golden(const char* name) { return plans::golden("grbl", name); }
/// Those that Grbl makes: no tap.
Plan drilled_plan() {
  Plan plan = holes_plan("grbl");
  plan.steps.pop_back();
  return plan;
}

TEST(GrblGolden, APocketIsWrittenAsReviewed) {
  EXPECT_EQ(program_of(pocket_plan("grbl")), golden("pocket.gcode"));
}

TEST(GrblGolden, HolesAreWrittenAsReviewedWithTouchedOffAndWithStatedLengths) {
  EXPECT_EQ(program_of(drilled_plan()), golden("holes_touch_off.gcode"));
  Plan plan = drilled_plan();
  choose(plan, "tool_length", "g43.1");
  choose(plan, "tool_change", "m0");
  EXPECT_EQ(program_of(plan), golden("holes_stated.gcode"));
}

TEST(GrblProgram, ATapIsRefusedWithWhatToDo) {
  const auto refused = written(holes_plan("grbl"));
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, "OUT-TAP");
  EXPECT_THAT(refused.error().path, HasSubstr("H4 tap"));
  EXPECT_THAT(refused.error().hint, HasSubstr("thread mill"));
}

Plan two_setups_with_one_tool() {
  Plan plan = pocket_plan("grbl");
  plan.setups.push_back({.setup = {}, .work_offset = "G55", .security_z_mm = 30.0});
  capstan::testing::add_step(plan, "finish pocket", "em18", plans::pocket(), 3000.4).setup = 1;
  return plan;
}

// The length of a touched-off tool is in the zero of Z of one work offset.
TEST(GrblProgram, ASetUpThatGoesOnWithTheSameToolHasItTouchedOffInItsWorkOffset) {
  Plan plan = two_setups_with_one_tool();
  const std::string text = program_of(plan);
  const std::string second = text.substr(text.find("CAPSTAN STEP id=\"finish%20pocket\""));
  const std::string again = "\nG55\n(T1 em18 stays: set the zero of Z of G55 with it)\nT1 M6\nG53 G0 Z" +
                            trimmed(plan.machine.axes[2].travel_max_mm, 3) + "\n";
  EXPECT_THAT(second, HasSubstr(again));
  EXPECT_LT(second.find(again), second.find("\nG0 X"));
  // Within a set-up it goes on, and so it does where its length is stated.
  plan.steps[1].setup = 0;
  EXPECT_THAT(program_of(plan), Not(HasSubstr("stays")));
  plan.steps[1].setup = 1;
  choose(plan, "tool_length", "g43.1");
  EXPECT_THAT(program_of(plan), Not(HasSubstr("stays")));
}

// Grbl refuses to jog in the hold of M0.
TEST(GrblProgram, TouchingOffAtM0IsRefusedWithWhatToDo) {
  Plan plan = pocket_plan("grbl");
  choose(plan, "tool_change", "m0");
  const auto refused = written(plan);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, "OUT-CONTROL");
  EXPECT_THAT(refused.error().message, HasSubstr("jog"));
  EXPECT_THAT(refused.error().hint, HasSubstr("tool_length: g43.1"));
  choose(plan, "tool_length", "g43.1");
  EXPECT_TRUE(written(plan));
}

TEST(GrblProgram, AProgramOfMoreThanOneSetUpSaysWhoKeepsM0) {
  EXPECT_THAT(program_of(two_setups_with_one_tool()), HasSubstr("have what sends it keep M0 to itself"));
  EXPECT_THAT(program_of(pocket_plan("grbl")), Not(HasSubstr("M0 to itself")));
}

TEST(GrblProgram, MistIsRefusedWhereM7IsNotCompiledIn) {
  Plan plan = pocket_plan("grbl");
  plan.steps[0].mist = true;
  const auto refused = written(plan);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, "OUT-CONTROL");
  EXPECT_EQ(refused.error().path, "rough pocket");
  EXPECT_THAT(refused.error().hint, HasSubstr("mist: yes"));
  choose(plan, "mist", "yes");
  EXPECT_THAT(program_of(plan), HasSubstr("\nM7\n"));
}

// Grbl takes them out of its input as commands, in comments as elsewhere.
TEST(GrblProgram, NoCommentHoldsACharacterThatIsACommand) {
  Plan plan = pocket_plan("grbl");
  plan.file_name = "what? a part! ~1.p21";
  plan.cutters[0].id = "mill!?~";
  plan.steps[0].cutter_id = "mill!?~";
  const std::string text = program_of(plan);
  EXPECT_EQ(text.find_first_of("!?~"), std::string::npos) << text;
  EXPECT_THAT(text, HasSubstr("id=\"mill%21%3F%7E\""));
}

TEST(GrblProgram, HasNoWordThatGrblRefuses) {
  for (const Plan& plan : {pocket_plan("grbl"), drilled_plan()}) {
    const std::string text = program_of(plan);
    for (const char* other : {"G43 H", "G64", "G81", "G98", "\nM1\n", "\n%"})
      EXPECT_THAT(text, Not(HasSubstr(other)));
  }
}

}  // namespace
}  // namespace capstan::controls::grbl
