#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/door/app/command/command.h"

// Files that are not what they should be: one clear message each, and nothing is written.

namespace capstan::app {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;

const std::string kSheetHead =
    "tool,workingstep,characteristics,operation,material_group,tool_class,machine_class,cutter_diameter_mm,"
    "teeth,path_length_mm\n";
const std::string kDrill = "1,DRILL,,DRILLING,N/aluminium,carbide/twist_drill,mill,10,2,100\n";
const std::string kBore = "2,BORE,DIAMETER5,BORING,N/aluminium,carbide/endmill,mill,4,2,200\n";
const std::string kLogHead = "time_s,tool,feed_mm_min,spindle_rpm\n";
const std::string kLog = kLogHead + "0,1,600,3000\n10,2,0,3000\n12,2,300,3000\n22,2,300,3000\n32,2,0,3000\n";
const std::string kMeasuredHead = "part,characteristic,type,nominal,tol_plus,tol_minus,value\n";
const std::string kMeasured = kMeasuredHead + "7,DIAMETER5,Diameter,4,0.2,-0.2,4.1\n";
const std::string kCasesHead =
    "operation,material_group,tool_class,machine_class,origin,vc_m_min,fz_mm,source,cutter_diameter_mm,"
    "teeth\n";
const std::string kCase = "DRILLING,N/aluminium,carbide/twist_drill,mill,entered,90,0.1,book,10,2\n";
const std::string kMark = "\xEF\xBB\xBF";

std::string windows(const std::string& text) {
  std::string out = kMark;
  for (const char c : text) out += c == '\n' ? std::string("\r\n") : std::string(1, c);
  return out;
}

/// A row, as often as a log has rows.
std::string rows(const std::string& row) {
  std::string out;
  for (int i = 0; i < 5; ++i) out += row;
  return out;
}

std::size_t errors_in(const std::string& text) {
  std::size_t n = 0;
  for (std::size_t at = text.find("error: "); at != std::string::npos; at = text.find("error: ", at + 1)) ++n;
  return n;
}

class CasesHostile : public CommandTest {
 protected:
  void SetUp() override {
    CommandTest::SetUp();
    put("sheet.csv", kSheetHead + kDrill + kBore);
    put("log.csv", kLog);
    put("cmm.csv", kMeasured);
    put("cases.csv", kCasesHead + kCase);
  }
  static std::string import() {
    return "cases import base.db csv log.csv --plan sheet.csv --part 7 --inspection cmm.csv";
  }
  /// Runs with that file in its place; one message, and no base.
  void refused(const std::string& line, const std::string& file, const std::string& bytes,
               const std::string& says) {
    put(file, bytes);
    const Ran ran = run(line);
    const std::string what = line + " with " + file + ":\n" + bytes.substr(0, 200) + "\n" + ran.err;
    EXPECT_EQ(ran.code, 3) << what;
    EXPECT_EQ(errors_in(ran.err), 1U) << what;
    EXPECT_THAT(ran.err, HasSubstr(says)) << what;
    EXPECT_THAT(ran.err, HasSubstr(file)) << what;
    EXPECT_EQ(ran.out, "") << what;
    EXPECT_THAT(files(), Not(Contains("base.db"))) << what;
    SetUp();
  }
};

TEST_F(CasesHostile, LogsAreRefusedWithOneMessage) {
  for (const auto& [bytes, says] : std::vector<std::pair<std::string, std::string>>{
           {"", "there is no reading in it"},
           {kLogHead, "there is no reading in it"},
           {"\n\n\r\n", "there is no reading in it"},
           {kLogHead + rows("nan,1,600,3000\n"), "'nan' is not a number"},
           {kLogHead + rows("inf,1,600,3000\n"), "'inf' is not a number"},
           {kLogHead + rows("1e308,1,600,3000\n"), "1e+308 is no time"},
           {kLogHead + rows("1e999,1,600,3000\n"), "beyond what a number can be"},
           {kLogHead + rows("-5,1,600,3000\n"), "-5 is no time"},
           {kLogHead + rows("0,1,nan,3000\n"), "'nan' is not a number"},
           {kLogHead + rows("0,1,1e308,3000\n"), "1e+308"},
           {kLogHead + rows("0,1.5,600,3000\n"), "1.5 is no number of a tool"},
           {kLogHead + rows("0,1,600\n"), "3 cells instead of 4"},
           {kLogHead + "9,1,600,3000\n" + rows("8,1,600,3000\n"), "the time goes back by 1 s"},
           {"time_s;tool;feed_mm_min;spindle_rpm\n" + rows("0;1;600,5;3000\n"), "written with a point"},
           {"time_s,time\n0,1\n", "says what another does"},
           {"tool,feed_mm_min\n1,600\n", "no column is the time"},
           {kLogHead + std::string("0,1,600\0,3000\n", 15), "NUL byte"}})
    refused(import(), "log.csv", bytes, says);
}

TEST_F(CasesHostile, SheetsAreRefusedWithOneMessage) {
  for (const auto& [bytes, says] : std::vector<std::pair<std::string, std::string>>{
           {"", "there is no step in it"},
           {kSheetHead, "there is no step in it"},
           {kSheetHead + kDrill + kDrill, "two steps of one part are called 'DRILL'"},
           {kSheetHead + "1,DRILL,,DRILLING,N/a,carbide/twist_drill,mill,nan,2,100\n",
            "'nan' is not a number"},
           {kSheetHead + "1,DRILL,,DRILLING,N/a,carbide/twist_drill,mill,1e308,2,100\n", "1e+308"},
           {kSheetHead + "1,DRILL,,DRILLING,N/a,carbide/twist_drill,mill,-10,2,100\n", "-10"},
           {kSheetHead + "1,DRILL,,DRILLING,N/a,carbide/twist_drill,mill,10\n", "8 cells"}})
    refused(import(), "sheet.csv", bytes, says);
}

TEST_F(CasesHostile, InspectionsAreRefusedWithOneMessage) {
  for (const auto& [bytes, says] : std::vector<std::pair<std::string, std::string>>{
           {"", "there is nothing in it"},
           {kMeasuredHead, "there is no row in it"},
           {kMeasuredHead + rows("7,DIAMETER5,Diameter,4,0.2,-0.2,nan\n"), "'nan' is not a number"},
           {kMeasuredHead + rows("7,DIAMETER5,Diameter,4,0.2,-0.2,1e308\n"), "1e+308 is out of range"},
           {kMeasuredHead + rows("7,DIAMETER5,Diameter,4,-0.2,0.2,4.1\n"), "lower limit is above"},
           {"part,value\n7,4\n", "a column is missing"}})
    refused(import(), "cmm.csv", bytes, says);
}

TEST_F(CasesHostile, CasesAreRefusedWithOneMessage) {
  for (const auto& [bytes, says] : std::vector<std::pair<std::string, std::string>>{
           {"", "cases.csv"},
           {kCasesHead + "DRILLING,N/a,carbide/twist_drill,mill,entered,nan,0.1,book,10,2\n", "'nan' is not"},
           {kCasesHead + "DRILLING,N/a,carbide/twist_drill,mill,entered,inf,0.1,book,10,2\n", "'inf' is not"},
           {kCasesHead + "DRILLING,N/a,carbide/twist_drill,mill,entered,1e308,0.1,book,10,2\n", "1e+308"},
           {kCasesHead + "DRILLING,N/a,carbide/twist_drill,mill,entered,-90,0.1,book,10,2\n", "-90"},
           {kCasesHead + kCase + "DRILLING,N/a,carbide/twist_drill,mill,entered,90\n", "fields instead of"},
           {"colour\nred\n", "the column 'colour' is unknown"}})
    refused("cases add base.db cases.csv", "cases.csv", bytes, says);
}

TEST_F(CasesHostile, CasesOfWordsAndDaysThatCannotBeAreTold) {
  std::string head = kCasesHead;
  head.insert(head.size() - 1, ",time_utc");
  put("cases.csv",
      head +
          "REEMING,6061,reamer,mill,entered,90,0.1,book,10,2,2126-06-28T17:32:31Z\n"
          "DRILLING,N/aluminium,carbide/twist_drill,mill,entered,90,0.1,book,10,2,2016-06-28T17:32:31Z\n");
  const Ran ran = run("cases add base.db cases.csv");
  ASSERT_EQ(ran.code, 0) << ran.err;
  EXPECT_THAT(ran.err, HasSubstr("unknown operation 'REEMING'. Did you mean 'REAMING'"));
  EXPECT_THAT(ran.err, HasSubstr("unknown tool 'reamer'. Did you mean 'hss/reamer'"));
  EXPECT_THAT(ran.err, HasSubstr("unknown material '6061'"));
  EXPECT_THAT(ran.err, HasSubstr("1 case is of a day after today"));
  EXPECT_THAT(ran.err, HasSubstr("the first of 2126-06-28T17:32:31Z"));
  EXPECT_THAT(ran.err, Not(HasSubstr("DRILLING")));
  EXPECT_THAT(ran.err, HasSubstr("2 of them new"));
  put("cases.csv", kCasesHead + kCase);
  EXPECT_THAT(run("cases add base.db cases.csv").err, Not(HasSubstr("CASE-WORD")));
}

TEST_F(CasesHostile, FilesOfWindowsAreRead) {
  ASSERT_EQ(run(import()).code, 0);
  const std::string plain = run("cases export base.db").out;
  for (const auto& [file, text] :
       {std::pair("sheet.csv", kSheetHead + kDrill + kBore), {"log.csv", kLog}, {"cmm.csv", kMeasured}})
    put(file, windows(text));
  std::filesystem::remove(folder_ / "base.db");
  const Ran again = run(import());
  ASSERT_EQ(again.code, 0) << again.err;
  EXPECT_EQ(run("cases export base.db").out, plain);
  put("cases.csv", windows(kCasesHead + kCase));
  EXPECT_THAT(run("cases add base.db cases.csv").err, HasSubstr("1 of them new"));
}

TEST_F(CasesHostile, ALogThatEndsWithinAStepKeepsTheStepsBeforeIt) {
  put("log.csv", kLogHead + "0,1,600,3000\n10,2,0,3000\n12,2,300,3000\n22,2,300,3000\n");
  const Ran ran = run(import());
  ASSERT_EQ(ran.code, 0) << ran.err;
  EXPECT_THAT(ran.err, HasSubstr("log.csv:5: warning: BORE: the log ends within it: it makes no case"));
  EXPECT_THAT(ran.err, HasSubstr("1 log: 1 case, 1 of them new"));
  const std::string listed = run("cases list base.db").out;
  EXPECT_THAT(listed, HasSubstr("DRILLING"));
  EXPECT_THAT(listed, Not(HasSubstr("BORING")));
}

TEST_F(CasesHostile, TuneAndReportRefuseWhatIsNoBaseAndNoPlan) {
  for (const std::string bytes : {"", "colour\nred\n"}) {
    put("none.db", bytes);
    for (const std::string line :
         {"cases tune none.db", "cases report none.db", "cases trace none.db sheet.csv", "cases list none.db",
          "cases export none.db"}) {
      const Ran ran = run(line);
      EXPECT_EQ(ran.code, 3) << line << ran.err;
      EXPECT_EQ(errors_in(ran.err), 1U) << line << ran.err;
      EXPECT_EQ(ran.out, "") << line;
    }
    EXPECT_EQ(slurp(folder_ / "none.db"), bytes);
  }
  ASSERT_EQ(run("cases add base.db cases.csv").code, 0);
  for (const std::string& bytes : {std::string(), kLog, std::string("{")}) {
    put("plan.json", bytes);
    const Ran ran = run("cases tune base.db plan.json -o tuned.svg");
    EXPECT_EQ(ran.code, 3) << bytes << ran.err;
    EXPECT_EQ(errors_in(ran.err), 1U) << bytes << ran.err;
    EXPECT_THAT(files(), Not(Contains("tuned.svg")));
  }
}

}  // namespace
}  // namespace capstan::app
