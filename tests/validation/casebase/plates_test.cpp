#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "tests/support/corpus.h"
#include "tests/validation/nist/bore_model.h"
#include "tests/validation/studies.h"

namespace capstan::validation {
namespace {

/// A column of a comparison's data, by its name.
std::vector<double> column(const Comparison& of, const std::string& file, const std::string& name) {
  std::vector<double> out;
  for (const auto& [at, content] : of.data) {
    if (at != file) continue;
    std::istringstream lines(content);
    std::string line, cell;
    std::getline(lines, line);
    std::istringstream head(line);
    std::size_t place = 0;
    while (head >> cell && cell != name) place += cell == "#" ? 0 : 1;
    EXPECT_EQ(cell, name);
    while (std::getline(lines, line)) {
      std::istringstream cells(line);
      for (std::size_t i = 0; i <= place; ++i) cells >> cell;
      out.push_back(std::stod(cell));
    }
  }
  return out;
}

double rms(const std::vector<double>& a, const std::vector<double>& b, bool of_logarithms) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const double off = of_logarithms ? std::log(a[i] / b[i]) : a[i] - b[i];
    sum += off * off;
  }
  return std::sqrt(sum / static_cast<double>(a.size()));
}

class PlatesAsCases : public ::testing::Test {
 protected:
  void SetUp() override {
    if (capstan::testing::corpus_folder().empty()) GTEST_SKIP() << "the corpus is absent";
    static const Comparison kTold = plates(capstan::testing::corpus_folder());
    ASSERT_TRUE(kTold.skipped.empty()) << kTold.skipped;
    told_ = kTold;
  }
  Comparison told_;
};

TEST_F(PlatesAsCases, AllPlatesAreImportedAndPredictedFromTheOthers) {
  EXPECT_NE(told_.text.find("93 cases of 14 plates"), std::string::npos) << told_.text.substr(0, 100);
}

TEST_F(PlatesAsCases, BoresByTheShippedLawAreNearerThanByStaticBending) {
  const auto measured = column(told_, "plates_bores.dat", "measured");
  ASSERT_EQ(measured.size(), 14U);
  const double bending = rms(column(told_, "plates_bores.dat", "bending"), measured, false);
  EXPECT_LT(rms(column(told_, "plates_bores.dat", "predicted"), measured, false), 0.5 * bending);
}

TEST_F(PlatesAsCases, StaticBendingOfSlenderToolsHasTheWrongSign) {
  const auto measured = column(told_, "plates_bores.dat", "measured"),
             bending = column(told_, "plates_bores.dat", "bending");
  int wrong = 0;
  for (std::size_t i = 0; i < measured.size(); ++i) {
    EXPECT_LT(bending[i], 0.0);
    wrong += measured[i] > 0.0 ? 1 : 0;
  }
  EXPECT_EQ(wrong, 6);  // all six of the long stick-out
}

TEST_F(PlatesAsCases, TimesAreNearerTunedThanByTheMachineThatNobodyCalibrated) {
  const auto measured = column(told_, "plates_times.dat", "measured");
  ASSERT_EQ(measured.size(), 85U);
  EXPECT_LT(rms(column(told_, "plates_times.dat", "tuned"), measured, true),
            rms(column(told_, "plates_times.dat", "motion"), measured, true));
}

TEST_F(PlatesAsCases, TheSheetSaysWhatTheProgramAimsBoresAt) {
  const auto plate = nist::read_plate(capstan::testing::corpus_folder() + "/measured/nist_plate",
                                      capstan::testing::source_dir() + "/tests/validation/nist_plate.yaml");
  ASSERT_TRUE(plate);
  const std::string sheet =
      capstan::testing::slurp(capstan::testing::source_dir() + "/tests/validation/nist/plate_sheet.csv");
  for (const int program : {2, 20}) {
    for (const auto& [tool, nominal_mm] : std::map<int, double>{{5, 4.0}, {1, 3.0}}) {
      const double diameter_mm = tool == 5 ? 3.175 : 2.3622;
      for (const nist::ToolRun& run : plate->programs.at(program)) {
        if (run.tool != tool) continue;
        // The rows of the sheet say 0.028, to a micrometre.
        EXPECT_NEAR(nist::programmed(run, diameter_mm, nominal_mm).diameter_mm - nominal_mm, 0.028, 0.0006)
            << program << " T" << tool;
      }
    }
  }
  std::size_t rows = 0;
  for (std::size_t at = 0; (at = sheet.find(",0.028,entered", at)) != std::string::npos; ++at) ++rows;
  EXPECT_EQ(rows, 4U);
}

TEST(PlatesWithoutTheCorpus, AreSkipped) { EXPECT_FALSE(plates("").skipped.empty()); }

}  // namespace
}  // namespace capstan::validation
