#include <sys/wait.h>

#include <map>

#include "tests/casebase/store/failing_disk.h"
#include "tests/casebase/store/writing_cases.h"
#include "tests/support/soak.h"

// The n-th operation of one add and of one migration: each write, synchronisation, truncation, deletion and
// opening of a file (hostile_input.md, store faults). All n where a fault is only told; of those that end a
// program, which takes a process each, every fifth, and every second where CAPSTAN_SOAK is set, from another
// one with each seed.

namespace capstan::casebase {
namespace {

using testing::HasSubstr;

class DiskFaultProperty : public WrittenAnew {
 protected:
  const int step_ = rounds(5, 2);
  /// At the n-th operation, in this program: what fails says so, and the same base goes on when the disk is
  /// mended. Whether the fault came.
  bool fails(DiskFault fault, int n) {
    const std::string how = std::to_string(n);
    again();
    disk_.plan(fault, n);
    auto add = GetParam().open(path_);
    if (!add) expect_clear(add.error(), how);
    const Status added = add ? (*add)(batch_) : Status();
    if (!added) expect_clear(added.error(), how);
    bool acknowledged = add && added;
    const bool came = disk_.count() >= n;
    disk_.mend();
    if (add && !added) {
      const Status after = (*add)(batch_);
      EXPECT_TRUE(after.has_value()) << how << ": " << to_text(after.error());
      acknowledged = true;
    }
    EXPECT_TRUE(came || acknowledged);
    expect_all_or_none(acknowledged, how);
    return came;
  }
  /// At the n-th operation, in a program of its own, which ends by it. Whether it did.
  bool ends(DiskFault fault, int n, bool& acknowledged) {
    again();
    const std::string told = folder_.file("told");
    std::filesystem::remove(told);
    const pid_t program = fork();
    if (program == 0) {
      disk_.plan(fault, n);
      const auto add = GetParam().open(path_);
      const bool added = add && (*add)(batch_);
      write_file(told, added ? "added" : "refused");
      if (fault == DiskFault::kNoPower || fault == DiskFault::kSomePower) disk_.stop();
      _exit(0);
    }
    int status = 0;
    waitpid(program, &status, 0);
    EXPECT_TRUE(WIFEXITED(status) && (WEXITSTATUS(status) == 0 || WEXITSTATUS(status) == FailingDisk::kDied));
    const std::string said = bytes_of_file(told);
    EXPECT_NE(said, "refused") << n;
    acknowledged = said == "added";
    return said.empty();
  }
};

TEST_P(DiskFaultProperty, TellsWhatFailsAtAnyOperationAndLosesNothing) {
  for (const DiskFault fault : {DiskFault::kFails, DiskFault::kFailsOn}) {
    int n = 1;
    while (fails(fault, n) && !HasFailure()) ++n;
    EXPECT_GT(n, 8) << "openings, writes, synchronisations and a deletion at least";
    RecordProperty(fault == DiskFault::kFails ? "once" : "on", n - 1);
  }
}

TEST_P(DiskFaultProperty, IsWholeAfterTheProgramOrThePowerWentAtAnyOperation) {
  for (const DiskFault fault :
       {DiskFault::kDies, DiskFault::kDiesHalfway, DiskFault::kNoPower, DiskFault::kSomePower}) {
    bool acknowledged = false;
    for (int n = first_of(step_); !acknowledged && !HasFailure(); n += step_) {
      const bool ended = ends(fault, n, acknowledged);
      EXPECT_TRUE(ended || acknowledged);
      expect_all_or_none(acknowledged,
                         "fault " + std::to_string(static_cast<int>(fault)) + " at " + std::to_string(n));
    }
  }
}

TEST_P(DiskFaultProperty, BelievesNothingAlteredWhereTheJournalOfAProgramThatEndedIsTornOrGone) {
  std::map<std::string, Case> originals;
  for (const Case& c : all_) originals[c.id] = c;
  std::map<std::string, int> outcomes;
  const std::string journal = path_ + "-journal";
  const std::vector<std::function<std::string(const std::string&)>> spoilt = {
      [](const std::string&) { return std::string(); },
      [](const std::string& j) { return j.substr(0, 20); },
      [](const std::string& j) { return j.substr(0, j.size() / 4); },
      [](const std::string& j) { return j.substr(0, j.size() / 2); },
      [](const std::string& j) { return j.substr(0, j.size() - 1); },
      [](const std::string& j) {
        return std::string(28, '\0') + j.substr(std::min<std::size_t>(28, j.size()));
      }};
  bool acknowledged = false;
  for (int n = first_of(step_); !acknowledged && !HasFailure(); n += step_) {
    (void)ends(DiskFault::kDiesHalfway, n, acknowledged);
    if (!std::filesystem::exists(journal) || std::filesystem::file_size(journal) == 0) continue;
    const std::string file = bytes_of_file(path_), kept = bytes_of_file(journal);
    for (std::size_t i = 0; i <= spoilt.size() && !HasFailure(); ++i) {
      const std::string how = std::to_string(n) + ", journal " + std::to_string(i);
      write_file(path_, file);
      if (i < spoilt.size()) write_file(journal, spoilt[i](kept));
      if (i == spoilt.size()) std::filesystem::remove(journal);
      Job job;
      auto base = CaseBase::open(path_, job);
      if (!base) {
        ++outcomes[base.error().code];
        EXPECT_THAT(base.error().code, testing::AnyOf("CASE-DAMAGED", "CASE-SCHEMA")) << how;
        continue;
      }
      const std::vector<Case> given = base->cases();
      for (const Case& c : given) EXPECT_TRUE(originals.contains(c.id) && originals[c.id] == c) << how;
      const bool told = job.count(Severity::kWarning) != 0 || !base->take_faults().empty();
      EXPECT_TRUE(told || given == before_ || given == all_) << how;
      ++outcomes[told ? "told" : given == all_ ? "all" : "none"];
      // What is added now is there, with all that was given, or is refused.
      if (!base->add(sample(99.0))) continue;
      Job again;
      const auto next = CaseBase::open(path_, again);
      ASSERT_TRUE(next.has_value()) << how;
      EXPECT_EQ(next->cases().size(), given.size() + 1) << how;
    }
  }
  EXPECT_FALSE(outcomes.empty()) << "no program that ended left a journal";
  for (const auto& [outcome, times] : outcomes) RecordProperty(outcome, times);
}

INSTANTIATE_TEST_SUITE_P(All, DiskFaultProperty, testing::ValuesIn(writings()),
                         [](const auto& writing) { return writing.param.name; });

/// A fault of reading passes: nothing is taken for altered or gone for it.
TEST(DiskFaultOfReading, LeavesABaseWholeWhereItPassed) {
  const Folder folder;
  const std::vector<Case> cases = random_cases(40, 5);
  fill(folder.file(), cases);
  Job job;
  const Metric learned = CaseBase::open(folder.file(), job)->learn_metric().value();
  std::map<std::string, int> outcomes;
  bool came = true;
  for (int n = 1; came && !HasFailure(); ++n) {
    FailingDisk disk(true);
    disk.plan(DiskFault::kFails, n);
    Job quiet;
    auto base = CaseBase::open(folder.file(), quiet);
    if (!base) {
      ++outcomes["refused"];
      EXPECT_THAT(base.error().code, testing::AnyOf("CASE-OPEN", "CASE-STORE")) << n;
      EXPECT_THAT(base.error().message, HasSubstr("I/O")) << n;
      continue;
    }
    EXPECT_EQ(base->metric(), learned) << n;
    const std::size_t some = base->cases().size();
    const std::vector<Diagnostic> faults = base->take_faults();
    EXPECT_TRUE(some == cases.size() || faults.size() == 1) << n;
    for (const Diagnostic& d : faults) EXPECT_EQ(d.code, "CASE-STORE") << n << ": " << to_text(d);
    if (some != cases.size()) ++outcomes["read in part"];
    came = disk.count() >= n;
    disk.mend();
    EXPECT_TRUE(base->whole()) << n;
    EXPECT_EQ(base->cases().size(), cases.size()) << n;
    const Status judged = base->judge(std::vector{cases[0].id}, n % 2 == 0 ? Verdict::kBad : Verdict::kGood,
                                      {"A. Smith", "", "round " + std::to_string(n)});
    EXPECT_TRUE(judged.has_value()) << n << ": " << to_text(judged.error());
  }
  EXPECT_GT(outcomes["refused"], 3);
  EXPECT_GT(outcomes["read in part"], 0);
}

}  // namespace
}  // namespace capstan::casebase
