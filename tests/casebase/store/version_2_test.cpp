#include "casebase/intake.h"
#include "casebase/store/row.h"
#include "casebase/store/store.h"
#include "tests/casebase/postgres.h"
#include "tests/casebase/sample.h"
#include "tests/casebase/store/old_files.h"

namespace capstan::casebase {
namespace {

/// The ids that the index of a file does not have, or has at another row.
int unindexed(const std::string& path) {
  sqlite3* db = nullptr;
  EXPECT_EQ(sqlite3_open(path.c_str(), &db), SQLITE_OK);
  sqlite3_stmt* s = nullptr;
  EXPECT_EQ(sqlite3_prepare_v2(db,
                               "SELECT count(*) FROM capstan_head LEFT JOIN capstan_id ON "
                               "substr(head, 3, 16) = id WHERE substr(head, 2, 1) = x'00' AND "
                               "capstan_id.number IS NOT capstan_head.number",
                               -1, &s, nullptr),
            SQLITE_OK);
  EXPECT_EQ(sqlite3_step(s), SQLITE_ROW);
  const int out = sqlite3_column_int(s, 0);
  sqlite3_finalize(s);
  sqlite3_close(db);
  return out;
}

TEST(CaseStoreVersion2, IsReadWithoutBeingAltered) {
  const Folder folder;
  const std::vector<Case> cases = random_cases(40, 3);
  const std::string path = file_of_version_2(folder, cases);
  Job job;
  const auto base = CaseBase::open(path, job);
  ASSERT_TRUE(base.has_value()) << to_text(base.error());
  EXPECT_EQ(base->cases().size(), cases.size());
  for (const Case& c : cases) EXPECT_EQ(base->get(c.id).value(), c);
  EXPECT_EQ(job.count(Severity::kWarning), 0u);
  tamper(path, "PRAGMA user_version = 2");
  EXPECT_TRUE(CaseBase::open(path, job).has_value());  // still without the table of ids
}

TEST(CaseStoreVersion2, BecomesVersion3WhenSomethingIsAddedWithAllItsIds) {
  const Folder folder;
  const std::vector<Case> cases = random_cases(2000, 5);
  const std::string path = file_of_version_2(folder, cases);
  Job job;
  auto intake = Intake::open_or_create(path, job).value();
  const auto unread = intake.add(std::vector{sample(30.0)});
  ASSERT_TRUE(unread.has_value());
  EXPECT_FALSE(unread->has_value());  // without the ids it has to be read
  {
    auto base = intake.read(job).value();
    ASSERT_TRUE(base.judge(std::vector{cases[7].id}, Verdict::kBad, {"A. Smith", "", "worn"}).has_value());
    ASSERT_TRUE(base.add(sample(30.0)).has_value());
  }
  EXPECT_EQ(unindexed(path), 0);
  auto next = Intake::open_or_create(path, job).value();
  const auto added = next.add(std::vector{sample(31.0)});
  ASSERT_TRUE(added.has_value() && *added);
  EXPECT_EQ((*added)->held, cases.size() + 2);
  EXPECT_EQ(unindexed(path), 0);
  const auto base = CaseBase::open(path, job).value();
  EXPECT_EQ(base.size(), cases.size() + 2);
  EXPECT_EQ(base.get(cases[7].id)->observed.verdict, Verdict::kBad);
  EXPECT_EQ(job.count(Severity::kWarning), 0u);
}

TEST(CaseStoreVersion2, IsTurnedIntoVersion3ByTwoProgramsOnce) {
  const Folder folder;
  const std::string path = file_of_version_2(folder, {sample(10.0), sample(20.0)});
  Job job;
  auto one = CaseBase::open(path, job).value(), other = CaseBase::open(path, job).value();
  ASSERT_TRUE(one.add(sample(30.0)).has_value());
  ASSERT_TRUE(other.add(sample(31.0)).has_value());
  EXPECT_EQ(unindexed(path), 0);
  EXPECT_EQ(CaseBase::open(path, job)->size(), 4u);
}

TEST(CaseStoreVersion2, IsNotTurnedIntoVersion3WhereARowWasAltered) {
  const Folder folder;
  const std::string path = file_of_version_2(folder, {sample(10.0), sample(20.0)});
  tamper(path,
         "UPDATE capstan_head SET head = CAST(substr(head, 1, 40) || x'ff' || substr(head, 42) AS BLOB) "
         "WHERE number = 1");
  Job job;
  auto base = CaseBase::open(path, job).value();
  EXPECT_EQ(base.add(sample(30.0)).error().code, "CASE-DAMAGED");
  tamper(path, "PRAGMA user_version = 2");
  EXPECT_EQ(CaseBase::open(path, job)->size(), 1u);
}

TEST(CaseStoreVersion2, RefusesTheTableOfIdsThatItDidNotHave) {
  const Folder folder;
  Job job;
  const std::string path = file_of_version_2(folder, {sample()});
  tamper(path, "CREATE TABLE capstan_id(id BLOB PRIMARY KEY, number INTEGER NOT NULL) STRICT, WITHOUT ROWID");
  EXPECT_EQ(CaseBase::open(path, job).error().code, "CASE-SCHEMA");
}

/// A server's base of version 1, which had no index of ids.
class PostgresVersion1 : public testing::Test {
 protected:
  void SetUp() override {
    place_ = PostgresPlace::make();
    if (!place_) GTEST_SKIP() << "there is no PostgreSQL on this machine";
    fill(place_->uri(), cases_);
    const std::string totals = totals_of_version_2(place_->uri());
    place_->sql("DROP TABLE capstan.id; UPDATE capstan.total SET totals = '\\x" + totals +
                "'; COMMENT ON SCHEMA capstan IS 'Capstan case base, version 1'");
  }
  std::string version() const {
    return place_->sql("SELECT obj_description('capstan'::regnamespace, 'pg_namespace')");
  }
  std::vector<Case> cases_ = random_cases(50, 13);
  std::unique_ptr<PostgresPlace> place_;
  Job job_;
};

TEST_F(PostgresVersion1, IsReadAndAddedToAsItIsByWhoMakesNone) {
  auto base = CaseBase::open(place_->uri(), job_);
  ASSERT_TRUE(base.has_value()) << to_text(base.error());
  EXPECT_EQ(base->size(), cases_.size());
  ASSERT_TRUE(base->add(sample(30.0)).has_value());
  EXPECT_EQ(version(), "Capstan case base, version 1");
  // Its totals are what a program of that version reads.
  EXPECT_EQ(place_->sql("SELECT get_byte(totals, 0) FROM capstan.total"), "2");
  EXPECT_EQ(CaseBase::open(place_->uri(), job_)->size(), cases_.size() + 1);
  EXPECT_EQ(job_.count(Severity::kWarning), 0u);
}

TEST_F(PostgresVersion1, BecomesVersion2WithAllItsIds) {
  auto intake = Intake::open_or_create(place_->uri(), job_).value();
  EXPECT_EQ(version(), "Capstan case base, version 2");
  EXPECT_EQ(place_->sql("SELECT count(*) FROM capstan.id"), std::to_string(cases_.size()));
  const auto unread = intake.add(std::vector{sample(30.0)});
  ASSERT_TRUE(unread.has_value());
  EXPECT_FALSE(unread->has_value());  // its totals do not state how many cases there are
  ASSERT_TRUE(intake.read(job_)->add(sample(30.0)).has_value());
  auto next = Intake::open_or_create(place_->uri(), job_).value();
  const auto added = next.add(std::vector{sample(31.0)});
  ASSERT_TRUE(added.has_value() && *added);
  EXPECT_EQ((*added)->held, cases_.size() + 2);
  EXPECT_EQ(CaseBase::open(place_->uri(), job_)->size(), cases_.size() + 2);
  EXPECT_EQ(job_.count(Severity::kWarning), 0u);
}

}  // namespace
}  // namespace capstan::casebase
