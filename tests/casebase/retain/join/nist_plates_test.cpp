#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <map>
#include <set>
#include <string>

#include "casebase/retain/join/import.h"
#include "casebase/tune/from_case.h"
#include "planner/ground/base/file.h"
#include "tests/support/corpus.h"

namespace capstan::casebase::retain {
namespace {

constexpr int kEngraver = 23;  // its row of the table holds a later run of another program, too

std::string folder() { return capstan::testing::corpus_folder() + "/measured/nist_plate"; }

struct Plates {
  std::vector<Step> steps;
  ImportOptions options;
  std::vector<Timed> counted;
};

Plates read_plates(Job& job) {
  const auto sheet = read_file(capstan::testing::source_dir() + "/tests/validation/nist/plate_sheet.csv");
  const auto measured = read_file(folder() + "/cmm_values.csv");
  const auto times = read_file(folder() + "/times_per_tool.csv");
  if (!sheet || !measured || !times) return {};
  auto steps = read_sheet(*sheet, "plate_sheet.csv");
  auto rows = read_inspection(*measured, "cmm_values.csv", 1.0, job);
  auto counted = read_times(*times, "times_per_tool.csv", job);
  EXPECT_TRUE(steps) << (steps ? std::string() : to_text(steps.error()));
  if (!steps || !rows || !counted) return {};
  return {*std::move(steps), {.inspection = *std::move(rows)}, *std::move(counted)};
}

TEST(NistPlateCases, SixTracesGiveTheTimesPerToolWithinTwoPercent) {
  if (capstan::testing::corpus_folder().empty()) GTEST_SKIP() << "the corpus is absent";
  Job job;
  const Plates plates = read_plates(job);
  int compared = 0;
  for (const char* part : {"2", "5", "9", "12", "16", "18"}) {
    const std::string two = (std::string(part).size() < 2 ? "0" : "") + std::string(part);
    std::ifstream in(folder() + "/traces/Plate-Hurco04-" + two + "of20.txt", std::ios::binary);
    const auto cases =
        import_log(in, LogFormat::kTrace, plates.steps, {.part = part, .file = two}, plates.options, job);
    ASSERT_TRUE(cases) << to_text(cases.error());
    ASSERT_EQ(cases->size(), 7U) << part;  // a case per tool: the later run makes none
    std::map<std::string, int> tool_of;
    for (const Step& s : plates.steps) tool_of[s.id] = s.tool;
    for (const Case& c : *cases) {
      EXPECT_EQ(c.from.part, part);
      EXPECT_FALSE(c.from.time_utc.empty());
      for (const Timed& t : plates.counted) {
        if (t.part != part || t.tool != tool_of.at(c.from.workingstep) || t.tool == kEngraver) continue;
        EXPECT_NEAR(c.observed.time_s->value, t.moving_s, 0.02 * t.moving_s) << part << " T" << t.tool;
        ++compared;
      }
      // What the program asked of the tool, as the sheet of the experiment has it (part 5: the trace has it).
      for (const Timed& t : plates.counted) {
        if (t.part != part || t.tool != tool_of.at(c.from.workingstep) || c.from.part == std::string("5"))
          continue;
        const double rpm = c.bound.vc_m_min * 1000.0 / 3.14159265358979 / c.asked.cutter_diameter_mm;
        EXPECT_NEAR(rpm, t.spindle_rpm, 0.02 * t.spindle_rpm) << part << " T" << t.tool;
      }
    }
  }
  EXPECT_EQ(compared, 36);  // six traces, seven tools but the engraver
}

TEST(NistPlateCases, FourteenPlatesAreImportedWithTheirBores) {
  if (capstan::testing::corpus_folder().empty()) GTEST_SKIP() << "the corpus is absent";
  Job job;
  const Plates plates = read_plates(job);
  std::ifstream in(folder() + "/times_per_tool.csv", std::ios::binary);
  const auto cases =
      import_log(in, LogFormat::kTimes, plates.steps, {.file = "times_per_tool.csv"}, plates.options, job);
  ASSERT_TRUE(cases) << to_text(cases.error());
  EXPECT_EQ(cases->size(), plates.counted.size());
  std::set<std::string> parts;
  int bores = 0, bad = 0;
  for (const Case& c : *cases) {
    parts.insert(c.from.part);
    bores += c.observed.size_deviation_mm ? 1 : 0;
    bad += c.observed.verdict == Verdict::kBad ? 1 : 0;
  }
  EXPECT_EQ(parts.size(), 14U);
  EXPECT_EQ(bores, 28);  // by two tools in each plate
  EXPECT_EQ(bad, 3);     // plates whose 4 mm bores are 0.25 mm too wide: 14, 16 and 18
  // Tuning hears each of them, for the sheet says what their paths aim at.
  const tune::Corrections made = tune::corrections_of(*cases, {});
  ASSERT_EQ(made.bores.size(), 2U);
  for (const auto& [cutter, of] : made.bores) EXPECT_EQ(of.how.cases, 14U) << cutter;
  ASSERT_TRUE(made.bores.at(3.175).how.left_out);
  // Nearer than the size that was programmed: the 4 mm bores come out 0.05 mm smaller to 0.4 mm larger.
  double square = 0.0;
  const auto bores_of_cutter = tune::bores_by_cutter(*cases).at(3.175);
  for (const tune::BoreSample& b : bores_of_cutter) square += b.deviation_mm * b.deviation_mm;
  EXPECT_LT(made.bores.at(3.175).how.left_out->rms,
            0.5 * std::sqrt(square / static_cast<double>(bores_of_cutter.size())));
}

}  // namespace
}  // namespace capstan::casebase::retain
