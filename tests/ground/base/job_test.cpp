#include "planner/ground/base/job.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <mutex>
#include <numeric>
#include <set>
#include <stdexcept>
#include <thread>

namespace capstan {
namespace {

using std::chrono::milliseconds;
using Time = std::chrono::steady_clock::time_point;

TEST(Job, KeepsWhatIsReportedInItsOrderAndCountsItBySeverity) {
  Job job;
  job.note("A", "first");
  job.report({.code = "B", .message = "second"});
  job.warn("C", "third", "its_path");
  EXPECT_TRUE(job.has_errors());
  EXPECT_EQ(job.count(Severity::kNote), 1U);
  EXPECT_EQ(job.count(Severity::kWarning), 1U);
  const auto taken = job.take_diagnostics();
  ASSERT_EQ(taken.size(), 3U);
  EXPECT_EQ(taken[0].code, "A");
  EXPECT_EQ(taken[1].severity, Severity::kError);
  EXPECT_EQ(taken[2].path, "its_path");
  EXPECT_TRUE(job.diagnostics().empty()) << "taken once";
  EXPECT_FALSE(job.has_errors());
}

TEST(Job, StopsWhenItIsAskedAndAtItsDeadlineNotBefore) {
  Job job;
  Time now{milliseconds(100)};
  job.set_clock([&now] { return now; });
  EXPECT_FALSE(job.stop_requested()) << "no deadline";
  job.set_deadline(Time(milliseconds(150)));
  now = Time(milliseconds(149));
  EXPECT_FALSE(job.stop_requested());
  now = Time(milliseconds(150));
  EXPECT_TRUE(job.stop_requested());
  Job other;
  other.request_stop();
  EXPECT_TRUE(other.stop_requested());
}

TEST(Job, TellsProgressToWhomeverListens) {
  Job job;
  job.progress("nobody", 0.5);
  std::vector<std::pair<std::string, double>> heard;
  job.set_progress([&](std::string_view stage, double fraction) { heard.emplace_back(stage, fraction); });
  job.progress("paths", 0.25);
  ASSERT_EQ(heard.size(), 1U);
  EXPECT_EQ(heard[0], (std::pair<std::string, double>("paths", 0.25)));
}

TEST(ParallelFor, DoesEachPieceOnceWhateverTheThreads) {
  for (const unsigned threads : {0U, 1U, 2U, 7U}) {
    for (const std::size_t n : {0U, 1U, 2U, 1000U}) {
      Job job;
      job.threads = threads;
      std::vector<int> done(n);
      parallel_for(job, n, [&](std::size_t i) { ++done[i]; });
      EXPECT_EQ(std::accumulate(done.begin(), done.end(), 0), static_cast<int>(n)) << threads;
      EXPECT_TRUE(std::all_of(done.begin(), done.end(), [](int d) { return d == 1; })) << threads;
    }
  }
}

TEST(ParallelFor, OnOneThreadStaysOnTheCallersAndInOrder) {
  Job job;
  const std::thread::id caller = std::this_thread::get_id();
  std::vector<std::size_t> order;
  parallel_for(job, 5, [&](std::size_t i) {
    EXPECT_EQ(std::this_thread::get_id(), caller) << i;
    order.push_back(i);
  });
  EXPECT_EQ(order, (std::vector<std::size_t>{0, 1, 2, 3, 4}));
}

// Each of three pieces waits for the other two: it ends only where three threads run at a time.
TEST(ParallelFor, RunsAsManyPiecesAtATimeAsThereAreThreads) {
  Job job;
  job.threads = 3;
  std::mutex mutex;
  std::condition_variable all;
  std::set<std::thread::id> here;
  parallel_for(job, 3, [&](std::size_t) {
    std::unique_lock lock(mutex);
    here.insert(std::this_thread::get_id());
    all.notify_all();
    all.wait_for(lock, std::chrono::seconds(10), [&] { return here.size() == 3; });
  });
  EXPECT_EQ(here.size(), 3U);
}

TEST(ParallelFor, ThrowsWhatTheFirstFailingPieceThrewAfterAllAreDone) {
  Job job;
  job.threads = 2;
  std::atomic<int> done{0};
  try {
    parallel_for(job, 100, [&](std::size_t i) {
      ++done;
      if (i == 40 || i == 60) throw std::runtime_error(std::to_string(i));
    });
    FAIL() << "it threw nothing";
  } catch (const std::runtime_error& e) {
    EXPECT_STREQ(e.what(), "40");
  }
  EXPECT_EQ(done, 100);
}

}  // namespace
}  // namespace capstan
