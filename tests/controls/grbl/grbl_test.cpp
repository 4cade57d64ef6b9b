#include "planner/controls/grbl/grbl.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "planner/controls/controls.h"
#include "tests/controls/control_plans.h"
#include "tests/support/corpus.h"

namespace capstan::controls::grbl {
namespace {

using model::Plan;
using plans::choose;
using plans::holes_plan;
using plans::pocket_plan;
using ::testing::HasSubstr;
using ::testing::Not;

Result<std::string> written(const Plan& plan) {
  Job job;
  return write_program(plan, job);
}
std::string program_of(const Plan& plan) {
  const auto text = written(plan);
  EXPECT_TRUE(text) << (text ? "" : to_text(text.error()));
  return text.value_or("");
}
std::string golden(const char* name) {
  return capstan::testing::slurp(capstan::testing::source_dir() + "/tests/controls/grbl/golden/" + name);
}
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
