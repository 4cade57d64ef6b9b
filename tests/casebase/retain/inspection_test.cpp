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

TEST(Inspection, TellsByItsTypeWhatARowMeasures) {
  const auto rows = inspect(
      "part,characteristic,type,nominal,tol_plus,tol_minus,value\n"
      "1,A,Diameter,8,0.1,-0.1,8.01\n1,B,WIDTH,8,0.1,-0.1,8.01\n1,C,Depth,8,0.1,-0.1,8.01\n"
      "1,D,true position,,,,0.02\n1,E,Ra,,1.6,,1.2\n1,F,Rz,,6.3,,4\n1,G,Flatness,,,,0.02\n"
      "1,H/depth,,8,0.1,-0.1,8.01\n1,I,,8,0.1,-0.1,8.01\n");
  ASSERT_TRUE(rows) << to_text(rows.error());
  std::vector<Measures> kinds;
  for (const Inspected& row : *rows) kinds.push_back(row.kind);
  EXPECT_EQ(kinds, (std::vector{Measures::kSize, Measures::kSize, Measures::kDepth, Measures::kPlace,
                                Measures::kRoughness, Measures::kOther, Measures::kOther, Measures::kDepth,
                                Measures::kSize}));
}

TEST(Inspection, ReadsARoughnessInMicrometresUnlessTheRowSaysMore) {
  for (const std::string row :
       {"1,A,Ra,1.6,", "1,A,Ra,0.0016,mm", "1,A,Ra,1.6,um", "1,A,Ra,1.6,\xC2\xB5m", "1,A,roughness,63,uin"}) {
    // Inches of a whole table are of its lengths.
    const auto rows = inspect("part,feature,type,value,unit\n" + row + "\n", 25.4);
    ASSERT_TRUE(rows) << row;
    EXPECT_NEAR(rows->at(0).ra_um, 1.6, 0.001) << row;  // 63 uin are 1.6002 um
  }
  const auto limited =
      inspect("part,feature,type,nominal,tol_plus,value\n1,A,Ra,1.6,0.1,1.2\n1,A,Ra,,,1.2\n");
  ASSERT_TRUE(limited);
  EXPECT_NEAR(limited->at(0).ra_most.value(), 1.7, 1e-12);
  EXPECT_FALSE(limited->at(1).ra_most);
}

TEST(Inspection, ARowsUnitGoesBeforeThatOfTheColumn) {
  const auto rows = inspect("part,feature,value_in,unit\n1,A,8,mm\n1,A,1,\n");
  ASSERT_TRUE(rows);
  EXPECT_DOUBLE_EQ(rows->at(0).value_mm, 8.0);
  EXPECT_DOUBLE_EQ(rows->at(1).value_mm, 25.4);
}

TEST(Inspection, LeavesOutWhatNoCaseCanHaveAndSaysTheLine) {
  for (const std::string row : {"1,B,Ra,,1600", "1,B,Ra,,-1", "1,B,Diameter,8,208.5", "1,B,Position,,-0.1"}) {
    Job job;
    const auto rows =
        read_inspection("part,feature,type,nominal,value\n1,A,Ra,,1\n" + row + "\n", "cmm.csv", 1.0, job);
    ASSERT_TRUE(rows) << row;
    EXPECT_EQ(rows->size(), 1U) << row;
    ASSERT_EQ(job.diagnostics().size(), 1U) << row;
    EXPECT_EQ(job.diagnostics()[0].line, 3U) << row;
    EXPECT_NE(job.diagnostics()[0].message.find("out of range"), std::string::npos)
        << job.diagnostics()[0].message;
  }
}

TEST(TableOfWear, IsReadAsNasaWroteItsOwn) {
  Job job;
  const auto rows = read_wear(
      "case,run,VB,time,DOC,feed,material,material_name\r\n1,1,0.0,2,1.5,0.5,1,cast_iron\r\n"
      "1,2,,4,1.5,0.5,1,cast_iron\r\n1,4,0.11,7,1.5,0.5,1,cast_iron\r\n2,1,0.08,3,0.75,0.5,1,cast_iron\r\n",
      "wear.csv", 1.0, job);
  ASSERT_TRUE(rows) << to_text(rows.error());
  ASSERT_EQ(rows->size(), 4U);
  EXPECT_FALSE(rows->at(1).wear_mm);  // it was not read then
  EXPECT_EQ(rows->at(2).part, "1");
  EXPECT_DOUBLE_EQ(rows->at(2).time_s, 420.0);  // 7 min
  EXPECT_DOUBLE_EQ(rows->at(2).wear_mm.value(), 0.11);
  EXPECT_DOUBLE_EQ(rows->at(2).feed_per_turn_mm, 0.5);
  EXPECT_DOUBLE_EQ(rows->at(2).depth_mm, 1.5);
  EXPECT_EQ(rows->at(3).line, 5U);  // the clock of another case begins anew
  EXPECT_TRUE(job.diagnostics().empty());
}

TEST(TableOfWear, IsReadInTheUnitsOfItsColumns) {
  Job job;
  const auto rows = read_wear("edge;cutting_time_s;vb_um;rpm;tool\nE-7;90;120;826;3\n", "wear.csv", 1.0, job);
  ASSERT_TRUE(rows) << to_text(rows.error());
  EXPECT_EQ(rows->at(0).edge, "E-7");
  EXPECT_DOUBLE_EQ(rows->at(0).time_s, 90.0);
  EXPECT_NEAR(rows->at(0).wear_mm.value(), 0.12, 1e-12);
  EXPECT_DOUBLE_EQ(rows->at(0).rpm, 826.0);
  EXPECT_EQ(rows->at(0).tool, 3);
}

TEST(TableOfWear, LeavesOutARowThatIsOutOfRangeAndSaysItsLine) {
  // 25 mm of wear: micrometres without a word. A clock that goes back, or stands; a wear below nothing.
  for (const std::string row : {"1,9,25", "1,9,-0.1", "1,-1,0.1", "1,3,0.2", "1,9,nan", "1,,0.2", ",9,0.2"}) {
    Job job;
    const auto rows = read_wear("case,time,VB\n1,3,0.1\n" + row + "\n", "wear.csv", 1.0, job);
    ASSERT_TRUE(rows) << row;
    EXPECT_EQ(rows->size(), 1U) << row;
    ASSERT_EQ(job.diagnostics().size(), 1U) << row;
    EXPECT_EQ(job.diagnostics()[0].code, "LOG-LINES");
    EXPECT_EQ(job.diagnostics()[0].line, 3U) << row;
  }
}

TEST(TableOfWear, IsRefusedWhereItIsAnotherTable) {
  Job job;
  EXPECT_EQ(read_wear("case,VB\n1,0.1\n", "wear.csv", 1.0, job).error().code, "LOG-COLUMNS");
  EXPECT_EQ(read_wear("case,time,VB\n", "wear.csv", 1.0, job).error().code, "LOG-EMPTY");
  const auto all_wrong = read_wear("case,time,VB\n1,3,300\n1,6,400\n1,9,500\n", "wear.csv", 1.0, job);
  ASSERT_FALSE(all_wrong);
  EXPECT_EQ(all_wrong.error().code, "LOG-FORMAT");
  EXPECT_EQ(all_wrong.error().line, 2U);
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
