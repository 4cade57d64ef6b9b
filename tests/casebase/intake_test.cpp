#include "casebase/intake.h"

#include <fstream>
#include <iterator>
#include <map>
#include <set>

#include "tests/casebase/sample.h"

namespace capstan::casebase {
namespace {

/// What becomes of a case that is given to an intake.
enum class Outcome { kAdded, kToBeRead, kRefused };

Outcome take_in(const std::string& path, const Case& c) {
  Job job;
  auto intake = Intake::open_or_create(path, job);
  if (!intake) return Outcome::kRefused;
  const auto added = intake->add(std::span(&c, 1));
  if (!added) return Outcome::kRefused;
  return *added ? Outcome::kAdded : Outcome::kToBeRead;
}

TEST(Intake, LeavesABaseAloneThatGetsNoCase) {
  const Folder folder;
  fill(folder.file(), {sample(10.0)});
  Job job;
  auto intake = Intake::open_or_create(folder.file(), job).value();
  const auto added = intake.add({});
  ASSERT_TRUE(added.has_value());
  EXPECT_FALSE(added->has_value());
  EXPECT_EQ(intake.read(job)->size(), 1u);
}

TEST(Intake, BelievesNoIndexThatNamesAnotherRow) {
  // A row of another case, the last row, one that is not there.
  for (const std::string row : {"2", "3", "7"}) {
    const Folder folder;
    fill(folder.file(), {sample(10.0), sample(20.0), sample(30.0)});
    tamper(folder.file(), "UPDATE capstan_id SET number = " + row + " WHERE number = 1");
    Case silent = sample(10.0);
    silent.observed.verdict = Verdict::kUnknown;
    EXPECT_EQ(take_in(folder.file(), silent), Outcome::kToBeRead) << row;
    Job job;
    EXPECT_EQ(CaseBase::open(folder.file(), job)->size(), 3u);
  }
}

TEST(Intake, StoresACaseAgainThatTheIndexLostAndItIsReadOnce) {
  const Folder folder;
  fill(folder.file(), {sample(10.0), sample(20.0)});
  tamper(folder.file(), "DELETE FROM capstan_id WHERE number = 1");
  Case other = sample(10.0);
  other.observed.verdict = Verdict::kBad;
  ASSERT_EQ(other.id, sample(10.0).id);
  EXPECT_EQ(take_in(folder.file(), other), Outcome::kAdded);
  Job job;
  auto base = CaseBase::open(folder.file(), job).value();
  EXPECT_EQ(base.cases().size(), 2u);
  EXPECT_EQ(base.get(other.id).value(), sample(10.0));  // as the first says
  EXPECT_EQ(base.nearest(sample(10.0).asked, 10)->size(), 2u);
  EXPECT_EQ(job.count(Severity::kWarning), 0u);
  // Who reads it states the number anew.
  ASSERT_TRUE(base.add(sample(30.0)).has_value());
  auto intake = Intake::open_or_create(folder.file(), job).value();
  EXPECT_EQ(intake.add(std::vector{sample(40.0)}).value()->held, 4u);
}

TEST(Intake, LeavesToOneWhoReadsWhereTotalsOrTheLastRowAreNotWhatWasStored) {
  for (const std::string sql : {
           "UPDATE capstan_total SET totals = x'00'",
           "DELETE FROM capstan_total",
           "DELETE FROM capstan_head WHERE number = 3",
           "DELETE FROM capstan_body WHERE number = 3",
           "UPDATE capstan_head SET head = x'00' WHERE number = 3",
           "UPDATE capstan_body SET body = x'00' WHERE number = 3",
           "INSERT INTO capstan_head SELECT 4, head FROM capstan_head WHERE number = 3",
           "CREATE TRIGGER t AFTER INSERT ON capstan_head BEGIN DELETE FROM capstan_head; END",
       }) {
    const Folder folder;
    fill(folder.file(), {sample(10.0), sample(20.0), sample(30.0)});
    tamper(folder.file(), sql);
    EXPECT_EQ(take_in(folder.file(), sample(40.0)), Outcome::kToBeRead) << sql;
  }
}

TEST(Intake, HidesNoDamageThatItDidNotRead) {
  const Folder folder;
  fill(folder.file(), {sample(10.0), sample(20.0), sample(30.0)});
  tamper(folder.file(), "DELETE FROM capstan_head WHERE number = 2");
  EXPECT_EQ(take_in(folder.file(), sample(40.0)), Outcome::kAdded);
  Job job;
  auto base = CaseBase::open(folder.file(), job).value();
  EXPECT_NE(job.count(Severity::kWarning), 0u);
  std::set<std::string> there;
  for (const Case& c : base.cases()) there.insert(c.id);
  EXPECT_TRUE(there.contains(sample(40.0).id));
  EXPECT_EQ(base.add(sample(50.0)).error().code, "CASE-DAMAGED");
}

TEST(Intake, LosesAndAltersNothingAfterAFlippedBit) {
  // Two pages of ids at least, so that their tree has a branch.
  const Folder folder;
  std::map<std::string, Case> originals;
  const std::vector<Case> cases = random_cases(400, 21);
  fill(folder.file(), cases);
  for (const Case& c : cases) originals[c.id] = c;
  std::ifstream in(folder.file(), std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(in), {}};
  // Pages of the tree of ids: leaves and branches of index trees begin with these bytes (SQLite's file
  // format).
  constexpr std::size_t kPage = 4096;
  std::vector<std::size_t> of_ids;
  for (std::size_t at = 0; at < bytes.size(); at += kPage)
    if (bytes[at] == 0x0a || bytes[at] == 0x02) of_ids.push_back(at);
  ASSERT_GE(of_ids.size(), 3u);
  const Case more = sample(99.0);
  std::mt19937 random(9);
  std::map<Outcome, int> outcomes;
  for (int i = 0; i < 200 && !testing::Test::HasFailure(); ++i) {
    const std::size_t page = of_ids[random() % of_ids.size()];
    const std::size_t at =
        i % 3 == 0 ? random() % bytes.size() : page + random() % (i % 3 == 1 ? 100 : kPage);
    std::string broken = bytes;
    broken[at] = static_cast<char>(broken[at] ^ (1 << (random() % 8)));
    const std::string path = folder.file("broken.db");
    std::ofstream(path, std::ios::binary) << broken;
    const auto given = [&] {
      Job job;
      std::map<std::string, Case> out;
      const auto base = CaseBase::open(path, job);
      if (!base) return out;
      for (const Case& c : base->cases()) EXPECT_TRUE(out.emplace(c.id, c).second) << "twice, byte " << at;
      return out;
    };
    const std::map<std::string, Case> before = given();
    const Outcome outcome = take_in(path, more);
    ++outcomes[outcome];
    std::map<std::string, Case> after = given();
    // Where a page of heads is broken nobody can open it, before and after.
    const bool there = after.erase(more.id) == 1;
    EXPECT_EQ(there, outcome == Outcome::kAdded && !before.empty()) << "byte " << at;
    EXPECT_EQ(after, before) << "byte " << at;
    for (const auto& [id, c] : after) EXPECT_EQ(c, originals.at(id)) << "byte " << at;
    std::filesystem::remove(path + "-wal");
    std::filesystem::remove(path + "-shm");
  }
  EXPECT_GT(outcomes[Outcome::kAdded], 30);  // most of the flips lie elsewhere
  EXPECT_GT(outcomes[Outcome::kToBeRead] + outcomes[Outcome::kRefused], 5);
}

}  // namespace
}  // namespace capstan::casebase
