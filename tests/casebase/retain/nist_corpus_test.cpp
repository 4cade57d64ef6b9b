#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "casebase/retain/inspection.h"
#include "planner/ground/base/file.h"
#include "tests/casebase/retain/reading_logs.h"
#include "tests/support/corpus.h"

namespace capstan::casebase::retain {
namespace {

std::string folder() { return capstan::testing::corpus_folder() + "/measured/nist_plate"; }

TEST(NistPlateCorpus, TimesPerToolComeOutOfTheTracesAsTheTestBedCountedThem) {
  if (capstan::testing::corpus_folder().empty()) GTEST_SKIP() << "the corpus is absent";
  Job job;
  const auto text = read_file(folder() + "/times_per_tool.csv");
  ASSERT_TRUE(text);
  const auto counted = read_times(*text, "times_per_tool.csv", job);
  ASSERT_TRUE(counted) << to_text(counted.error());
  int compared = 0;
  for (const char* part : {"2", "5", "9", "12", "16", "18"}) {
    const std::string two = (std::string(part).size() < 2 ? "0" : "") + std::string(part);
    std::ifstream in(folder() + "/traces/Plate-Hurco04-" + two + "of20.txt", std::ios::binary);
    Splitter splitter({});
    const auto end = read_trace(
        in, two, kTraceUnits, [&](const Reading& r) { splitter.take(r); }, job);
    ASSERT_TRUE(end) << to_text(end.error());
    const auto totals = totals_by_tool(splitter.end());
    for (const Timed& t : *counted) {
      if (t.part != part) continue;
      const auto found = totals.find(t.tool);
      ASSERT_NE(found, totals.end()) << part << " T" << t.tool;
      EXPECT_NEAR(found->second.active_s, t.active_s, 0.02 * t.active_s) << part << " T" << t.tool;
      EXPECT_NEAR(found->second.moving_s, t.moving_s, 0.02 * t.moving_s) << part << " T" << t.tool;
      ++compared;
    }
  }
  EXPECT_EQ(compared, 42);  // six traces, seven tools
}

TEST(NistPlateCorpus, InspectionIsReadWhole) {
  if (capstan::testing::corpus_folder().empty()) GTEST_SKIP() << "the corpus is absent";
  Job job;
  const auto text = read_file(folder() + "/cmm_values.csv");
  ASSERT_TRUE(text);
  const auto rows = read_inspection(*text, "cmm_values.csv", 1.0, job);
  ASSERT_TRUE(rows) << to_text(rows.error());
  EXPECT_TRUE(job.diagnostics().empty());
  EXPECT_EQ(rows->size(), 434U);
}

}  // namespace
}  // namespace capstan::casebase::retain
