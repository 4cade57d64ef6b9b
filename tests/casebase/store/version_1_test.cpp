#include "casebase/store/version_1.h"
#include "casebase/recall/recall.h"

#include "casebase/casebase.h"
#include "tests/casebase/sample.h"
#include "tests/casebase/store/old_files.h"

namespace capstan::casebase {
namespace {

TEST(CaseStoreVersion1, IsReadWithoutBeingAltered) {
  const Folder folder;
  const std::string path = file_of_version_1(folder);
  Job job;
  const auto base = CaseBase::open(path, job);
  ASSERT_TRUE(base.has_value()) << to_text(base.error());
  EXPECT_EQ(job.count(Severity::kWarning), 0u);
  const std::vector<Case> cases = base->cases();
  ASSERT_EQ(cases.size(), 2u);
  for (const Case& c : cases) {
    EXPECT_EQ(c.id, id_of(c));
    EXPECT_EQ(c.asked.operation, "DRILLING");
    EXPECT_EQ(c.asked.cutter_diameter_mm, c.asked.diameter_mm);
    EXPECT_EQ(c.asked.coolant, Coolant::kFlood);
    EXPECT_EQ(c.bound.vc_m_min, 30.0);
    EXPECT_EQ(c.observed.time_s, (Figure{6.5, 0.0, Origin::kMeasured}));
    EXPECT_FALSE(c.observed.peak_force_n.has_value());  // zero was not known
    EXPECT_EQ(c.observed.verdict, Verdict::kGood);
    EXPECT_EQ(c.from.source, "part 1");
  }
  Question q = sample().asked;
  EXPECT_EQ(advise(evidence_near(*base, q).value(), {}).start.vc_m_min, 30.0);
  tamper(path, "UPDATE capstan_total SET count = count");  // still a table of version 1
}

TEST(CaseStoreVersion1, BecomesVersion3WhenSomethingIsAdded) {
  const Folder folder;
  const std::string path = file_of_version_1(folder);
  Job job;
  std::vector<Case> before;
  {
    auto base = CaseBase::open(path, job).value();
    before = base.cases();
    ASSERT_TRUE(base.add(sample(30.0)).has_value());
    ASSERT_TRUE(base.add(sample(31.0)).has_value());
  }
  const auto base = CaseBase::open(path, job);
  ASSERT_TRUE(base.has_value()) << to_text(base.error());
  EXPECT_EQ(base->size(), 4u);
  for (const Case& c : before) EXPECT_EQ(base->get(c.id).value(), c);
  EXPECT_EQ(job.count(Severity::kWarning), 0u);
}

TEST(CaseStoreVersion1, LeavesOutAnAlteredRowAndIsNotTurnedIntoVersion3) {
  for (const std::string change : {"vc_m_min = 31.0", "teeth = 4", "source = 'x'", "verdict = 'bad'"}) {
    const Folder folder;
    const std::string path =
        file_of_version_1(folder, "UPDATE capstan_case SET " + change + " WHERE diameter_mm = 10.0;");
    Job job;
    auto base = CaseBase::open(path, job).value();
    EXPECT_EQ(base.size(), 1u) << change;
    EXPECT_NE(job.count(Severity::kWarning), 0u);
    EXPECT_FALSE(base.whole());
    EXPECT_EQ(base.add(sample(30.0)).error().code, "CASE-DAMAGED");
  }
}

TEST(CaseStoreVersion1, IsTurnedIntoVersion3ByTwoProgramsOnce) {
  const Folder folder;
  const std::string path = file_of_version_1(folder);
  Job job;
  auto one = CaseBase::open(path, job).value(), other = CaseBase::open(path, job).value();
  ASSERT_TRUE(one.add(sample(30.0)).has_value());
  const Status second = other.add(sample(31.0));
  ASSERT_TRUE(second.has_value()) << to_text(second.error());
  EXPECT_EQ(other.size(), 4u);
  EXPECT_EQ(CaseBase::open(path, job)->size(), 4u);
}

TEST(CaseStoreVersion1, RefusesATableThatIsNotItsOwn) {
  const Folder folder;
  Job job;
  EXPECT_EQ(CaseBase::open(file_of_version_1(folder, "CREATE TABLE more(x);"), job).error().code,
            "CASE-SCHEMA");
}

}  // namespace
}  // namespace capstan::casebase
