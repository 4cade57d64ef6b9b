#pragma once

#include <algorithm>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "casebase/intake.h"
#include "tests/casebase/sample.h"
#include "tests/casebase/store/failing_disk.h"
#include "tests/casebase/store/old_files.h"

namespace capstan::casebase {

/// A way in which a batch of cases comes into a base, from the file that it finds on: what a fault of disk or
/// memory may hit.
struct Writing {
  std::string name;
  std::function<std::string(const Folder&)> make;  ///< the base's file; none where there is none yet
  /// Opens it; what adds.
  using Add = std::function<Status(std::span<const Case>)>;
  std::function<Result<Add>(const std::string& path)> open;
};
inline std::ostream& operator<<(std::ostream& to, const Writing& w) { return to << w.name; }

inline Result<Writing::Add> opened_base(const std::string& path) {
  Job job;
  Result<CaseBase> base = CaseBase::open_or_create(path, job);
  if (!base) return fail(base.error());
  auto shared = std::make_shared<CaseBase>(*std::move(base));
  return Writing::Add([shared](std::span<const Case> cases) { return shared->add(cases); });
}

/// As `capstan cases add` does: where the base has to be read, it is.
inline Result<Writing::Add> opened_intake(const std::string& path) {
  Job job;
  Result<Intake> intake = Intake::open_or_create(path, job);
  if (!intake) return fail(intake.error());
  auto shared = std::make_shared<Intake>(*std::move(intake));
  return Writing::Add([shared, path](std::span<const Case> cases) -> Status {
    const auto added = shared->add(cases);
    if (!added) return fail(added.error());
    return *added ? Status() : fail("CASE-DAMAGED", "it was to be read");
  });
}

/// Where a sample begins that takes each `step`-th: seeds that follow each other begin at each of them in
/// turn.
inline int first_of(int step) { return 1 + testing::UnitTest::GetInstance()->random_seed() % step; }

inline std::vector<Writing> writings() {
  const auto sixty = [](const Folder& folder) {
    fill(folder.file("old.db"), random_cases(60, 3));
    return folder.file("old.db");
  };
  return {{"Read", sixty, opened_base},
          {"Unread", sixty, opened_intake},
          {"New", [](const Folder& folder) { return folder.file("old.db"); }, opened_base},
          {"Version1", [](const Folder& folder) { return file_of_version_1(folder); }, opened_base},
          {"Version2", [](const Folder& folder) { return file_of_version_2(folder, random_cases(60, 3)); },
           opened_base}};
}

/// A base, whole, and a batch that is added to it again and again from the same state.
class WrittenAnew : public testing::TestWithParam<Writing> {
 protected:
  void SetUp() override {
    path_ = GetParam().make(folder_);
    there_ = std::filesystem::exists(path_);
    bytes_ = bytes_of_file(path_);
    batch_ = random_cases(12, 77);
    for (Case& c : batch_) c.observed.verdict = Verdict::kUnknown;  // else the base has to be read
    if (there_) before_ = given("before").value();
    all_ = before_;
    all_.insert(all_.end(), batch_.begin(), batch_.end());
    const auto by_id = [](const Case& a, const Case& b) { return a.id < b.id; };
    std::sort(all_.begin(), all_.end(), by_id);
  }
  /// Puts the base back as it was before.
  void again() const {
    std::filesystem::remove(path_);
    std::filesystem::remove(path_ + "-journal");
    if (there_) write_file(path_, bytes_);
  }
  /// What the base has; nothing: it cannot be opened. Needs a base that is whole.
  std::optional<std::vector<Case>> given(const std::string& how) const {
    Job job;
    const auto base = CaseBase::open(path_, job);
    if (!base) {
      EXPECT_FALSE(there_) << how << ": " << to_text(base.error());
      // Its maker ended before it had a table.
      EXPECT_THAT(base.error().code, testing::AnyOf("CASE-OPEN", "CASE-SCHEMA")) << how;
      return std::nullopt;
    }
    std::vector<Case> out = base->cases();
    EXPECT_TRUE(base->whole()) << how;
    EXPECT_EQ(job.count(Severity::kWarning), 0u) << how << ": " << to_text(job.diagnostics().front());
    EXPECT_TRUE(base->take_faults().empty()) << how;
    return out;
  }
  /// What was there is, and the batch whole or not at all, whole where it was acknowledged; what adds it
  /// again does so once.
  void expect_all_or_none(bool acknowledged, const std::string& how) const {
    const std::vector<Case> now = given(how).value_or(std::vector<Case>{});
    EXPECT_TRUE(now == all_ || (now == before_ && !acknowledged))
        << how << ": " << now.size() << " of " << before_.size() << " + " << batch_.size()
        << (acknowledged ? " that were acknowledged" : "");
    const auto base = opened_base(path_);
    ASSERT_TRUE(base.has_value()) << how << ": " << to_text(base.error());
    const Status added = (*base)(batch_);
    ASSERT_TRUE(added.has_value()) << how << ": " << to_text(added.error());
    EXPECT_EQ(given(how), all_) << how;
  }
  /// One error that names file and cause, and accuses nobody of damage.
  void expect_clear(const Diagnostic& d, const std::string& how) const {
    EXPECT_THAT(d.code, testing::AnyOf("CASE-STORE", "CASE-OPEN")) << how << ": " << to_text(d);
    EXPECT_EQ(d.file, path_) << how;
    EXPECT_THAT(d.message, testing::Not(testing::HasSubstr("not an error"))) << how;
  }

  Folder folder_;
  FailingDisk disk_;
  std::string path_, bytes_;
  bool there_ = false;
  std::vector<Case> before_, batch_, all_;
};

}  // namespace capstan::casebase
