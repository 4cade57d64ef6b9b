#include "tests/validation/catalogue/record.h"

#include <gtest/gtest.h>

#include <set>

#include "tests/support/corpus.h"
#include "tests/support/shop.h"
#include "tests/validation/report.h"
#include "tests/validation/studies.h"

namespace capstan::validation::catalogue {
namespace {

const Row kMade{"generic_vmc", "slot", "C45", 21.3, 29.3, 0, "rings", "", ""};
const Row kRefused{"small_router", "slot", "50 HRC", 0.0, 80.0, 1, "", "", "no cutter fits; 6000 1/min"};

TEST(CatalogueRecord, IsReadAsItIsWritten) {
  const auto rows = read(written({kMade, kRefused}));
  ASSERT_EQ(rows.size(), 2U);
  EXPECT_EQ(rows[0], kMade);
  EXPECT_EQ(rows[1], kRefused);
  EXPECT_DOUBLE_EQ(rows[0].ratio(), 21.3 / 29.3);
  EXPECT_EQ(rows[1].ratio(), 0.0);
}

TEST(CatalogueRecord, KeepsCommasOfReasonsOutOfItsCells) {
  testing::sweep::Outcome o;
  o.failed = "no tool, of 2,\nat all";
  const Row r = row_of({0, 0, 0}, o);
  EXPECT_EQ(r.refused, "no tool; of 2; at all");
  ASSERT_EQ(read(written({r})).size(), 1U);
  EXPECT_EQ(read(written({r})).front(), r);
  EXPECT_THROW((void)read(written({r}) + "a,b,c,1.0,2.0,none,,,\n"), std::runtime_error);
  EXPECT_THROW((void)read(written({r}) + "a,b,c,1.0\n"), std::runtime_error);
}

TEST(CatalogueRecord, IsApartWhereATimeDiffersByMoreThanRoundingOrAFeatureIsMissing) {
  Row now = kMade;
  now.plan_s += 0.1;
  EXPECT_EQ(apart(kMade, now), "");
  now.plan_s += 0.1;
  EXPECT_EQ(apart(kMade, now), "plan, s 21.5, recorded 21.3");
  now = kMade;
  now.not_made = 1;
  EXPECT_EQ(apart(kMade, now), "features not made 1.0, recorded 0.0");
  now = kMade;
  now.clearing = "constant engagement";
  EXPECT_EQ(apart(kMade, now), "clearing 'constant engagement', recorded 'rings'");
}

TEST(CatalogueRecord, HasARowForEachCaseOnce) {
  const auto rows =
      read(capstan::testing::slurp(capstan::testing::source_dir() + "/docs/validation/catalogue_times.csv"));
  std::set<std::string> names;
  for (const Row& r : rows) names.insert(r.machine + "," + r.feature + "," + r.material);
  EXPECT_EQ(rows.size(), testing::sweep::all_cases().size());
  EXPECT_EQ(names.size(), rows.size());
  for (const auto& c : testing::sweep::all_cases()) EXPECT_TRUE(row_for(rows, c)) << c.name();
}

// No error finding, no feed or chip below the least, no wall predicted out of its zone, no limit exceeded, no
// refusal that does not help: `sweep::broken`.
TEST(CatalogueRecord, HasNoPlanThatBreaksWhatItPromises) {
  const auto rows =
      read(capstan::testing::slurp(capstan::testing::source_dir() + "/docs/validation/catalogue_times.csv"));
  for (const Row& r : rows) EXPECT_EQ(r.broken, "") << r.machine << ", " << r.feature << ", " << r.material;
}

// Nine of the 36 cases are planned for it; ./dev validate plans all of them.
TEST(CatalogueTimes, StandInTheDocumentAsRecordedAndAsPlannedNow) {
  const std::string root = capstan::testing::source_dir();
  const Comparison c = catalogue_times(root + "/docs/validation/catalogue_times.csv", Extent::kSample);
  ASSERT_EQ(c.skipped, "");
  const std::string stands = standing(capstan::testing::slurp(root + "/docs/validation.md"), c.name);
  for (const std::string& line : c.lines) {
    EXPECT_EQ(line.rfind("Apart from the record", 0), std::string::npos) << line;
    EXPECT_NE(stands.find("\n" + line), std::string::npos) << "run ./dev validate; now " << line;
  }
}

}  // namespace
}  // namespace capstan::validation::catalogue
