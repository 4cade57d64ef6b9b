#include "planner/ground/base/job.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <condition_variable>
#include <set>
#include <stdexcept>
#include <string>
#include <thread>

namespace capstan {
namespace {

using Moment = std::chrono::steady_clock::time_point;

TEST(Job, KeepsWhatIsReportedInTheOrderOfTheCalls) {
  Job job;
  job.note("A", "first", "step 1");
  job.warn("B", "second");
  job.report({.code = "C", .message = "third"});
  const std::vector<Diagnostic> said = job.take_diagnostics();
  ASSERT_EQ(said.size(), 3U);
  EXPECT_EQ(said[0],
            (Diagnostic{.code = "A", .severity = Severity::kNote, .message = "first", .path = "step 1"}));
  EXPECT_EQ(said[1], (Diagnostic{.code = "B", .severity = Severity::kWarning, .message = "second"}));
  EXPECT_EQ(said[2], (Diagnostic{.code = "C", .severity = Severity::kError, .message = "third"}));
  EXPECT_TRUE(job.diagnostics().empty()) << "they are taken once";
}

TEST(Job, CountsBySeverityAndHasErrorsOnlyByErrors) {
  Job job;
  job.note("A", "");
  job.warn("B", "");
  job.warn("B", "");
  EXPECT_FALSE(job.has_errors());
  job.report({.code = "C", .message = ""});
  EXPECT_TRUE(job.has_errors());
  EXPECT_EQ(job.count(Severity::kNote), 1U);
  EXPECT_EQ(job.count(Severity::kWarning), 2U);
  EXPECT_EQ(job.count(Severity::kError), 1U);
}

TEST(Job, TellsProgressToWhoAskedForIt) {
  Job job;
  job.progress("nobody listens", 0.1);
  std::string heard;
  job.set_progress([&](std::string_view stage, double fraction) {
    heard += std::string(stage) + (fraction == 0.5 ? " half " : " ? ");
  });
  job.progress("order", 0.5);
  EXPECT_EQ(heard, "order half ");
}

TEST(Job, IsToStopWhereSomebodyAskedAndFromTheDeadlineOn) {
  Job job;
  EXPECT_FALSE(job.stop_requested());
  Moment now{std::chrono::hours(1)};
  const Moment deadline = now + std::chrono::seconds(2);
  job.set_clock([&now] { return now; });
  job.set_deadline(deadline);
  EXPECT_FALSE(job.stop_requested());
  now = deadline - std::chrono::nanoseconds(1);
  EXPECT_FALSE(job.stop_requested());
  now = deadline;
  EXPECT_TRUE(job.stop_requested());
  now = Moment{};
  EXPECT_FALSE(job.stop_requested());
  job.request_stop();
  EXPECT_TRUE(job.stop_requested()) << "whatever the clock says";
}

TEST(Job, ReadsTheClockForADeadlineOnly) {
  Job job;
  int read = 0;
  job.set_clock([&read] {
    ++read;
    return Moment{};
  });
  EXPECT_FALSE(job.stop_requested());
  EXPECT_EQ(read, 0);
}

TEST(Job, TakesReportsFromManyThreadsWithoutLosingOne) {
  Job job;
  job.threads = 4;
  parallel_for(job, 2000, [&](std::size_t i) { job.warn("W", std::to_string(i)); });
  std::set<std::string> said;
  for (const Diagnostic& d : job.diagnostics()) said.insert(d.message);
  EXPECT_EQ(job.diagnostics().size(), 2000U);
  EXPECT_EQ(said.size(), 2000U);
}

TEST(ParallelFor, CallsTheBodyOnceForEachIndexOnAnyNumberOfThreads) {
  for (const unsigned threads : {0U, 1U, 2U, 3U, 8U}) {
    for (const std::size_t n : {0U, 1U, 2U, 7U, 1000U}) {
      Job job;
      job.threads = threads;
      std::vector<int> calls(n, 0);
      parallel_for(job, n, [&](std::size_t i) { ++calls[i]; });
      EXPECT_EQ(std::count(calls.begin(), calls.end(), 1), static_cast<std::ptrdiff_t>(n)) << threads;
    }
  }
}

/// The threads that a loop of so many rounds runs on; a round waits until `wanted` of them are there, once in
/// vain.
std::set<std::thread::id> threads_of(unsigned threads, std::size_t n, std::size_t wanted) {
  Job job;
  job.threads = threads;
  std::mutex mutex;
  std::condition_variable arrived;
  std::set<std::thread::id> met;
  bool in_vain = false;
  parallel_for(job, n, [&](std::size_t) {
    std::unique_lock lock(mutex);
    met.insert(std::this_thread::get_id());
    arrived.notify_all();
    if (in_vain) return;
    // Waited out only where there are fewer: the test fails then.
    in_vain = !arrived.wait_for(lock, std::chrono::seconds(10), [&] { return met.size() >= wanted; });
  });
  return met;
}

TEST(ParallelFor, RunsOnTheCallersThreadWhereOneIsAllowedOrOneIsEnough) {
  const std::set<std::thread::id> own{std::this_thread::get_id()};
  EXPECT_EQ(threads_of(1, 5, 1), own);
  EXPECT_EQ(threads_of(0, 5, 1), own);
  EXPECT_EQ(threads_of(8, 1, 1), own);
}

TEST(ParallelFor, RunsOnAsManyThreadsAtOnceAsAreAllowedAndNeeded) {
  EXPECT_EQ(threads_of(3, 30, 3).size(), 3U);
  EXPECT_EQ(threads_of(8, 2, 2).size(), 2U);
}

TEST(ParallelFor, RethrowsTheExceptionOfTheLowestIndexAfterAllWereCalled) {
  Job job;
  job.threads = 4;
  std::vector<int> calls(100, 0);
  try {
    parallel_for(job, calls.size(), [&](std::size_t i) {
      ++calls[i];
      if (i % 10 == 7) throw std::runtime_error(std::to_string(i));
    });
    ADD_FAILURE() << "nothing was thrown";
  } catch (const std::runtime_error& e) {
    EXPECT_STREQ(e.what(), "7");
  }
  EXPECT_EQ(std::count(calls.begin(), calls.end(), 1), 100);
}

}  // namespace
}  // namespace capstan
