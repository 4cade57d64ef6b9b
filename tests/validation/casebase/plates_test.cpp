#include <gtest/gtest.h>

#include "tests/support/corpus.h"
#include "tests/validation/studies.h"

namespace capstan::validation {
namespace {

TEST(PlatesAsCases, AllPlatesAreImportedAndPredictedFromTheOthers) {
  if (capstan::testing::corpus_folder().empty()) GTEST_SKIP() << "the corpus is absent";
  const Comparison told = plates(capstan::testing::corpus_folder());
  ASSERT_TRUE(told.skipped.empty()) << told.skipped;
  EXPECT_NE(told.text.find("93 cases of 14 plates"), std::string::npos) << told.text.substr(0, 100);
}

TEST(PlatesAsCases, AreSkippedWithoutTheCorpus) { EXPECT_FALSE(plates("").skipped.empty()); }

}  // namespace
}  // namespace capstan::validation
