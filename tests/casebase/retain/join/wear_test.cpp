#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "casebase/record/failing.h"
#include "casebase/retain/join/import.h"
#include "casebase/tune/edges.h"
#include "casebase/tune/from_case.h"
#include "planner/ground/base/file.h"
#include "tests/support/corpus.h"

namespace capstan::casebase::retain {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

// Tests 1 and 2 are cut 1.5 mm deep, test 3 half of that; six teeth, 0.5 mm per turn.
const std::string kSheet =
    "parts,workingstep,operation,material_group,tool_class,machine_class,cutter_diameter_mm,teeth,vc_m_min,"
    "fz_mm,"
    "ap_mm\n"
    "1-2,DEEP,PLANE_ROUGH_MILLING,K/cast_iron,carbide/facemill,mill,70,6,200,0.0833333333,1.5\n"
    "3,FLAT,PLANE_ROUGH_MILLING,K/cast_iron,carbide/facemill,mill,70,6,200,0.0833333333,0.75\n";

struct Imported {
  Result<std::vector<Case>> cases;
  std::string said;
};
Imported import(const std::string& table, const std::string& sheet = kSheet, const std::string& part = "") {
  Job job;
  const auto steps = read_sheet(sheet, "sheet.csv");
  EXPECT_TRUE(steps) << (steps ? std::string() : to_text(steps.error()));
  std::istringstream in(table);
  Imported out{import_log(in, LogFormat::kWear, *steps,
                          {.part = part, .machine = "M1", .file = "in/wear.csv"}, {}, job),
               {}};
  for (const Diagnostic& d : job.diagnostics()) out.said += to_text(d) + '\n';
  return out;
}

TEST(WearCases, HoldTheReadingsOfAnEdgeOverItsCuttingTime) {
  const Imported i =
      import("case,VB,time,DOC,feed\n1,0.0,1,1.5,0.5\n1,,2,1.5,0.5\n1,0.2,4,1.5,0.5\n3,0.1,5,0.75,0.5\n");
  ASSERT_TRUE(i.cases) << to_text(i.cases.error());
  ASSERT_EQ(i.cases->size(), 2U);
  const Case& c = i.cases->front();
  EXPECT_EQ(c.observed.wear_series_mm.samples, (std::vector<Sample>{{60.0, 0.0}, {240.0, 0.2}}));
  EXPECT_DOUBLE_EQ(c.observed.wear_mm.value().value, 0.2);
  EXPECT_DOUBLE_EQ(c.observed.time_s.value().value, 240.0);
  EXPECT_EQ(c.origin, Origin::kMeasured);
  EXPECT_EQ(c.from.workingstep, "DEEP");
  EXPECT_EQ(c.from.part, "1");
  EXPECT_EQ(c.from.machine, "M1");
  EXPECT_EQ(c.from.tool_instance, "wear.csv:1");  // the table gives edges no serial number
  EXPECT_EQ(c.observed.verdict, Verdict::kUnknown);
  EXPECT_EQ(c.id, id_of(c));
  EXPECT_FALSE(fault_of(c));
  EXPECT_EQ(i.cases->back().from.workingstep, "FLAT");
  EXPECT_EQ(i.said, "");
}

TEST(WearCases, SayWhatOfTheCutWasMeasuredAndWhatTheSheetStates) {
  // 200 m/min at 70 mm are 200000 / (70 pi) = 909.457 1/min.
  const Case stated = import("case,VB,time,feed,rpm\n1,0.2,4,0.5,909.457\n").cases.value().front();
  EXPECT_NEAR(stated.observed.executed_fz_mm.value().value, 0.5 / 6.0, 1e-12);
  EXPECT_EQ(stated.observed.executed_fz_mm->origin, Origin::kMeasured);
  EXPECT_NEAR(stated.observed.executed_vc_m_min.value().value, 200.0, 1e-3);
  const Case bare = import("case,VB,time\n1,0.2,4\n").cases.value().front();
  EXPECT_EQ(bare.observed.executed_fz_mm.value().origin, Origin::kEntered);
  EXPECT_DOUBLE_EQ(bare.observed.executed_vc_m_min.value().value, 200.0);
}

TEST(WearCases, AreOneForAnEdgeThatCutsSeveralParts) {
  const Imported i = import("part,edge,VB,time\n1,E7,0.1,2\n2,E7,0.2,4\n");
  ASSERT_TRUE(i.cases) << to_text(i.cases.error());
  ASSERT_EQ(i.cases->size(), 1U);
  EXPECT_EQ(i.cases->front().from.tool_instance, "E7");
  EXPECT_EQ(tune::edges_of(*i.cases).size(), 1U);
}

TEST(WearCases, AreNotMadeOfAnEdgeWhoseWearIsOfNoOneStep) {
  const Imported i = import(
      "part,edge,VB,time\n1,E1,0.1,2\n3,E1,0.2,4\n"  // in two steps
      "9,E2,0.1,2\n"                                 // in none
      "1,E3,0.0,0\n1,E4,,3\n"                        // never read after a cut
      "1,E5,0.2,4\n");
  ASSERT_TRUE(i.cases) << to_text(i.cases.error());
  EXPECT_EQ(i.cases->size(), 1U);
  for (const char* edge : {"'E1'", "'E2'", "'E3'", "'E4'"}) EXPECT_THAT(i.said, HasSubstr(edge));
  EXPECT_THAT(i.said, HasSubstr("in/wear.csv:2"));
}

TEST(WearCases, AreNotMadeWhereTheTableStatesAnotherCutThanTheSheet) {
  const Imported deep = import("case,VB,time,DOC\n1,0.2,4,0.75\n3,0.2,4,0.75\n");
  ASSERT_TRUE(deep.cases);
  EXPECT_EQ(deep.cases->size(), 1U);
  EXPECT_THAT(deep.said, HasSubstr("the depth is 0.75 mm in the table and 1.5 mm in the step"));
  const Imported fast = import("case,VB,time,feed\n1,0.2,4,0.25\n");
  ASSERT_FALSE(fast.cases);
  EXPECT_EQ(fast.cases.error().code, "LOG-JOIN");
  EXPECT_THAT(fast.said, HasSubstr("the feed per turn is 0.25 mm in the table and 0.5 mm in the step"));
  // 300 m/min at 70 mm.
  const Imported turned = import("case,VB,time,rpm\n1,0.2,4,1364.185\n");
  ASSERT_FALSE(turned.cases);
  EXPECT_THAT(turned.said, HasSubstr("the speed is 300 m/min in the table and 200 m/min in the step"));
}

TEST(WearCases, TellNothingOfTheTimeOfTheStepThatTheirEdgeCut) {
  std::string sheet = kSheet;
  sheet.replace(sheet.find("ap_mm\n"), 6, "ap_mm,path_length_mm,path_blocks,predicted_time_s\n");
  sheet.replace(sheet.find(",1.5\n"), 5, ",1.5,1000,10,40\n");
  sheet.replace(sheet.find(",0.75\n"), 6, ",0.75,1000,10,40\n");
  const Imported i = import("case,VB,time\n1,0.2,60\n", sheet);
  ASSERT_TRUE(i.cases) << to_text(i.cases.error());
  EXPECT_TRUE(tune::times_of(*i.cases).empty());  // an hour of the edge is no hour of the step
  tune::PlannedStep planned;
  planned.step = read_sheet(sheet, "sheet.csv").value().front().planned;
  planned.step.from.plan_hash = "abc";
  Case of_plan = i.cases->front();
  of_plan.from.plan_hash = "abc";
  EXPECT_FALSE(tune::evidence_of(of_plan, planned).ln_time);
}

TEST(WearCases, OfRowsThatNameNoPartAreOfThePartThatIsNamed) {
  const Imported i = import("edge,VB,time\nE7,0.1,2\nE7,0.2,4\n", kSheet, "3");
  ASSERT_TRUE(i.cases) << to_text(i.cases.error());
  ASSERT_EQ(i.cases->size(), 1U);
  EXPECT_EQ(i.cases->front().from.part, "3");
  EXPECT_EQ(i.cases->front().from.workingstep, "FLAT");
}

TEST(WearCases, AreThoseOfAPartWhereOneIsNamed) {
  EXPECT_EQ(import("case,VB,time\n1,0.2,4\n3,0.2,4\n", kSheet, "3").cases.value().front().from.part, "3");
}

TEST(NasaWearCases, AreImportedFromTheFileAsItIs) {
  if (capstan::testing::corpus_folder().empty()) GTEST_SKIP() << "the corpus is absent";
  const auto sheet = read_file(capstan::testing::source_dir() + "/tests/validation/casebase/wear_sheet.csv");
  const auto table = read_file(capstan::testing::corpus_folder() + "/measured/nasa_milling/process_info.csv");
  ASSERT_TRUE(sheet && table);
  const Imported i = import(*table, *sheet);
  ASSERT_TRUE(i.cases) << to_text(i.cases.error());
  // Sixteen cases, of which 6 has one reading: that of the new edge.
  ASSERT_EQ(i.cases->size(), 15U);
  EXPECT_THAT(i.said, HasSubstr("edge 'wear.csv:6': its wear was never read after it had cut"));
  std::size_t readings = 0, lives = 0;
  for (const Case& c : *i.cases) {
    readings += c.observed.wear_series_mm.samples.size();
    lives += tune::life_of(tune::readings_of(c.observed.wear_series_mm), kWornMm) ? 1U : 0U;
  }
  EXPECT_EQ(readings, 145U);  // rows with a VB, but the one of case 6
  EXPECT_EQ(lives, 15U);
  EXPECT_EQ(tune::edges_of(*i.cases).size(), 15U);
}

}  // namespace
}  // namespace capstan::casebase::retain
