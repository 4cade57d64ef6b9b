#include "casebase/retain/inspection.h"

#include <gtest/gtest.h>

namespace capstan::casebase::retain {
namespace {

Result<std::vector<Inspected>> inspect(const std::string& text, double unit_mm = 1.0) {
  Job job;
  return read_inspection(text, "cmm.csv", unit_mm, job);
}

TEST(Inspection, GivesValuesWithTheirLimits) {
  const auto rows = inspect(
      "part_index,characteristic_item,type,designator,nominal,tol_plus,tol_minus,value,status\r\n"
      "1,14,Flatness,FLATNESS1,,,,0.055,PASS\r\n"
      "1,23,Diameter,DIAMETER4,4.5,0.508,-0.508,4.486,PASS\r\n");
  ASSERT_TRUE(rows) << to_text(rows.error());
  ASSERT_EQ(rows->size(), 2U);
  EXPECT_FALSE((*rows)[0].has_nominal);
  EXPECT_DOUBLE_EQ((*rows)[1].value_mm, 4.486);
  EXPECT_DOUBLE_EQ((*rows)[1].lower_mm, -0.508);
  EXPECT_TRUE((*rows)[1].toleranced);
  EXPECT_EQ((*rows)[1].line, 3U);
}

TEST(Inspection, TurnsInchesIntoMillimetresByColumnRowAndCaller) {
  for (const auto& [text, unit] : {std::pair("part,feature,value_in\nA,B,1\n", 1.0),
                                   std::pair("part,feature,value,unit\nA,B,1,inch\n", 1.0),
                                   std::pair("part,feature,value\nA,B,1\n", 25.4)}) {
    const auto rows = inspect(text, unit);
    ASSERT_TRUE(rows) << text;
    EXPECT_DOUBLE_EQ(rows->at(0).value_mm, 25.4) << text;
  }
}

TEST(Inspection, LeavesOutRowsThatCannotBeRead) {
  Job job;
  const auto rows = read_inspection("part,feature,value\nA,B,1\nA,B,nan\nA,B\n", "cmm.csv", 1.0, job);
  ASSERT_TRUE(rows);
  EXPECT_EQ(rows->size(), 1U);
  ASSERT_EQ(job.diagnostics().size(), 1U);
  EXPECT_EQ(job.diagnostics()[0].line, 3U);
}

TEST(Inspection, RefusesOtherTables) {
  EXPECT_EQ(inspect("a,b\n1,2\n").error().code, "LOG-COLUMNS");
  EXPECT_EQ(inspect("").error().code, "LOG-EMPTY");
  EXPECT_EQ(inspect("part,feature,value\nA,B,x\nA,B,y\nA,B,z\n").error().code, "LOG-FORMAT");
  EXPECT_EQ(inspect("part,feature,value,unit\nA,B,1,furlong\nA,B,1,furlong\nA,B,1,furlong\n").error().code,
            "LOG-FORMAT");
}

TEST(TimesOfTools, AreReadInTheUnitsOfTheirColumns) {
  Job job;
  const auto rows = read_times(
      "part,tool,spindle_rpm,main_feed_ipm,feed_length_in,feed_blocks,executed_active_s,executed_feeding_s\n"
      "2,5,12000.0,27.0,239.393,2014,587.16,572.05\n",
      "times.csv", job);
  ASSERT_TRUE(rows) << to_text(rows.error());
  EXPECT_NEAR(rows->at(0).feed_mm_min, 685.8, 1e-9);
  EXPECT_NEAR(rows->at(0).path_mm, 6080.5822, 1e-9);
  EXPECT_EQ(rows->at(0).blocks, 2014);
  EXPECT_DOUBLE_EQ(rows->at(0).moving_s, 572.05);
}

TEST(TimesOfTools, AreRefusedWithoutTheUnitOfAFeed) {
  Job job;
  const auto rows = read_times("part,tool,feed,active_s\n1,2,3,4\n", "times.csv", job);
  ASSERT_FALSE(rows);
  EXPECT_EQ(rows.error().code, "LOG-COLUMNS");
}

TEST(TimesOfTools, AreLeftOutWhereTheyContradictThemselves) {
  Job job;
  const auto rows = read_times("part,tool,active_s,moving_s\n1,2,3,4\n1,3,5,4\n", "times.csv", job);
  ASSERT_TRUE(rows);
  EXPECT_EQ(rows->size(), 1U);
}

}  // namespace
}  // namespace capstan::casebase::retain
