#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "tests/removal/sheet.h"

// Inside corners that are drawn sharp: what stays in them is told, and is an error where it is too much.

namespace capstan::testing::removal {
namespace {

TEST(SharpCorners, AnOutsidesInnerCornerKeepsThreeMillimetresAndThePlanSaysSo) {
  Sheet s;
  const auto l =
      s.d.polyline({{0, 0, 0}, {50, 0, 0}, {50, 20, 0}, {20, 20, 0}, {20, 50, 0}, {0, 50, 0}, {0, 0, 0}});
  s.d.outside("O", s.d.placement({5, 5, 0}), 10, s.d.closed(l));
  const PlanOutput o = s.planned();
  EXPECT_EQ(o.unplanned, 0U) << told(o);
  // 3 mm, for a sixth of 10 mm is less; nowhere else does solid stand all round a corner.
  EXPECT_NE(told(o).find("its inner corner at (25, 25, 0) is drawn sharp, and a radius of 3 mm"),
            std::string::npos)
      << told(o);
  for (const auto& f : o.findings) EXPECT_NE(f.severity, "error") << f.text;
}

TEST(SharpCorners, AStepsEndsWithinTheBlockKeepThreeMillimetresAndThePlanSaysSo) {
  Sheet s;
  s.d.step("A", s.d.placement({30, 10, 0}), 3, 40, {0, 1, 0});
  const PlanOutput o = s.planned();
  EXPECT_EQ(o.unplanned, 0U) << told(o);
  EXPECT_NE(
      told(o).find("its inner corners at (30, 10, 0), (30, 50, 0) are drawn sharp, and a radius of 3 mm"),
      std::string::npos)
      << told(o);
  for (const auto& f : o.findings) EXPECT_NE(f.severity, "error") << f.text;
}

TEST(SharpCorners, AStepAcrossTheWholeBlockHasNone) {
  Sheet s;
  s.d.step("A", s.d.placement({30, 0, 0}), 3, 60, {0, 1, 0});
  EXPECT_EQ(told(s.planned()).find("PIP-CORNER"), std::string::npos);
}

TEST(SharpCorners, ASlotsSquareEndsKeepTheMillsRadiusAndPlanAndCheckSaySo) {
  Sheet s;
  s.d.slot("S", s.d.placement({30, 15, 0}), 5, s.d.linear_path(30, {0, 1, 0}), s.d.square_u(8), "flat",
           "flat");
  const PlanOutput o = s.planned();
  EXPECT_EQ(o.unplanned, 0U) << told(o);
  EXPECT_NE(
      told(o).find("its flat end at (30, 15, 0) is square, and solid stands beyond it, and a mill leaves"),
      std::string::npos)
      << told(o);
  EXPECT_NE(told(o).find("finding warning CHK-REST"), std::string::npos) << told(o);
  for (const auto& f : o.findings) EXPECT_NE(f.severity, "error") << f.text;
}

TEST(SharpCorners, AMemberOfAPatternKeepsWhatTheOthersKeep) {
  Sheet s;
  const auto base = s.d.closed_pocket("P", s.d.placement({0, 0, 0}), 8, s.d.rectangle(16, 12), 0.2);
  s.d.rectangular_pattern("PATTERN", s.d.placement({18, 30, 0}), base, 24, {1, 0, 0}, 2, 1, 0, {0, 1, 0});
  const PlanOutput o = s.planned();
  EXPECT_EQ(o.unplanned, 0U) << told(o);
  EXPECT_NE(told(o).find("feature 'PATTERN[1]': in its inside corners"), std::string::npos) << told(o);
  EXPECT_NE(told(o).find("feature 'PATTERN[2]': in its inside corners"), std::string::npos) << told(o);
  EXPECT_NE(told(o).find("CHK-REST"), std::string::npos) << told(o);
  for (const auto& f : o.findings) EXPECT_NE(f.severity, "error") << f.text;
}

TEST(SharpCorners, AClosedPocketThatStatesNoRadiusKeepsThreeMillimetresAndThePlanSaysSo) {
  Sheet s;
  s.d.closed_pocket("P", s.d.placement({30, 30, 0}), 8, s.d.rectangle(40, 30), 0);
  const PlanOutput o = s.planned();
  EXPECT_EQ(o.unplanned, 0U) << told(o);
  // At a corner 40 / 2 and 30 / 2 mm from the middle; 3 mm, for a sixth of 8 mm is less.
  for (const char* part : {"'P': its inner corners at ", "(10, 15, 0)", "(50, 45, 0)",
                           "drawn sharp, and a radius of 3 mm, that of the narrowest mill, stays"})
    EXPECT_NE(told(o).find(part), std::string::npos) << part << "\n" << told(o);
  for (const auto& f : o.findings) EXPECT_NE(f.severity, "error") << f.text;
}

/// The sheet with a rough and a finish step of the file's own for its one feature, both with this mill.
std::string with_given_mill(Sheet& s, const std::string& feature, double diameter) {
  const auto n = [](int id) { return "#" + std::to_string(id); };
  const std::string d = std::to_string(diameter);
  const auto size = s.d.write("MILLING_TOOL_DIMENSION(" + d + ",$,$,45.,$,$,$)");
  const auto mill = s.d.write("ENDMILL(" + n(size) + ",3,.RIGHT.,.F.,$)");
  const auto edge = s.d.write("CUTTING_COMPONENT(60.,$,$,$,$)");
  const auto tool = s.d.write("MILLING_CUTTING_TOOL('GIVEN'," + n(mill) + ",(" + n(edge) + "),120.,$,$)");
  const auto how = s.d.write("MILLING_TECHNOLOGY(0.01,.TCP.,$,-50.,$,.F.,.F.,.F.,$)");
  const auto with = s.d.write("MILLING_MACHINE_FUNCTIONS(.T.,$,$,.F.,$,(),.F.,$,$,())");
  std::string steps, operations;
  for (const bool rough : {true, false}) {
    const auto op =
        s.d.write(std::string(rough ? "BOTTOM_AND_SIDE_ROUGH_MILLING" : "BOTTOM_AND_SIDE_FINISH_MILLING") +
                  "($,$,'" + (rough ? "ROUGH" : "FINISH") + "',5.,$," + n(tool) + "," + n(how) + "," +
                  n(with) + ",$,$,$,$,2.," + (rough ? "5.,0.3,0.2)" : "$,0.,0.)"));
    operations += (operations.empty() ? "" : ",") + n(op);
    const auto ws = s.d.write(std::string("MACHINING_WORKINGSTEP('") + (rough ? "ROUGH" : "FINISH") +
                              "',#31,#FEATURE," + n(op) + ",$)");
    steps += (steps.empty() ? "" : ",") + n(ws);
  }
  std::string text = s.d.text();
  const auto put = [&](const std::string& from, const std::string& to) {
    for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size())
      text.replace(at, from.size(), to);
  };
  put("'" + feature + "',#4,()", "'" + feature + "',#4,(" + operations + ")");
  const auto at = text.rfind('#', text.find("('" + feature + "'"));
  put("#FEATURE", text.substr(at, text.find('=', at) - at));
  put("'MAIN WORKPLAN',()", "'MAIN WORKPLAN',(" + steps + ")");
  return text;
}

/// Kept as the file gives it, and found: what a mill of 20 mm leaves in corners that may keep 3 mm.
void expect_left_by(const std::string& text, const std::string& feature) {
  const PlanOutput o = plan_bytes(text, "given.p21");
  EXPECT_EQ(o.steps, 2U) << told(o);
  EXPECT_NE(o.json.find("GIVEN"), std::string::npos);
  EXPECT_TRUE(std::any_of(o.findings.begin(), o.findings.end(), [&](const PlanMessage& f) {
    return f.severity == "error" && f.code == "CHK-LEFT" && f.text.find(feature) != std::string::npos;
  })) << told(o);
  EXPECT_TRUE(o.linuxcnc.empty()) << "the check condemns it";
}

Drawing::Id corner_of_an_l(Sheet& s) {
  return s.d.closed(
      s.d.polyline({{0, 0, 0}, {50, 0, 0}, {50, 20, 0}, {20, 20, 0}, {20, 50, 0}, {0, 50, 0}, {0, 0, 0}}));
}

TEST(GivenMills, OneTooWideForAnOutsidesInnerCornerIsFoundAndNoProgramIsWritten) {
  Sheet s;
  s.d.outside("O", s.d.placement({5, 5, 0}), 10, corner_of_an_l(s));
  expect_left_by(with_given_mill(s, "O", 20), "O");
}

TEST(GivenMills, OneTooWideForAStepsInnerCornersIsFoundAndNoProgramIsWritten) {
  Sheet s;
  s.d.step("A", s.d.placement({30, 10, 0}), 6, 40, {0, 1, 0});
  expect_left_by(with_given_mill(s, "A", 20), "A");
}

TEST(GivenMills, OneTooWideForAPocketsCornersIsFoundAndNoProgramIsWritten) {
  Sheet s;
  s.d.closed_pocket("P", s.d.placement({30, 30, 0}), 8, s.d.rectangle(40, 30), 0);
  expect_left_by(with_given_mill(s, "P", 20), "P");
}

TEST(GivenMills, OneThatFitsTheCornersLeavesNothingInThem) {
  Sheet s;
  s.d.outside("O", s.d.placement({5, 5, 0}), 10, corner_of_an_l(s));
  const PlanOutput o = plan_bytes(with_given_mill(s, "O", 6), "given.p21");
  EXPECT_EQ(o.steps, 2U) << told(o);
  for (const auto& f : o.findings) EXPECT_NE(f.code, "CHK-LEFT") << f.text;
}

}  // namespace
}  // namespace capstan::testing::removal
