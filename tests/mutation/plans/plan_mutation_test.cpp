#include <gtest/gtest.h>

#include <cstdlib>

#include "tests/mutation/plans/plan_study.h"
#include "tests/support/soak.h"

namespace capstan::mutation {
namespace {

/// Other seeds in each repetition of `./dev soak`, and in each of its parts.
std::uint64_t next_seed() {
  const char* first = std::getenv("CAPSTAN_SEED");
  static std::uint64_t seed =
      first != nullptr
          ? std::strtoull(first, nullptr, 10)
          : 1 + 4000 * static_cast<std::uint64_t>(::testing::UnitTest::GetInstance()->random_seed());
  const std::uint64_t now = seed;
  seed += 1000;
  return now;
}

std::string told(const PlanRow& row) {
  std::string out;
  for (const std::string& t : row.told) out += t + "\n";
  return out;
}

TEST(MutationSeed, EveryEditOfAPlansValuesIsFoundAndNoBenignOneBlamed) {
  PlanOptions o;
  // Of 258 classes, most of four files: a soak of 50 repetitions asks for far more than 10,000 edits.
  o.edits = 1;
  o.first_seed = next_seed();
  int edits = 0, classes = 0;
  for (const PlanRow& row : study_plans(o)) {
    edits += row.edits;
    classes += row.edits > 0;
    EXPECT_EQ(row.missed, 0) << told(row);
    EXPECT_EQ(row.blamed, 0) << told(row);
  }
  EXPECT_GT(classes, 150);
  RecordProperty("edits", edits);
  if (soaking()) RecordProperty("first_seed", static_cast<int>(o.first_seed));
}

}  // namespace
}  // namespace capstan::mutation
