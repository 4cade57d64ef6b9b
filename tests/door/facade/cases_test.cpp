#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <string>

#include "capstan/capstan.h"
#include "tests/support/corpus.h"

// Importing logs by the library, as other programs do.

namespace capstan {
namespace {

using ::testing::HasSubstr;

class FacadeImport : public ::testing::Test {
 protected:
  void SetUp() override {
    std::string name = (std::filesystem::temp_directory_path() / "capstan-import-XXXXXX").string();
    folder_ = mkdtemp(name.data());
    what_.cases = folder_ / "shop.db";
    what_.format = "wear";
    what_.plan = examples_ + "wear_sheet.csv";
    what_.logs = {examples_ + "wear.csv"};
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  /// The only error, where nothing may have been kept.
  PlanMessage refused() const {
    const CaseImportOutput out = import_cases(what_);
    EXPECT_FALSE(out.imported);
    EXPECT_FALSE(std::filesystem::exists(what_.cases));
    EXPECT_FALSE(out.diagnostics.empty());
    return out.diagnostics.empty() ? PlanMessage{} : out.diagnostics.back();
  }

  const std::string examples_ = capstan::testing::source_dir() + "/examples/";
  std::filesystem::path folder_;
  CaseImport what_;
};

TEST_F(FacadeImport, KeepsEachCaseOnce) {
  const CaseImportOutput first = import_cases(what_);
  ASSERT_TRUE(first.imported);
  EXPECT_EQ(first.cases, 3U);
  EXPECT_EQ(first.added, 3U);
  EXPECT_EQ(first.held, 3U);
  const CaseImportOutput again = import_cases(what_);
  EXPECT_EQ(again.added, 0U);
  EXPECT_EQ(again.held, 3U);
}

TEST_F(FacadeImport, RefusesWhatItCannotUseAndKeepsNothing) {
  what_.format = "qif";
  EXPECT_THAT(refused().text, HasSubstr("trace, csv, linuxcnc, times or wear"));
  what_.format = "wear";
  what_.unit = "furlong";
  EXPECT_EQ(refused().code, "USAGE-IMPORT");
  what_.unit = "mm";
  what_.period_s = 0.0;
  EXPECT_EQ(refused().code, "USAGE-IMPORT");
  what_.period_s = 0.001;
  what_.parts = {"1", "2"};
  EXPECT_EQ(refused().code, "USAGE-IMPORT");
  what_.parts = {};
  what_.triggers = {"colour"};
  EXPECT_THAT(refused().text, HasSubstr("'colour' is no trigger"));
  what_.triggers = {};
  const std::vector<std::string> logs = what_.logs;
  what_.logs = {};
  EXPECT_THAT(refused().text, HasSubstr("no log is named"));
  what_.logs = logs;
  what_.logs.push_back(folder_ / "none.csv");  // the first log alone is not kept either
  EXPECT_EQ(refused().code, "FILE-READ");
}

}  // namespace
}  // namespace capstan
