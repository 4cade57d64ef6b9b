#include "casebase/recall/recall.h"
#include "casebase/store/log.h"

#include <sys/resource.h>
#include <sys/stat.h>

#include <algorithm>
#include <csignal>
#include <fstream>
#include <iterator>
#include <limits>
#include <map>
#include <set>

#include "tests/casebase/sample.h"
#include "tests/casebase/store/failing_disk.h"

namespace capstan::casebase {
namespace {

using testing::HasSubstr;

std::string code_of_opening(const std::string& path) {
  Job job;
  const auto base = CaseBase::open(path, job);
  return base ? "" : base.error().code;
}

TEST(CaseStore, KeepsWhatWasAdded) {
  const Folder folder;
  std::vector<Case> cases = random_cases(100, 1);
  fill(folder.file(), cases);
  Job job;
  for (const std::string& uri : {folder.file(), "sqlite:" + folder.file()}) {
    const auto base = CaseBase::open(uri, job);
    ASSERT_TRUE(base.has_value()) << to_text(base.error());
    std::sort(cases.begin(), cases.end(), [](const Case& a, const Case& b) { return a.id < b.id; });
    EXPECT_EQ(base->cases(), cases);
  }
  EXPECT_EQ(job.count(Severity::kWarning), 0u);
}

TEST(CaseStore, AddsAllOrNone) {
  const Folder folder;
  fill(folder.file(), {sample()});
  Job job;
  auto base = CaseBase::open(folder.file(), job).value();
  Case wrong = sample(11.0);
  wrong.bound.vc_m_min = std::numeric_limits<double>::quiet_NaN();
  const std::vector<Case> both = {sample(12.0), wrong};
  const Status added = base.add(both);
  ASSERT_FALSE(added.has_value());
  EXPECT_EQ(added.error().code, "CASE-INVALID");
  EXPECT_THAT(added.error().message, HasSubstr("case 2 of 2"));
  EXPECT_EQ(base.size(), 1u);
  EXPECT_EQ(CaseBase::open(folder.file(), job)->size(), 1u);
}

TEST(CaseStore, RefusesAMissingFileAndDoesNotMakeIt) {
  const Folder folder;
  EXPECT_EQ(code_of_opening(folder.file()), "CASE-OPEN");
  EXPECT_FALSE(std::filesystem::exists(folder.file()));
  EXPECT_EQ(code_of_opening(folder.path()), "CASE-OPEN");
}

TEST(CaseStore, RefusesOtherUris) {
  for (const std::string uri : {"", "sqlite:", "sqlite:postgresql://host/cases", "http://host/x"}) {
    EXPECT_EQ(code_of_opening(uri), "CASE-URI") << uri;
  }
}

TEST(CaseStore, RefusesWhatIsNoCaseBase) {
  const Folder folder;
  write_file(folder.file("empty"), "");
  EXPECT_EQ(code_of_opening(folder.file("empty")), "CASE-SCHEMA");
  write_file(folder.file("text"), std::string(5000, 'x'));
  EXPECT_EQ(code_of_opening(folder.file("text")), "CASE-SCHEMA");
  tamper(folder.file("other"), "CREATE TABLE people(name)");
  EXPECT_EQ(code_of_opening(folder.file("other")), "CASE-SCHEMA");
  Job job;
  EXPECT_FALSE(CaseBase::open_or_create(folder.file("other"), job).has_value());
}

TEST(CaseStore, RefusesANewerSchema) {
  const Folder folder;
  fill(folder.file(), {sample()});
  tamper(folder.file(), "PRAGMA user_version = 4");
  Job job;
  const auto base = CaseBase::open(folder.file(), job);
  ASSERT_FALSE(base.has_value());
  EXPECT_EQ(base.error().code, "CASE-SCHEMA");
  EXPECT_THAT(base.error().message, HasSubstr("version 4"));
}

TEST(CaseStore, RefusesWhatItDidNotMake) {
  for (const std::string sql : {
           "CREATE TRIGGER t AFTER INSERT ON capstan_head BEGIN DELETE FROM capstan_head; END",
           "CREATE VIEW v AS SELECT * FROM capstan_head",
           "CREATE INDEX i ON capstan_head(head)",
           "CREATE TABLE more(x)",
           "DROP TABLE capstan_total",
           "ALTER TABLE capstan_head ADD COLUMN more TEXT",
           "ALTER TABLE capstan_head RENAME TO real; CREATE VIEW capstan_head AS SELECT * FROM real",
       }) {
    const Folder folder;
    fill(folder.file(), {sample()});
    tamper(folder.file(), sql);
    EXPECT_EQ(code_of_opening(folder.file()), "CASE-SCHEMA") << sql;
  }
}

TEST(CaseStore, RefusesATriggerThatCameAfterOpening) {
  const Folder folder;
  fill(folder.file(), {sample()});
  Job job;
  auto base = CaseBase::open(folder.file(), job).value();
  tamper(folder.file(), "CREATE TRIGGER t AFTER INSERT ON capstan_head BEGIN DELETE FROM capstan_head; END");
  EXPECT_EQ(base.add(sample(11.0)).error().code, "CASE-SCHEMA");
  EXPECT_EQ(base.size(), 1u);
}

TEST(CaseStore, NamesAFileThatIsCutShort) {
  const Folder folder;
  fill(folder.file(), {sample(10.0), sample(20.0)});
  std::filesystem::resize_file(folder.file(), 50);
  Job job;
  const auto base = CaseBase::open(folder.file(), job);
  ASSERT_FALSE(base.has_value());
  EXPECT_EQ(base.error().code, "CASE-DAMAGED");
  EXPECT_THAT(base.error().message, HasSubstr("damaged or cut short"));
  EXPECT_THAT(base.error().hint, HasSubstr("from a copy"));
}

TEST(CaseStore, LeavesOutAndNamesARowWhoseHeadWasAltered) {
  for (const std::string change : {"substr(head, 1, 40) || x'ff' || substr(head, 42)", "x''", "head || x'00'",
                                   "'text' || ''", "(SELECT head FROM capstan_head WHERE number = 2)"}) {
    const Folder folder;
    fill(folder.file(), {sample(10.0), sample(20.0)});
    tamper(folder.file(), "UPDATE capstan_head SET head = CAST(" + change + " AS BLOB) WHERE number = 1");
    Job job;
    auto base = CaseBase::open(folder.file(), job);
    ASSERT_TRUE(base.has_value()) << to_text(base.error());
    EXPECT_EQ(base->cases(), std::vector<Case>{sample(20.0)}) << change;
    ASSERT_NE(job.count(Severity::kWarning), 0u);
    EXPECT_EQ(job.diagnostics()[0].code, "CASE-ROW");
    EXPECT_THAT(job.diagnostics()[0].message, HasSubstr("row 1 is left out"));
    EXPECT_EQ(base->add(sample(30.0)).error().code, "CASE-DAMAGED");
  }
}

TEST(CaseStore, LeavesOutAndNamesARowWhoseBodyWasAlteredWhenItIsUsed) {
  for (const std::string sql :
       {"UPDATE capstan_body SET body = CAST(substr(body, 1, 40) || x'ff' || substr(body, 42) "
        "AS BLOB) WHERE number = 1",
        "UPDATE capstan_body SET body = (SELECT body FROM capstan_body WHERE number = 2) "
        "WHERE number = 1",
        "DELETE FROM capstan_body WHERE number = 1"}) {
    const Folder folder;
    fill(folder.file(), {sample(10.0), sample(20.0)});
    tamper(folder.file(), sql);
    Job job;
    auto base = CaseBase::open(folder.file(), job);
    ASSERT_TRUE(base.has_value()) << to_text(base.error());
    EXPECT_TRUE(evidence_near(*base, sample(10.0).asked)->empty());
    const auto faults = base->take_faults();
    ASSERT_EQ(faults.size(), 1u);
    EXPECT_EQ(faults[0].code, "CASE-ROW");
    EXPECT_THAT(faults[0].message, HasSubstr(sample(10.0).id.substr(0, 12)));
    EXPECT_EQ(base->cases(), std::vector<Case>{sample(20.0)});
    EXPECT_EQ(base->get(sample(10.0).id).error().code, "CASE-ROW");
    EXPECT_EQ(base->add(sample(30.0)).error().code, "CASE-DAMAGED");
  }
}

TEST(CaseStore, BelievesNoForgedRowBeyondTheLimits) {
  // Bytes, checksums and totals that fit, of a case that cannot be.
  const Folder folder;
  fill(folder.file(), {});
  Case wrong = sample();
  wrong.bound.vc_m_min = 12000.0;
  wrong.id = id_of(wrong);
  Job job;
  {
    auto store = open_sqlite(folder.file(), Missing::kRefuse, job).value();
    auto log = Log::open(std::move(store), job).value();
    ASSERT_TRUE(log.add(std::vector{wrong, sample()}).has_value());  // the log checks no limit when it writes
  }
  const auto base = CaseBase::open(folder.file(), job);
  EXPECT_EQ(base->cases(), std::vector<Case>{sample()});
  EXPECT_THAT(base->take_faults().at(0).message, HasSubstr("1/min"));
}

TEST(CaseStore, BelievesNoForgedHeadOfANumberThatNoQuestionHas) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  constexpr double kInfinite = std::numeric_limits<double>::infinity();
  const auto read_back = [](std::size_t dimension, double number) {
    const std::string categories = categories_of(sample().asked);
    Head head;
    head.categories = categories;
    head.key = key_of(sample().asked);
    head.key.raw.at(dimension) = number;
    head.key.known = static_cast<std::uint16_t>(head.key.known | (1U << dimension));
    return head_of(bytes_of(head, 1), 1).has_value();
  };
  constexpr std::size_t kTeeth = 6, kCoolant = 9;
  for (std::size_t i = 0; i < kDimensions; ++i) {
    EXPECT_TRUE(read_back(i, 1.0)) << i;
    for (const double number : {kNan, kInfinite, 0.0, -1.0, 1e300}) EXPECT_FALSE(read_back(i, number)) << i;
  }
  EXPECT_FALSE(read_back(kTeeth, 2.5));
  EXPECT_FALSE(read_back(kCoolant, 5.0));
}

TEST(CaseStore, TellsAnAlteredRowOnceHoweverOftenItIsAsked) {
  const Folder folder;
  fill(folder.file(), {sample(10.0), sample(10.2)});
  tamper(folder.file(), "DELETE FROM capstan_body WHERE number = 1");
  Job job;
  const auto base = CaseBase::open(folder.file(), job);
  for (int i = 0; i < 3; ++i) EXPECT_EQ(evidence_near(*base, sample(10.0).asked)->size(), 1u);
  EXPECT_EQ(base->take_faults().size(), 1u);
}

TEST(CaseStore, ReadsACaseOnceHoweverManyQuestionsFindIt) {
  const Folder folder;
  fill(folder.file(), {sample(10.0), sample(10.2)});
  Job job;
  auto base = CaseBase::open(folder.file(), job);
  EXPECT_EQ(evidence_near(*base, sample(10.0).asked)->size(), 2u);
  tamper(folder.file(), "DELETE FROM capstan_body");
  for (const double d_mm : {10.0, 10.1, 10.2})
    EXPECT_EQ(evidence_near(*base, sample(d_mm).asked)->size(), 2u);
  EXPECT_TRUE(base->take_faults().empty());
  // What is opened anew is read anew.
  const auto anew = CaseBase::open(folder.file(), job);
  EXPECT_TRUE(evidence_near(*anew, sample(10.0).asked)->empty());
}

/// A store of which bodies cannot be read for a while.
class Busy : public Store {
 public:
  Busy(std::unique_ptr<Store> real, const bool& busy) : real_(std::move(real)), busy_(busy) {}
  [[nodiscard]] std::string name() const override { return real_->name(); }
  [[nodiscard]] Result<std::string> read(std::int64_t after, const TakeHead& take) override {
    return real_->read(after, take);
  }
  [[nodiscard]] Status bodies(std::span<const std::int64_t> numbers, const TakeBody& take) override {
    if (busy_) return fail(Diagnostic{.code = "CASE-BUSY", .message = "another writer holds it"});
    return real_->bodies(numbers, take);
  }
  [[nodiscard]] Status append(std::int64_t after, const TakeHead& take, const Decide& decide) override {
    return real_->append(after, take, decide);
  }

 private:
  std::unique_ptr<Store> real_;
  const bool& busy_;
};

TEST(CaseStore, TakesCasesAgainWhenItCouldNotBeReadForAWhile) {
  const Folder folder;
  fill(folder.file(), {sample(10.0)});
  Job job;
  bool busy = true;
  auto real = open_sqlite(folder.file(), Missing::kRefuse, job).value();
  auto log = Log::open(std::make_unique<Busy>(std::move(real), busy), job).value();
  const std::vector<std::uint32_t> first = {0};
  EXPECT_FALSE(log.load(first).front());
  const std::vector<Diagnostic> faults = log.take_faults();
  ASSERT_EQ(faults.size(), 1u);
  EXPECT_EQ(faults.front().severity, Severity::kError);
  busy = false;
  EXPECT_TRUE(log.load(first).front());
  const std::vector<Case> more = {sample(20.0)};
  const Status added = log.add(more);
  EXPECT_TRUE(added.has_value()) << to_text(added.error());
}

TEST(CaseStore, NoticesThatRowsAreGone) {
  for (const std::string gone : {"1", "2"}) {
    const Folder folder;
    fill(folder.file(), {sample(10.0), sample(20.0)});
    tamper(folder.file(), "DELETE FROM capstan_head WHERE number = " + gone);
    Job job;
    auto base = CaseBase::open(folder.file(), job);
    ASSERT_TRUE(base.has_value());
    EXPECT_NE(job.count(Severity::kWarning), 0u);
    EXPECT_FALSE(base->whole());
    EXPECT_EQ(base->cases().size(), 1u);  // the one behind a gap was sealed with its number
    EXPECT_EQ(base->add(sample(30.0)).error().code, "CASE-DAMAGED");
  }
}

TEST(CaseStore, NoticesThatAnOlderStateCameBack) {
  const Folder folder;
  fill(folder.file(), {sample(10.0)});
  tamper(folder.file(), "CREATE TABLE kept AS SELECT totals FROM capstan_total");
  tamper(folder.file(), "ALTER TABLE kept RENAME TO kept2; DROP TABLE kept2");
  const std::string before = bytes_of_file(folder.file());
  fill(folder.file(), {sample(20.0)});
  Job job;
  auto open = CaseBase::open(folder.file(), job).value();
  write_file(folder.file(), before);  // behind the back of one who has it open
  EXPECT_EQ(open.add(sample(30.0)).error().code, "CASE-DAMAGED");
}

enum class Outcome { kRefused, kLeftOut, kWhole };

/// Never a crash, never an altered row; and where anything is missing, something is said.
Outcome expect_honest(const std::string& path, const std::map<std::string, Case>& originals,
                      const std::string& how) {
  Job job;
  const auto base = CaseBase::open(path, job);
  if (!base) return Outcome::kRefused;
  const std::vector<Case> given = base->cases();
  for (const Case& c : given) {
    const auto original = originals.find(c.id);
    if (original == originals.end()) {
      ADD_FAILURE() << how;
    } else {
      EXPECT_EQ(c, original->second) << how;
    }
  }
  const bool told = job.count(Severity::kWarning) != 0 || !base->take_faults().empty();
  EXPECT_TRUE(given.size() == originals.size() || told) << how;
  return given.size() == originals.size() ? Outcome::kWhole : Outcome::kLeftOut;
}

class DamagedStore : public testing::Test {
 protected:
  void SetUp() override {
    const std::vector<Case> cases = random_cases(60, 21);
    fill(folder_.file(), cases);
    for (const Case& c : cases) originals_[c.id] = c;
    bytes_ = bytes_of_file(folder_.file());
    ASSERT_GT(bytes_.size(), 8192u);
  }
  Folder folder_;
  std::map<std::string, Case> originals_;
  std::string bytes_;
};

TEST_F(DamagedStore, NeverGivesAnAlteredRowForAFlippedBit) {
  std::mt19937 random(7);
  std::map<Outcome, int> count;
  for (int i = 0; i < 2000 && !HasFailure(); ++i) {
    // The first pages, where structure is, as often as all the rest.
    const std::size_t reach = i % 2 == 0 ? 4096 : bytes_.size();
    const std::size_t at = random() % reach;
    const int bit = static_cast<int>(random() % 8);
    std::string broken = bytes_;
    broken[at] = static_cast<char>(broken[at] ^ (1 << bit));
    const std::string path = folder_.file("broken.db");
    write_file(path, broken);
    ++count[expect_honest(path, originals_, "bit " + std::to_string(bit) + " of byte " + std::to_string(at))];
    std::filesystem::remove(path + "-wal");  // a flipped header may ask for one
    std::filesystem::remove(path + "-shm");
  }
  // Slack between the rows is most of a page, so many flips touch nothing.
  EXPECT_GT(count[Outcome::kRefused], 20);
  EXPECT_GT(count[Outcome::kLeftOut], 200);
  RecordProperty("refused", count[Outcome::kRefused]);
  RecordProperty("left_out", count[Outcome::kLeftOut]);
  RecordProperty("whole", count[Outcome::kWhole]);
}

/// The ids of the cases that a file still gives.
std::set<std::string> given_by(const std::string& path) {
  Job job;
  std::set<std::string> out;
  const auto base = CaseBase::open(path, job);
  if (!base) return out;
  for (const Case& c : base->cases()) out.insert(c.id);
  return out;
}

TEST_F(DamagedStore, TakesACaseOrRefusesItAfterAFlippedBitButLosesNone) {
  std::mt19937 random(9);
  const Case more = sample(99.0);
  std::map<std::string, Case> with = originals_;
  with[more.id] = more;
  int taken = 0;
  for (int i = 0; i < 400 && !HasFailure(); ++i) {
    const std::size_t at = random() % (i % 2 == 0 ? 200 : bytes_.size());
    std::string broken = bytes_;
    broken[at] = static_cast<char>(broken[at] ^ (1 << (random() % 8)));
    const std::string path = folder_.file("broken.db");
    write_file(path, broken);
    const std::set<std::string> before = given_by(path);
    {
      Job job;
      auto base = CaseBase::open(path, job);
      if (!base || !base->add(more)) continue;
      ++taken;
    }
    // What was readable before is, and so is what was added; all of it unaltered.
    expect_honest(path, with, "byte " + std::to_string(at));
    const std::set<std::string> after = given_by(path);
    EXPECT_TRUE(after.contains(more.id)) << at;
    EXPECT_TRUE(std::includes(after.begin(), after.end(), before.begin(), before.end())) << at;
    std::filesystem::remove(path + "-wal");
    std::filesystem::remove(path + "-shm");
  }
  EXPECT_GT(taken, 100);  // slack between the rows is most of a page
}

TEST_F(DamagedStore, NeverGivesAnAlteredRowForManyFlippedBytesOrATruncation) {
  std::mt19937 random(8);
  for (int i = 0; i < 200 && !HasFailure(); ++i) {
    std::string broken = bytes_;
    for (int n = 0; n < 20; ++n) broken[random() % broken.size()] = static_cast<char>(random());
    if (i % 2 == 0) broken = bytes_.substr(0, random() % bytes_.size());
    const std::string path = folder_.file("broken.db");
    write_file(path, broken);
    expect_honest(path, originals_, "round " + std::to_string(i));
    std::filesystem::remove(path + "-wal");
    std::filesystem::remove(path + "-shm");
  }
}

TEST(CaseStore, IsReadWhereItMayNotBeWritten) {
  const Folder folder;
  fill(folder.file(), {sample()});
  chmod(folder.file().c_str(), 0444);
  chmod(folder.path().c_str(), 0555);
  const bool root = geteuid() == 0;
  ASSERT_EQ(seteuid(root ? 65534 : geteuid()), 0);  // root writes everywhere
  Job job;
  auto base = CaseBase::open(folder.file(), job);
  std::string added = "opened";
  if (base) {
    const Status status = base->add(sample(11.0));
    added = status ? "added" : status.error().code;
  }
  const auto made = CaseBase::open_or_create(folder.file("new.db"), job);
  ASSERT_EQ(seteuid(root ? 0 : geteuid()), 0);
  ASSERT_TRUE(base.has_value()) << to_text(base.error());
  EXPECT_EQ(base->nearest(sample().asked, 1)->size(), 1u);
  EXPECT_EQ(added, "CASE-READ-ONLY");
  ASSERT_FALSE(made.has_value());
  EXPECT_EQ(made.error().code, "CASE-OPEN");
}

TEST(CaseStore, SaysWhenAnotherWriterHoldsIt) {
  const Folder folder;
  fill(folder.file(), {sample()});
  Job job;
  auto log = Log::open(open_sqlite(folder.file(), Missing::kRefuse, job, 30).value(), job).value();
  sqlite3* other = nullptr;
  ASSERT_EQ(sqlite3_open(folder.file().c_str(), &other), SQLITE_OK);
  ASSERT_EQ(sqlite3_exec(other, "BEGIN IMMEDIATE", nullptr, nullptr, nullptr), SQLITE_OK);
  const std::vector<Case> more = {sample(11.0)};
  EXPECT_EQ(log.add(more).error().code, "CASE-BUSY");
  ASSERT_EQ(sqlite3_exec(other, "ROLLBACK", nullptr, nullptr, nullptr), SQLITE_OK);
  EXPECT_TRUE(log.add(more).has_value());
  sqlite3_close(other);
}

TEST(CaseStore, LosesNothingWhenNoSpaceIsLeft) {
  const Folder folder;
  fill(folder.file(), {sample()});
  Job job;
  auto base = CaseBase::open(folder.file(), job).value();
  rlimit before{};
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &before), 0);
  rlimit small = before;
  small.rlim_cur = std::filesystem::file_size(folder.file());
  const auto handler = signal(SIGXFSZ, SIG_IGN);
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &small), 0);
  const Status added = base.add(random_cases(2000, 41));
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &before), 0);
  signal(SIGXFSZ, handler);
  ASSERT_FALSE(added.has_value());
  EXPECT_EQ(added.error().code, "CASE-STORE") << to_text(added.error());
  EXPECT_EQ(base.cases(), std::vector<Case>{sample()});
  EXPECT_TRUE(base.add(sample(11.0)).has_value());
  EXPECT_EQ(CaseBase::open(folder.file(), job)->size(), 2u);
  EXPECT_EQ(job.count(Severity::kWarning), 0u);
}

}  // namespace
}  // namespace capstan::casebase
