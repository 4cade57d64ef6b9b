#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "planner/controls/linuxcnc/linuxcnc.h"
#include "tests/support/empty_plan.h"
#include "tests/support/rs274.h"

// Programs that are written although the check condemns them.

namespace capstan::controls::linuxcnc {
namespace {

using model::CutterPath;
using model::MoveRole;
using model::Plan;
using ::testing::HasSubstr;
using testing::Rs274Run;

CutterPath contour() {
  CutterPath p;
  p.start({-12, -12, 5});
  p.rapid({-12, -12, 1});
  p.line({-12, -12, -3}, MoveRole::kPlunge);
  p.line({50, -12, -3}, MoveRole::kCut);
  p.rapid({50, -12, 5}, MoveRole::kRetract);
  return p;
}

std::size_t position(const std::string& text, const std::string& what, std::size_t from = 0) {
  const auto at = text.find(what, from);
  EXPECT_NE(at, std::string::npos) << what << " in\n" << text;
  return at;
}

TEST(LinuxCnc, ACondemnedStepSaysSoInHeaderAndMarkerAndIsStoppedBefore) {
  Plan plan = testing::empty_plan();
  testing::add_step(plan, "a", "em18", contour());
  testing::add_step(plan, "b", "em18", contour());
  testing::add_step(plan, "c", "em18", contour());
  Job job;
  const auto text = kDialect.write_program(plan, job, {{"b", "CHK-GOUGE", "gouges (by 2 mm)"}});
  ASSERT_TRUE(text) << to_text(text.error());
  EXPECT_LT(position(*text, "(CONDEMNED: step 2 b: gouges [by 2 mm])\n"), position(*text, "G21"));
  EXPECT_THAT(*text, HasSubstr("G53 G0 Z0\nM5\nM9\n"
                               "(CAPSTAN STEP id=\"b\" n=2 tool=1 setup=1 condemned=\"CHK-GOUGE\")\n"
                               "(CONDEMNED: gouges [by 2 mm])\n"
                               "(MSG, condemned step 2: gouges [by 2 mm]; continue at your own risk)\n"
                               "M0\n"
                               "G21 G17 G90 G94 G40 G80\n"));
  EXPECT_THAT(*text, HasSubstr("(CAPSTAN STEP id=\"a\" n=1 tool=1 setup=1)\nG21"));
  EXPECT_THAT(*text, HasSubstr("(CAPSTAN STEP id=\"c\" n=3 tool=1 setup=1)\nG21"));
  // What condemns the whole plan stops it before its first step.
  const auto whole = kDialect.write_program(plan, job, {{"", "CHK-ORDER", "order"}});
  ASSERT_TRUE(whole);
  EXPECT_THAT(*whole, HasSubstr("n=1 tool=1 setup=1 condemned=\"CHK-ORDER\")\n(CONDEMNED: order)\n(MSG, "));
  EXPECT_EQ(whole->find("M0\n", position(*whole, "M0\n") + 1), std::string::npos);
}

TEST(LinuxCnc, TheInterpreterTakesAProgramWithCondemnedSteps) {
  CAPSTAN_NEEDS_RS274();
  Plan plan = testing::empty_plan();
  testing::add_step(plan, "a", "em18", contour());
  testing::add_step(plan, "b", "em18", contour());
  Job job;
  const std::string long_text(500, 'x');
  const auto text = kDialect.write_program(
      plan, job, {{"a", "CHK-A", long_text}, {"b", "CHK-B", "(#<_x>; %"}, {"b", "CHK-C", long_text}});
  ASSERT_TRUE(text) << to_text(text.error());
  const Rs274Run ran = testing::run_rs274(write_tool_table(plan), *text);
  EXPECT_EQ(ran.status, 0) << ran.output;
  EXPECT_EQ(ran.only({"PROGRAM_STOP"}).size(), 2u) << ran.output;
}

}  // namespace
}  // namespace capstan::controls::linuxcnc
