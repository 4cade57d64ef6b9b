#include "planner/ground/base/stopping.h"

#include <gtest/gtest.h>

#include <atomic>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "planner/ground/base/job.h"

namespace capstan {
namespace {

/// What `body` came to.
template <class Body>
std::string outcome(const Job& job, Body body) {
  return stoppable(
      job,
      [&]() -> std::string {
        body();
        return "done";
      },
      []() -> std::string { return "stopped"; });
}

TEST(Poll, DoesNothingWithoutAScope) { EXPECT_NO_THROW(poll()); }

TEST(Poll, EndsTheWorkOfAJobThatIsToStop) {
  Job job;
  EXPECT_EQ(outcome(job, [] { poll(); }), "done");
  job.request_stop();
  EXPECT_EQ(outcome(job, [] { poll(); }), "stopped");
  EXPECT_EQ(outcome(job, [] {}), "done") << "nobody asked";
  EXPECT_NO_THROW(poll()) << "the scope has ended";
}

TEST(Poll, EndsATryWhenTheCallAroundItIsStopped) {
  Job call, trial;
  std::string inner;
  EXPECT_EQ(outcome(call,
                    [&] {
                      inner = outcome(trial, [&] {
                        call.request_stop();
                        poll();
                      });
                    }),
            "done");
  EXPECT_EQ(inner, "stopped");
}

TEST(Poll, TheCallGoesOnWhenItsTryIsStopped) {
  Job call, trial;
  trial.request_stop();
  EXPECT_EQ(outcome(call,
                    [&] {
                      EXPECT_EQ(outcome(trial, [] { poll(); }), "stopped");
                      poll();
                    }),
            "done");
}

TEST(Poll, ReleasesWhatTheWorkHeld) {
  const auto held = std::make_shared<int>(0);
  Job job;
  job.request_stop();
  EXPECT_EQ(outcome(job,
                    [held] {
                      const auto more = held;
                      poll();
                    }),
            "stopped");
  EXPECT_EQ(held.use_count(), 1);
}

TEST(Poll, AFaultIsNoStop) {
  const Job job;
  EXPECT_THROW((void)outcome(job, [] { throw std::logic_error("a fault"); }), std::logic_error);
}

TEST(Tick, PollsWithinSixtyFourCalls) {
  Job job;
  job.request_stop();
  int calls = 0;
  EXPECT_EQ(outcome(job,
                    [&] {
                      for (; calls < 1000; ++calls) tick();
                    }),
            "stopped");
  EXPECT_LT(calls, 64);
}

TEST(ParallelFor, AStopEndsItOnAllItsThreads) {
  for (const unsigned threads : {1U, 2U, 8U}) {
    Job job;
    job.threads = threads;
    std::atomic<std::size_t> called{0};
    constexpr std::size_t kMany = 100000;
    EXPECT_EQ(outcome(job,
                      [&] {
                        parallel_for(job, kMany, [&](std::size_t) {
                          if (++called == 10) job.request_stop();
                        });
                      }),
              "stopped");
    EXPECT_LE(called.load(), 10 + 2 * threads);
  }
}

TEST(ParallelFor, ABodyMayPollOnAnyThread) {
  Job job;
  job.threads = 4;
  std::atomic<int> stopped{0};
  EXPECT_EQ(outcome(job,
                    [&] {
                      parallel_for(job, 64, [&](std::size_t) {
                        job.request_stop();
                        try {
                          poll();
                        } catch (const Stopped&) {
                          ++stopped;
                          throw;
                        }
                      });
                    }),
            "stopped");
  EXPECT_GE(stopped.load(), 1);
}

TEST(ParallelFor, CallsWithinCallsEnd) {
  Job job;
  job.threads = 3;
  std::vector<std::vector<int>> called(20, std::vector<int>(20, 0));
  parallel_for(job, called.size(), [&](std::size_t i) {
    parallel_for(job, called[i].size(), [&](std::size_t k) { ++called[i][k]; });
  });
  for (const auto& row : called) EXPECT_EQ(row, std::vector<int>(20, 1));
}

}  // namespace
}  // namespace capstan
