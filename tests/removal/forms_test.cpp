#include <gtest/gtest.h>

#include "tests/removal/planned.h"
#include "tests/support/corpus.h"

// A plan's three forms, read again, give its program.

namespace capstan::testing::removal {
namespace {

// Both steps of the slot of 5 mm are given the end mill of 4 mm first; roughing is faster with that of 3 mm,
// as its path shows. Sections are sampled by the smallest cutter of the plan, whichever was thought of first.
TEST(EachFormOfAPlan, GivesItsProgramWhereASmallerCutterTookTheFirstOnesPlace) {
  Part part{
      .name = "slot", .text = {}, .block = block(48, 24, 16), .target = Target{body(block(48, 24, 16))}};
  Drawing d{"SLOT", part.block};
  d.material("S235JR");
  d.slot("S", d.placement({37.5, 10, 0}), 4, d.linear_path(5, {-0.6, 0.8, 0}), d.square_u(5), "radiused",
         "radiused");
  part.text = d.text();
  part.options.tools = capstan::testing::source_dir() + "/tests/removal/random/workshop.yaml";
  const PlanOutput plan = plan_bytes(part.text, "slot.p21", part.options);
  ASSERT_FALSE(plan.linuxcnc.empty());
  EXPECT_NE(plan.json.find("\"em_3\""), std::string::npos) << "another cutter is chosen: this tests nothing";
  EXPECT_EQ(lost_in_a_form(part, plan), "");
}

// The head bores to 9.9 mm, is measured, and bores to 10 mm: two tools, and two when the plan is read again.
TEST(EachFormOfAPlan, KeepsTheTwoToolsOfOneHeadThatIsSetToTwoSizes) {
  Part part{
      .name = "bore", .text = {}, .block = block(40, 40, 16), .target = Target{body(block(40, 40, 16))}};
  Drawing d{"BORE", part.block};
  d.hole("B", d.placement({20, 20, 0}), 16, 10, d.through_bottom(), 0, 0.0045);
  part.text = d.text();
  const PlanOutput plan = plan_bytes(part.text, "bore.p21", part.options);
  ASSERT_FALSE(plan.linuxcnc.empty());
  EXPECT_NE(plan.json.find("\"generic/boring_head/8@10\""), std::string::npos)
      << "other tools are chosen: this tests nothing";
  EXPECT_EQ(lost_in_a_form(part, plan), "");
}

}  // namespace
}  // namespace capstan::testing::removal
