#include "planner/controls/mach3/mach3.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "planner/controls/controls.h"
#include "tests/controls/control_plans.h"

namespace capstan::controls::mach3 {
namespace {

using model::Plan;
using plans::choose;
using plans::holes_plan;
using plans::pocket_plan;
using plans::program_of;
using plans::written;
using ::testing::HasSubstr;
using ::testing::Not;

std::string golden(const char* name) { return plans::golden("mach3", name); }
/// Those that Mach3 makes: no tap.
Plan drilled_plan() {
  Plan plan = holes_plan("mach3");
  plan.steps.pop_back();
  return plan;
}

TEST(Mach3Golden, APocketAndHolesAreWrittenAsReviewed) {
  EXPECT_EQ(program_of(pocket_plan("mach3")), golden("pocket.tap"));
  EXPECT_EQ(program_of(drilled_plan()), golden("holes.tap"));
}

TEST(Mach3Program, SaysHowCentresOfArcsCountAtItsHeadAndAtEachStep) {
  const std::string text = program_of(pocket_plan("mach3"));
  EXPECT_THAT(text, HasSubstr("\nG21 G17 G90 G91.1 G94 G40 G49 G80\n"));
  EXPECT_THAT(text, HasSubstr("\nG21 G17 G90 G91.1 G94 G40 G80\n"));
}

TEST(Mach3Program, HolesAreCyclesAndPecksAreMoves) {
  const std::string text = program_of(drilled_plan());
  EXPECT_THAT(text, HasSubstr("\nG98 G81 X20 Y20 Z-18.2 R2 F180\nG80\n"));
  EXPECT_THAT(text, HasSubstr("\nG98 G82 X40 Y20 Z-18.2 R2 P0.35 F180\nG80\n"));
  EXPECT_THAT(text, HasSubstr("\nG98 G85 X20 Y20 Z-18.2 R2 F180\nG80\n"));
  EXPECT_THAT(program_of(plans::pecked_plan("mach3", {-4, -14, -22.4}, true)), Not(HasSubstr("G83")));
  EXPECT_THAT(program_of(plans::bored_plan("mach3")),
              HasSubstr("\nG98 G86 X20 Y20 Z-18.2 R2 P0 F180\nG80\nM5\n"));
}

TEST(Mach3Program, WaitsInTheUnitOfTheMachinesSetting) {
  Plan plan = drilled_plan();
  EXPECT_THAT(program_of(plan), HasSubstr("\nG4 P1.5\n"));
  choose(plan, "dwell", "milliseconds");
  EXPECT_THAT(program_of(plan), HasSubstr("\nG4 P1500\n"));
  EXPECT_THAT(program_of(plan), HasSubstr(" P350 F180\n"));
}

TEST(Mach3Program, HasNoWordForATolerance) {
  EXPECT_THAT(program_of(pocket_plan("mach3")), HasSubstr("\nG64\n"));
  Plan plan = pocket_plan("mach3");
  plan.machine.control.path_tolerance_mm = 0.0;
  EXPECT_THAT(program_of(plan), HasSubstr("\nG61\n"));
}

TEST(Mach3Program, ATapIsRefusedWithWhatToDo) {
  const auto refused = written(holes_plan("mach3"));
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, "OUT-TAP");
  EXPECT_THAT(refused.error().path, HasSubstr("H4 tap"));
}

}  // namespace
}  // namespace capstan::controls::mach3
