#include "tests/validation/nist/plate_time.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/corpus.h"

namespace capstan::validation::nist {
namespace {

constexpr double kWanted = 0.10;

class PlateTimes : public ::testing::Test {
 protected:
  void SetUp() override {
    CAPSTAN_CORPUS_FILE(folder, "measured/nist_plate");
    // Of all tests; what is studied refers to the plate.
    static const auto kRead =
        read_plate(folder, capstan::testing::source_dir() + "/tests/validation/nist_plate.yaml");
    ASSERT_TRUE(kRead) << to_text(kRead.error());
    static const auto kStudy = study_times(*kRead);
    ASSERT_TRUE(kStudy) << to_text(kStudy.error());
    plate_ = *kRead;
    study_ = *kStudy;
  }
  Plate plate_;
  TimeStudy study_;
};

TEST_F(PlateTimes, OfTestPartsAreWithinTenPerCentWhereTheFeedIsKnown) {
  int n = 0;
  for (const Row& r : study_.rows) {
    if (r.part->calibrates || r.part->interrupted || r.part->part == 7)
      continue;  // 7: see docs/validation.md
    EXPECT_LE(std::abs(r.error()), kWanted) << "part " << r.part->part << " tool " << r.time->tool;
    ++n;
  }
  EXPECT_EQ(n, 38);
}

TEST_F(PlateTimes, OfTheTracesAreThoseOfTheTable) {
  // Both are of the same stream: what the columns mean is read from it.
  int n = 0;
  for (const auto& [part, tools] : plate_.traces) {
    for (const ToolTime& t : plate_.times) {
      const auto trace = tools.find(t.tool);
      if (t.part != part || trace == tools.end()) continue;
      EXPECT_NEAR(trace->second.feeding_s + trace->second.later_feeding_s, t.feeding_s, 0.02)
          << part << " " << t.tool;
      EXPECT_NEAR(trace->second.active_s + trace->second.later_active_s, t.active_s, 0.02)
          << part << " " << t.tool;
      ++n;
    }
  }
  EXPECT_EQ(n, 6 * 7);
}

TEST_F(PlateTimes, OfPartSevenAreThoseOfPartNinesFeeds) {
  const auto rows = part_7_as_part_9(plate_, study_);
  ASSERT_TRUE(rows);
  ASSERT_EQ(rows->size(), 7U);
  for (const Row& r : *rows) EXPECT_LE(std::abs(r.error()), kWanted) << r.time->tool;
}

}  // namespace
}  // namespace capstan::validation::nist
