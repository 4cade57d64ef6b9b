#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "tests/door/app/command/command.h"
#include "tests/support/corpus.h"

// `capstan cases import`, `trace` and `report`, run as a user runs them.

namespace capstan::app {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

const char* const kSheet =
    "tool,workingstep,characteristics,operation,material_group,tool_class,machine_class,cutter_diameter_mm,"
    "teeth,path_length_mm\n"
    "1,DRILL,,DRILLING,N/aluminium,carbide/twist_drill,mill,10,2,100\n"
    "2,BORE,DIAMETER5,BORING,N/aluminium,carbide/endmill,mill,4,2,200\n";
const char* const kLog =
    "time_s,tool,feed_mm_min,spindle_rpm,lag_mm\n"
    "0,1,600,3000,0.01\n10,2,0,3000,0\n12,2,300,3000,0.06\n22,2,300,3000,0.01\n32,2,0,3000,0\n";
const char* const kMeasured =
    "part,characteristic,type,nominal,tol_plus,tol_minus,value\n7,DIAMETER5,Diameter,4,0.2,-0.2,4.3\n";

class CasesImport : public CommandTest {
 protected:
  void SetUp() override {
    CommandTest::SetUp();
    put("sheet.csv", kSheet);
    put("log.csv", kLog);
    put("cmm.csv", kMeasured);
  }
  Ran import_all() const {
    return run("cases import base.db csv log.csv --plan sheet.csv --part 7 --serial M1 --inspection cmm.csv");
  }
};

TEST_F(CasesImport, MakesACaseOfEachStepOnce) {
  const Ran first = import_all();
  ASSERT_EQ(first.code, 0) << first.err;
  EXPECT_THAT(first.err, HasSubstr("1 log: 2 cases, 2 of them new; the base holds 2 cases"));
  EXPECT_THAT(import_all().err, HasSubstr("0 of them new"));
  EXPECT_THAT(run("cases list base.db bad").out, HasSubstr("BORING"));
}

TEST_F(CasesImport, KnowsALogByItsNameHoweverItsPathIsSpelt) {
  const auto import = [&](const std::string& log, const std::string& part = "7") {
    return run("cases import base.db csv " + log + " --plan sheet.csv --part " + part);
  };
  put("log.csv",
      "time_s,tool,feed_mm_min,spindle_rpm,lag_mm,load_percent\n0,1,600,3000,0.01,20\n10,2,0,3000,0,5\n"
      "12,2,300,3000,0.06,30\n22,2,300,3000,0.01,30\n32,2,0,3000,0,5\n");
  const Ran first = import("log.csv");
  EXPECT_THAT(first.err, HasSubstr("2 cases, 2 of them new"));
  EXPECT_THAT(first.err, Not(HasSubstr("CASE-SAME")));
  for (const std::string& spelt : {std::string("./log.csv"), (folder_ / "log.csv").string()})
    EXPECT_THAT(import(spelt).err, HasSubstr(", 0 of them new")) << spelt;
  // The same readings by another name, and as another part: kept, and told.
  std::filesystem::copy_file(folder_ / "log.csv", folder_ / "copy.csv");
  for (const Ran& again : {import("copy.csv"), import("log.csv", "8")}) {
    EXPECT_THAT(again.err, HasSubstr("2 of them new"));
    EXPECT_THAT(again.err, HasSubstr("2 new cases have the same time and readings as another"));
  }
  put("other.csv",
      "time_s,tool,feed_mm_min,spindle_rpm,lag_mm,load_percent\n0,1,600,3000,0.02,21\n11,2,0,3000,0,5\n"
      "12,2,300,3000,0.05,31\n22,2,300,3000,0.01,30\n32,2,0,3000,0,5\n");
  EXPECT_THAT(import("other.csv", "9").err, Not(HasSubstr("CASE-SAME")));
}

TEST_F(CasesImport, TracesPartStepAndMeasuredValueTogether) {
  ASSERT_EQ(import_all().code, 0);
  const Ran traced = run("cases trace base.db sheet.csv -o trace.jsonl -o trace.csv -o trace.db");
  ASSERT_EQ(traced.code, 0) << traced.err;
  EXPECT_THAT(traced.out,
              ::testing::ContainsRegex("7 +BORE +carbide/endmill D4 .* 20 .* 0\\.06 .* 0\\.3 .* bad"));
  EXPECT_THAT(slurp(folder_ / "trace.jsonl"), HasSubstr("\"workingstep\": \"BORE\""));
  EXPECT_THAT(slurp(folder_ / "trace.csv"), HasSubstr("BORE"));
  EXPECT_EQ(run("cases list trace.db").out, run("cases list base.db").out);
  EXPECT_THAT(run("cases trace base.db sheet.csv --part 8").out, HasSubstr("no case of this plan"));
  EXPECT_THAT(run("cases trace base.db sheet.csv bad").out, Not(HasSubstr("DRILL ")));
}

TEST_F(CasesImport, TraceWritesAllOutputsOrNone) {
  ASSERT_EQ(import_all().code, 0);
  const auto nothing_written = [&](const std::string& outputs, int code, const char* words) {
    const Ran r = run("cases trace base.db sheet.csv -o a.jsonl " + outputs);
    EXPECT_EQ(r.code, code) << r.err;
    EXPECT_THAT(r.err, HasSubstr(words));
    EXPECT_EQ(r.out, "");
    for (const char* name : {"a.jsonl", "b.csv", "b.db", "c.db"})
      EXPECT_FALSE(std::filesystem::exists(folder_ / name)) << outputs << ": " << name;
  };
  nothing_written("-o b.db -o trace.txt", 2, "USAGE-OUTPUT");
  nothing_written("-o b.db -o c.db", 2, "two case bases");
  nothing_written("-o b.db -o none/b.csv", 2, "FILE-WRITE");
  nothing_written("-o b.csv -o oracle://shop:secret@host/cases", 4, "CASE-URI");
  EXPECT_THAT(run("cases trace base.db sheet.csv -o oracle://shop:secret@host/cases").err,
              Not(HasSubstr("secret")));
  // A case base that is none takes nothing; what was there stays.
  put("b.db", "no base");
  const Ran r = run("cases trace base.db sheet.csv -o a.jsonl -o b.db");
  EXPECT_NE(r.code, 0);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "a.jsonl"));
  EXPECT_EQ(slurp(folder_ / "b.db"), "no base");
}

TEST_F(CasesImport, ReportsByStepToolAndFeatureWithAPicture) {
  ASSERT_EQ(import_all().code, 0);
  const Ran told = run("cases report base.db -o report.svg");
  ASSERT_EQ(told.code, 0) << told.err;
  EXPECT_THAT(told.out, HasSubstr("by workingstep"));
  EXPECT_THAT(told.out, HasSubstr("carbide/endmill D4"));
  EXPECT_THAT(told.out, HasSubstr("one case proves nothing"));
  const std::string picture = slurp(folder_ / "report.svg");
  EXPECT_THAT(picture, StartsWith("<svg"));
  for (const char* panel : {"lag mm by workingstep", "lag mm by tool", "lag mm by feature", "time s by tool"})
    EXPECT_THAT(picture, HasSubstr(panel));
  EXPECT_THAT(told.out, Not(HasSubstr("wear mm")));  // nobody measured it
  EXPECT_THAT(run("cases report base.db --json").out, HasSubstr("\"workingsteps\": ["));
}

TEST_F(CasesImport, ReportDrawsNoPictureOfAnotherKind) {
  ASSERT_EQ(import_all().code, 0);
  const Ran r = run("cases report base.db -o rep.png");
  EXPECT_EQ(r.code, 2) << r.err;
  EXPECT_THAT(r.err, HasSubstr("rep.png"));
  EXPECT_THAT(r.err, HasSubstr("expected .svg"));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "rep.png"));
  EXPECT_EQ(run("cases report base.db -o rep.SVG").code, 0);
}

TEST_F(CasesImport, ReportsWhatIsLeftOfAnEdgeOverItsCuttingTime) {
  // An edge that is expected to live for a minute, and cuts for 20 s in each of two parts.
  std::string sheet = kSheet;
  sheet.replace(sheet.find("path_length_mm\n"), 15, "path_length_mm,predicted_tool_life_min\n");
  sheet.replace(sheet.find("2,100\n"), 6, "2,100,\n");
  sheet.replace(sheet.find("2,200\n"), 6, "2,200,1\n");
  put("sheet.csv", sheet);
  put("log.csv",
      "time_s,tool,tool_serial,feed_mm_min,spindle_rpm\n"
      "0,1,DR-1,600,3000\n10,2,EM-2,0,3000\n12,2,EM-2,300,3000\n22,2,EM-2,300,3000\n32,2,EM-2,0,3000\n");
  for (const char* part : {"7", "8"}) {
    const Ran r = run("cases import base.db csv log.csv --plan sheet.csv --part " + std::string(part));
    ASSERT_EQ(r.code, 0) << r.err;
  }
  const Ran told = run("cases report base.db");
  EXPECT_THAT(told.out, ::testing::ContainsRegex("EM-2 +carbide/endmill D4 +2 +0\\.7 +67 % .* near its end"));
  EXPECT_THAT(told.out, ::testing::ContainsRegex("DR-1 .* 2 .2 not counted. .* life not known"));
  EXPECT_THAT(run("cases report base.db --json").out,
              ::testing::ContainsRegex(
                  "\"edge\": \"EM-2\".*\"history\": ..\"cut_min\": 0\\.33.*\"cut_min\": 0\\.66"));
}

TEST_F(CasesImport, KeepsAnEdgesWearOverItsCuttingTime) {
  put("wear_sheet.csv",
      "parts,workingstep,operation,material_group,tool_class,machine_class,cutter_diameter_mm,teeth,vc_m_min,"
      "fz_mm,"
      "ap_mm\n1-2,FACE,PLANE_ROUGH_MILLING,K/cast_iron,carbide/facemill,mill,70,6,200,0.08,1.5\n");
  put("wear.csv", "case,run,VB,time\n1,1,0.1,3\n1,2,0.25,9\n2,1,0.3,4\n");
  const Ran kept = run("cases import base.db wear wear.csv --plan wear_sheet.csv");
  ASSERT_EQ(kept.code, 0) << kept.err;
  EXPECT_THAT(kept.err, HasSubstr("1 log: 2 cases, 2 of them new"));
  EXPECT_THAT(run("cases export base.db").out, HasSubstr("180:0.1 540:0.25"));
  put("wear.csv", "case,run,VB,time\n1,1,100,3\n1,2,250,9\n2,1,300,4\n");
  const Ran wrong = run("cases import other.db wear wear.csv --plan wear_sheet.csv");
  EXPECT_EQ(wrong.code, 3);
  EXPECT_THAT(wrong.err, HasSubstr("wear.csv:2"));
  EXPECT_THAT(wrong.err, HasSubstr("100 mm is out of range: 0 to 20 mm"));
  EXPECT_THAT(files(), Not(::testing::Contains("other.db")));
}

TEST_F(CasesImport, AStepInWhichALagOrAnOverloadLastsBeyondItsTriggerIsABadCase) {
  // The boring lags by 0.06 mm and takes 95 % of the spindle for ten seconds; the drilling neither.
  put("log.csv",
      "time_s,tool,feed_mm_min,spindle_rpm,lag_mm,load_percent\n"
      "0,1,600,3000,0.01,40\n10,2,0,3000,0,0\n12,2,300,3000,0.06,95\n22,2,300,3000,0.01,50\n32,2,0,3000,0,"
      "0\n");
  int n = 0;
  const auto bad = [&](const std::string& triggers) {
    const std::string base = "base" + std::to_string(++n) + ".db";
    const Ran in = run("cases import " + base + " csv log.csv --plan sheet.csv --part 7 " + triggers);
    EXPECT_EQ(in.code, 0) << in.err;
    EXPECT_THAT(in.err, HasSubstr("2 cases"));
    const std::string listed = run("cases list " + base + " bad").out;
    EXPECT_THAT(listed, Not(HasSubstr("DRILLING"))) << triggers;
    return listed.find("BORING") != std::string::npos;
  };
  EXPECT_FALSE(bad(""));
  EXPECT_TRUE(bad("--trigger 'lag_mm>0.05'"));
  EXPECT_FALSE(bad("--trigger 'lag_mm>0.07'"));
  EXPECT_TRUE(bad("--trigger 'load_percent>90:5'"));
  EXPECT_FALSE(bad("--trigger 'load_percent>90:11'"));
  EXPECT_TRUE(bad("--trigger 'lag_mm>0.07' --trigger 'load_percent>90'"));
}

TEST_F(CasesImport, JoinsALogWithAPlanByTheMarkersOfItsProgram) {
  const Ran planned =
      run("plan '" + capstan::testing::source_dir() + "/examples/bracket.p21' -o plan.json -o plan.ngc");
  ASSERT_EQ(planned.code, 0) << planned.err;
  // A machine that takes a tenth of a second per line of the program.
  const std::string program = slurp(folder_ / "plan.ngc");
  const long lines = std::count(program.begin(), program.end(), '\n');
  std::string log = "time_s,line,feed_mm_min,spindle_rpm\n";
  for (long i = 1; i <= lines; ++i)
    log += std::to_string(0.1 * static_cast<double>(i)) + "," + std::to_string(i) + ",500,3000\n";
  put("log.csv", log);
  const Ran in = run("cases import base.db csv log.csv --plan plan.json --program plan.ngc --part 3");
  ASSERT_EQ(in.code, 0) << in.err;
  const Ran traced = run("cases trace base.db plan.json --program plan.ngc --part 3");
  EXPECT_THAT(traced.out, HasSubstr("POCKET area_rough"));
  EXPECT_THAT(traced.out, ::testing::ContainsRegex("POCKET area_rough.* [0-9]+-[0-9]+ "));
}

TEST_F(CasesImport, RefusesWhatItCannotUseAndKeepsNothing) {
  const std::pair<const char*, int> wrong[] = {
      {"cases import base.db qif log.csv --plan sheet.csv", 2},
      {"cases import base.db csv log.csv --plan sheet.csv --part 1 --part 2", 2},
      {"cases import base.db csv log.csv --plan sheet.csv --trigger colour", 2},
      {"cases import base.db csv none.csv --plan sheet.csv", 3},
      {"cases import base.db csv log.csv --plan log.csv", 3},
      {"cases import base.db csv log.csv --plan sheet.csv --inspection log.csv", 3},
      {"cases import base.db csv log.csv --plan sheet.csv --program sheet.csv", 3},
      {"cases import base.db trace log.csv --plan sheet.csv", 3}};
  for (const auto& [line, code] : wrong) {
    const Ran ran = run(line);
    EXPECT_EQ(ran.code, code) << line << ran.err;
    EXPECT_THAT(ran.err, HasSubstr("error")) << line;
  }
  EXPECT_THAT(files(), Not(::testing::Contains("base.db")));
}

}  // namespace
}  // namespace capstan::app
