#include "casebase/retain/join/steps.h"

#include <gtest/gtest.h>

namespace capstan::casebase::retain {
namespace {

const std::string kHead =
    "tool,parts,workingstep,operation,material_group,tool_class,machine_class,cutter_diameter_mm,teeth\n";
const std::string kRow = "5,1-3 7,BORE,DRILLING,N/aluminium,carbide/endmill,mill,4,2\n";

TEST(Sheet, RowIsAStepOfWhichTheLogSaysSpeedAndFeed) {
  const auto steps = read_sheet("# a remark\n" + kHead + kRow, "sheet.csv");
  ASSERT_TRUE(steps) << to_text(steps.error());
  ASSERT_EQ(steps->size(), 1U);
  EXPECT_EQ(steps->front().id, "BORE");
  EXPECT_EQ(steps->front().tool, 5);
  EXPECT_EQ(steps->front().planned.asked.operation, "DRILLING");
  EXPECT_EQ(steps->front().planned.bound.vc_m_min, 0.0);
  EXPECT_EQ(steps->front().planned.bound.fz_mm, 0.0);
}

TEST(Sheet, StepIsForThePartsThatItNames) {
  const auto steps = read_sheet(kHead + kRow, "sheet.csv");
  ASSERT_TRUE(steps);
  for (const char* part : {"1", "3", "7"}) EXPECT_TRUE(steps->front().is_for(part)) << part;
  for (const char* part : {"0", "4", "8", "", "x"}) EXPECT_FALSE(steps->front().is_for(part)) << part;
}

TEST(Sheet, OneNameMayStandForStepsOfDifferentParts) {
  const auto steps =
      read_sheet(kHead + kRow + "6,4-6,BORE,DRILLING,N/aluminium,carbide/endmill,mill,4,2\n", "sheet.csv");
  ASSERT_TRUE(steps) << to_text(steps.error());
  EXPECT_EQ(steps->size(), 2U);
}

TEST(Sheet, FaultNamesFileAndLine) {
  const std::pair<std::string, std::uint64_t> wrong[] = {
      {"", 1U},
      {kHead, 1U},
      {"tool,operation\n1,DRILLING\n", 1U},
      {kHead + "# fine\n5,1-3,BORE,DRILLING,N/aluminium,carbide/endmill,mill\n", 3U},
      {kHead + kRow + "x,,BORE,DRILLING,N/aluminium,carbide/endmill,mill,4,2\n", 3U},
      {kHead + kRow + "5,3-1,BORE,DRILLING,N/aluminium,carbide/endmill,mill,4,2\n", 3U},
      {kHead + kRow + "5,,,DRILLING,N/aluminium,carbide/endmill,mill,4,2\n", 3U},
      {kHead + kRow + "5,,BORE,no keyword,N/aluminium,carbide/endmill,mill,4,2\n", 3U},
      {kHead + kRow + "6,3-4,BORE,DRILLING,N/aluminium,carbide/endmill,mill,4,2\n", 3U},
      {kHead + kRow + "6,,BORE,DRILLING,N/aluminium,carbide/endmill,mill,4,2\n", 3U},
      {"colour," + kHead + "red," + kRow, 1U}};
  for (const auto& [text, line] : wrong) {
    const auto steps = read_sheet(text, "sheet.csv");
    ASSERT_FALSE(steps) << text;
    EXPECT_EQ(steps.error().code, "LOG-SHEET") << text;
    EXPECT_EQ(steps.error().file, "sheet.csv") << text;
    EXPECT_EQ(steps.error().line, line) << text;
  }
}

}  // namespace
}  // namespace capstan::casebase::retain
