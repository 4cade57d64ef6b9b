#include <gtest/gtest.h>

#include <atomic>
#include <filesystem>
#include <functional>
#include <set>
#include <string>
#include <vector>

#include "planner/door/late/late.h"
#include "planner/door/service/check.h"
#include "planner/door/service/ending/last_line.h"
#include "planner/door/service/options.h"
#include "planner/door/service/planning.h"
#include "planner/proof/verify/verify.h"
#include "tests/support/corpus.h"

// Work that is stopped when it asks for the k-th time whether it is to: at every k it ends as stopped work,
// and leaves nothing.

namespace capstan::service {
namespace {

const std::string kSource = capstan::testing::source_dir();

enum class By { kStop, kDeadline };

/// A job whose k-th question (from 1 on; 0: none) is the first to be answered with yes, and that counts them.
/// Jobs made from it ask its clock. How often work asks may differ by a few from run to run: `tick` counts
/// on.
class Counted {
 public:
  Counted(std::size_t k, By by) {
    job.set_deadline(kEnd);
    job.set_clock([this, k, by] {
      const std::size_t n = ++asked_;
      if (by == By::kStop && n == k) job.request_stop();
      const bool end = k != 0 && (by == By::kStop ? n == k : n >= k);
      return end ? kEnd : kBegin;
    });
  }
  [[nodiscard]] std::size_t asked() const { return asked_; }
  Job job;

 private:
  static constexpr std::chrono::steady_clock::time_point kBegin{std::chrono::hours(1)},
      kEnd{std::chrono::hours(2)};
  std::atomic<std::size_t> asked_{0};
};

/// Of 1 to n: the first and last few, and some between, each a little farther.
std::vector<std::size_t> places(std::size_t n, std::size_t between) {
  std::set<std::size_t> out;
  for (std::size_t k = 1; k <= 4 && k <= n; ++k) out.insert({k, n + 1 - k});
  for (std::size_t i = 1; i < between; ++i) out.insert(std::max<std::size_t>(1, n * i / between));
  return {out.begin(), out.end()};
}

bool says_stopped(const Diagnostic& d) { return d.code.ends_with("-STOPPED"); }

Request request_for_pocket() {
  Request r;
  EXPECT_TRUE(set(r, "tools", kSource + "/examples/reference_pocket_tools.yaml"));
  EXPECT_TRUE(set(r, "machine", kSource + "/examples/reference_pocket_machine.yaml"));
  // With --allow-findings a condemned program is written all the same; one that was not checked is not.
  r.allow_findings = true;
  return r;
}
const std::string kPocket = kSource + "/examples/reference_pocket.p21";

/// All that the command does: plan, make the files, check them, write them. Gives the fault, or nothing.
std::optional<Diagnostic> plan_and_write(const std::string& folder, Job& job) {
  const Request request = request_for_pocket();
  const auto planned = plan(request, {kPocket}, job);
  if (!planned) {
    EXPECT_EQ(planned.error().code, Code::kImpossible);
    return planned.error().what;
  }
  auto outputs = outputs_of(
      {folder + "/p.json", folder + "/p.p21", folder + "/p.stpnc", folder + "/p.ngc", folder + "/p.tbl"});
  if (const auto ok = make(planned->plan, *outputs, job); !ok) return ok.error();
  if (const auto verdict = judge(request, *planned, *outputs, job); !verdict) return verdict.error();
  if (const auto ok = write_all(*outputs, job); !ok) return ok.error();
  return std::nullopt;
}

std::size_t files_in(const std::string& folder) {
  return static_cast<std::size_t>(
      std::distance(std::filesystem::directory_iterator(folder), std::filesystem::directory_iterator()));
}

class StoppedWork : public ::testing::TestWithParam<By> {};
INSTANTIATE_TEST_SUITE_P(Properties, StoppedWork, ::testing::Values(By::kStop, By::kDeadline),
                         [](const auto& i) {
                           return std::string(i.param == By::kStop ? "ByAStop" : "ByADeadline");
                         });

TEST_P(StoppedWork, APlanIsAnErrorAndLeavesNoFileWhereverItIsStopped) {
  Counted whole(0, GetParam());
  {
    const testing::ScratchFolder folder;
    const auto fault = plan_and_write(folder.path(), whole.job);
    ASSERT_FALSE(fault) << to_text(*fault);
    EXPECT_EQ(files_in(folder.path()), 5U);
  }
  ASSERT_GT(whole.asked(), 1000U) << "it asks often";
  std::size_t ended = 0;
  for (const std::size_t k : places(whole.asked(), 24)) {
    SCOPED_TRACE("question " + std::to_string(k) + " of " + std::to_string(whole.asked()));
    const testing::ScratchFolder folder;  // one that ended before it was stopped leaves its files
    Counted stopped(k, GetParam());
    const auto fault = plan_and_write(folder.path(), stopped.job);
    if (stopped.asked() < k) continue;  // it ended before
    ++ended;
    ASSERT_TRUE(fault);
    EXPECT_TRUE(says_stopped(*fault)) << to_text(*fault);
    ASSERT_EQ(files_in(folder.path()), 0U);
    EXPECT_LE(stopped.asked(), k + 16) << "and it ends at once";
  }
  EXPECT_GE(ended, 24U);
}

TEST_P(StoppedWork, ACheckIsNeverPassedWhereverItIsStopped) {
  const Request request = request_for_pocket();
  Job job;
  const auto planned = plan(request, {kPocket}, job);
  ASSERT_TRUE(planned);
  auto outputs = outputs_of({"p.json", "p.ngc", "p.tbl"});
  ASSERT_TRUE(make(planned->plan, *outputs, job));
  const auto checked = [&](Job& by) {
    std::vector<Source> sources;
    for (const Output& o : *outputs) sources.push_back({o.path, o.bytes});
    return check(request, std::move(sources), {}, by);
  };
  Counted whole(0, GetParam());
  ASSERT_TRUE(checked(whole.job));
  ASSERT_GT(whole.asked(), 100U) << "it asks often";
  std::size_t ended = 0;
  for (const std::size_t k : places(whole.asked(), 24)) {
    SCOPED_TRACE("question " + std::to_string(k) + " of " + std::to_string(whole.asked()));
    Counted stopped(k, GetParam());
    const auto result = checked(stopped.job);
    if (stopped.asked() < k) continue;  // it ended before
    ++ended;
    if (!result) {  // nothing was checked yet
      EXPECT_TRUE(says_stopped(result.error().what)) << to_text(result.error().what);
      continue;
    }
    EXPECT_FALSE(result->clean());
    EXPECT_TRUE(std::any_of(result->findings.begin(), result->findings.end(), [](const FileFinding& f) {
      return f.finding.code == verify::kStopped && f.finding.severity == Severity::kError;
    }));
    Ending end{.verb = Verb::kCheck};
    take_check(*result, end);
    EXPECT_FALSE(last_line(end).starts_with("Safe")) << last_line(end);
  }
  EXPECT_GE(ended, 24U);
}

TEST(StoppedBind, GivesTheCheckedFallbackOrAnError) {
  Request request;
  ASSERT_TRUE(set(request, "machine", "generic_vmc"));
  ASSERT_TRUE(set(request, "tools", kSource + "/tests/door/late/magazine.tbl"));
  const auto bytes = [&](Job& job) -> Result<std::string> {
    const auto bound = bind(request, {kSource + "/examples/plate_bound.p21"}, job.now(), job);
    if (!bound) return tl::unexpected(bound.error().what);
    Job writing;
    auto outputs = outputs_of({"p.ngc"});
    EXPECT_TRUE(make(bound->plan, *outputs, writing));
    return outputs->front().bytes;
  };
  Counted whole(0, By::kStop);
  const auto best = bytes(whole.job);
  ASSERT_TRUE(best) << to_text(best.error());
  std::set<std::string> given;
  std::size_t errors = 0;
  for (const std::size_t k : places(whole.asked(), 24)) {
    SCOPED_TRACE("question " + std::to_string(k) + " of " + std::to_string(whole.asked()));
    Counted stopped(k, By::kStop);
    const auto program = bytes(stopped.job);
    if (program) {
      given.insert(*program);
    } else {
      ++errors;
      EXPECT_TRUE(says_stopped(program.error())) << to_text(program.error());
      EXPECT_TRUE(given.empty()) << "once the fallback is checked, it is given";
    }
  }
  EXPECT_GT(errors, 10U);
  // The fallback, and the best plan where the last questions come after it was taken.
  given.erase(*best);
  EXPECT_LE(given.size(), 1U);
}

}  // namespace
}  // namespace capstan::service
