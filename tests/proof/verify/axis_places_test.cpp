#include "planner/proof/verify/axis_places.h"
#include "planner/ground/base/number.h"

#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "planner/ground/base/number.h"
#include "tests/proof/verify/checked.h"

namespace capstan::verify {
namespace {

constexpr std::size_t kX = 0, kY = 1, kZ = 2;
constexpr double kFar = 1e4;

/// Lines of a program of tool 1, which is 100 mm long, in G54 unless they say another.
std::string program(const std::string& lines, const std::string& length = "G43 H1\n") {
  return "G21 G17 G90 G94 G40 G49 G80\nG53 G0 Z0\nG54\nT1 M6\n" + length + "S1000 M3\nG0 X10 Y0\nG0 Z5\n" +
         lines + "G53 G0 Z0\nM5\nM2\n";
}

std::vector<model::Finding> judged(const std::string& text, const AxisPlaces& places,
                                   const std::string& table = "T1 P1 Z+100 D+10 ;mill\n") {
  const model::Machine machine = testing::good_plan().plan.machine;
  return check_axis_places({"part.ngc", text, table}, nullptr, machine, {}, places);
}

AxisPlaces within(std::size_t axis, double least, double most) {
  return {{{axis, least, most}}, {{"G54", {100.0, 200.0, -300.0}}}};
}

TEST(AxisPlaces, OfAnArcThatBulgesBeyondItsEndsTheBulgeCounts) {
  // A half circle about (0, 0) from (10, 0) by (0, 10) to (-10, 0).
  const std::string text = program("G1 Z-1 F100\nG3 X-10 Y0 I-10 J0\n");
  EXPECT_TRUE(judged(text, within(kY, 200.0, 210.0)).empty());
  const auto found = judged(text, within(kY, 200.0, 209.9));
  ASSERT_EQ(found.size(), 1U) << testing::told(found);
  EXPECT_EQ(found[0].code, "CHK-PLACE-Y");
  EXPECT_EQ(found[0].property, 22);
  EXPECT_NE(found[0].message.find("to 210 mm in machine coordinates"), std::string::npos) << found[0].message;
  EXPECT_TRUE(judged(text, within(kX, 90.0, 110.0)).empty());
  EXPECT_EQ(judged(text, within(kX, 90.1, 110.0)).size(), 1U);
}

TEST(AxisPlaces, ZIsTheGageLinesWithTheLengthOfTheTool) {
  const std::string text = program("G1 Z-20 F100\nG0 Z5\n");
  const double lowest = -300.0 - 20.0 + 100.0;
  EXPECT_TRUE(judged(text, within(kZ, lowest, 0.0)).empty());
  const auto found = judged(text, within(kZ, lowest + 0.1, 0.0));
  ASSERT_EQ(found.size(), 1U) << testing::told(found);
  EXPECT_NE(found[0].message.find("axis Z to -220 mm"), std::string::npos) << found[0].message;
  EXPECT_NE(found[0].message.find("T1 100 long"), std::string::npos) << found[0].message;
  // Without its length the same words take the gage line 100 mm lower.
  EXPECT_EQ(judged(program("G1 Z-20 F100\nG0 Z5\n", ""), within(kZ, lowest, 0.0)).size(), 1U);
}

TEST(AxisPlaces, AMoveInMachineCoordinatesSaysItsPlaceItself) {
  const std::string text = program("G1 Z-1 F100\n");
  EXPECT_TRUE(judged(text, within(kZ, -kFar, 0.0)).empty());
  const auto found = judged(text, within(kZ, -kFar, -0.5));
  ASSERT_FALSE(found.empty());
  EXPECT_NE(found[0].message.find("axis Z to 0 mm"), std::string::npos) << found[0].message;
}

TEST(AxisPlaces, WhatCannotBePlacedIsAnError) {
  const std::string text = program("G1 Z-1 F100\n");
  AxisPlaces other = within(kX, -kFar, kFar);
  other.offsets[0].name = "G55";
  const auto untold = judged(text, other);
  ASSERT_EQ(untold.size(), 1U) << testing::told(untold);
  EXPECT_NE(untold[0].message.find("where G54 lies is not told"), std::string::npos) << untold[0].message;
  other.offsets[0].name.clear();  // of whichever it names
  EXPECT_TRUE(judged(text, other).empty());
  const auto unmeasured = judged(text, within(kZ, -kFar, kFar), "T2 P2 Z+100 D+10 ;another\n");
  ASSERT_EQ(unmeasured.size(), 1U) << testing::told(unmeasured);
  EXPECT_NE(unmeasured[0].message.find("length of T1 is not known"), std::string::npos)
      << unmeasured[0].message;
}

TEST(AxisPlaces, WhereTheZeroOfZIsSetWithEachToolNoZIsHeldToALimit) {
  model::Machine machine = testing::good_plan().plan.machine;
  machine.control.dialect = "grbl";
  const auto judged_by = [&](const std::string& text, const AxisPlaces& places) {
    return check_axis_places({"part.nc", text, ""}, nullptr, machine, {}, places);
  };
  const std::string header = "(CAPSTAN TOOL T1 H1 length=100 diameter=10 id=\"em\" endmill)\n";
  const std::string top = "G53 G0 Z" + shortest(machine.axes[2].travel_max_mm) + "\n";
  const std::string off = header + program("G1 Z-1 F100\n", top),
                    stated = header + program("G1 Z-1 F100\n", top + "G43.1 Z100\n");
  // touch_off is the default.
  const auto found = judged_by(off, within(kZ, -kFar, kFar));
  ASSERT_EQ(found.size(), 1U) << testing::told(found);
  EXPECT_EQ(found[0].code, "CHK-PLACE-Z");
  EXPECT_NE(found[0].message.find("set anew with each tool"), std::string::npos) << found[0].message;
  EXPECT_TRUE(judged_by(off, within(kX, -kFar, kFar)).empty());
  machine.control_options = model::ControlOptions{{{"tool_length", "g43.1"}}};
  const auto lowest = -300.0 - 1.0 + 100.0;
  EXPECT_TRUE(judged_by(stated, within(kZ, lowest, 0.0)).empty());
  EXPECT_EQ(judged_by(stated, within(kZ, lowest + 0.1, 0.0)).size(), 1U);
}

TEST(AxisPlaces, AnOffsetOfThatNameGoesBeforeOneWithoutInBothOrders) {
  const std::string text = program("G1 Z-1 F100\n");
  AxisPlaces places = within(kX, 100.0, 120.0);
  places.offsets.push_back({"", {1000.0, 0.0, 0.0}});
  EXPECT_TRUE(judged(text, places).empty());
  std::swap(places.offsets[0], places.offsets[1]);
  EXPECT_TRUE(judged(text, places).empty());
}

TEST(AxisPlaces, OfAProgramThatIsNotFollowedNothingIsWithinLimits) {
  const auto found = judged(program("G18 G2 X12 Z5 I1\n"), within(kY, -kFar, kFar));
  ASSERT_FALSE(found.empty());
  EXPECT_EQ(found[0].code, "CHK-PLACE");
  EXPECT_EQ(found[0].move, 9);
  EXPECT_NE(found[0].message.find("not all of the program is followed"), std::string::npos)
      << found[0].message;
}

}  // namespace
}  // namespace capstan::verify
