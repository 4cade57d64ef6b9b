#include <gtest/gtest.h>
#include <malloc.h>
#include <signal.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <random>
#include <string>
#include <vector>

#include "planner/door/service/session.h"
#include "planner/files/json/json.h"
#include "tests/door/late/brought.h"
#include "tests/support/corpus.h"
#include "tests/support/scratch.h"
#include "tests/support/soak.h"

// Binds at deadlines from 1 ms to 1 s while two other processes keep the processor busy: the whole plan, and
// single workingsteps that are given up at the deadline. What the code says must be so; how many binds come
// in time is told, not asserted, for it is the machine's. One that comes later than it says would not have,
// had its thread had the processor all the time: then the scheduler kept it waiting.

namespace capstan::late {
namespace {

/// Two processes that only turn, while this lives.
class Busy {
 public:
  Busy() {
    for (pid_t& child : children_) {
      child = ::fork();
      if (child == 0) {
        std::atomic<unsigned long> n{0};
        while (++n % 100'000'000UL != 0 || ::getppid() != 1) {
        }
        ::_exit(0);
      }
    }
  }
  Busy(const Busy&) = delete;
  Busy& operator=(const Busy&) = delete;
  ~Busy() {
    for (const pid_t child : children_) {
      if (child <= 0) continue;
      ::kill(child, SIGKILL);
      ::waitpid(child, nullptr, 0);
    }
  }

 private:
  std::array<pid_t, 2> children_ = {-1, -1};
};

using Clock = std::chrono::steady_clock;
constexpr auto kOver = std::chrono::milliseconds(2);  ///< that a call may take past its deadline, unsaid

/// Binds with a deadline up to so many ms.
struct Share {
  int most_ms = 0, binds = 0, in_time = 0, late = 0, refused = 0;
  int waited = 0;  ///< more than kOver past the deadline, for want of the processor
};

/// A call by the clock, and by its thread's own.
struct Took {
  Clock::duration wall{}, cpu{};
};
Clock::duration thread_cpu() {
  timespec t{};
  ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return std::chrono::seconds(t.tv_sec) + std::chrono::nanoseconds(t.tv_nsec);
}
template <class Call>
Took timed(const Call& call) {
  const auto began = Clock::now();
  const auto cpu = thread_cpu();
  call();
  return {Clock::now() - began, thread_cpu() - cpu};
}

/// A tool table in which one tool was set anew, or a mill has worn.
std::string another(const std::string& table, std::mt19937& random) {
  std::vector<int> tools;
  for (std::size_t at = 0; at < table.size(); at = table.find('\n', at) + 1)
    tools.push_back(std::atoi(table.c_str() + at + 1));
  const int tool = tools[random() % tools.size()];
  const double by = 0.01 * static_cast<double>(random() % 50);
  return random() % 8 == 0 ? with(table, tool, "D", -0.02) : with(table, tool, "Z", by);
}

TEST(LateDeadlineSeed, WhatIsCalledInTimeIsAndEveryAnswerIsCheckedOrLate) {
  const bool soaks = soaking();
  const int binds = soaks ? 200 : 8;  // 50 repetitions of a soak: 10,000
  std::mt19937 random(static_cast<unsigned>(::testing::UnitTest::GetInstance()->random_seed()));
  const Brought early =
      brought(capstan::testing::source_dir() + "/examples/bracket.p21", pipeline::Format::kJson);
  const std::string json = json::write_json(early.plan);
  const std::string path = capstan::testing::scratch_file("late_deadline.tbl");
  // The second row of 200 ms: single workingsteps at just that.
  std::array<Share, 5> shares = {Share{10}, Share{100}, Share{200}, Share{1000}, Share{200}};
  service::Session whole, single;
  ASSERT_EQ(single.set("stop-at-deadline", "yes"), service::Code::kDone);
  ASSERT_EQ(single.take(json), service::Code::kDone) << single.message();
  const Busy busy;
  for (int i = 0; i < binds; ++i) {
    const bool next = i % 2 == 1, at_200 = i % 4 == 3;
    service::Session& session = next ? single : whole;
    std::ofstream(path) << another(early.table, random);
    ASSERT_EQ(session.set("tools", path), service::Code::kDone) << session.message();
    // A control that goes on at its deadline has opened what it can before.
    if (next) {
      ASSERT_EQ(session.open(), service::Code::kDone) << session.message();
    }
    const auto drawn = static_cast<int>(std::pow(10.0, 3.0 * static_cast<double>(random() % 1001) / 1000.0));
    const auto deadline = std::chrono::milliseconds(at_200 ? 200 : drawn);
    const std::size_t step = 1 + random() % early.plan.steps.size();
    service::Code code = service::Code::kFault;
    const Took took = timed(
        [&] { code = next ? session.bind_next(json, step, 1, deadline) : session.bind(json, deadline); });
    Share* share = at_200 ? &shares.back() : shares.data();
    while (share->most_ms < deadline.count()) ++share;
    ++share->binds;
    const bool said_late = session.message().find("[LATE-DEADLINE]") != std::string::npos;
    const bool over = took.wall > deadline + kOver;
    // Of what is refused after the deadline nothing is cut: a plan that is not given up there, and a single
    // step that is, of which a soak asks that its thread gave it up in time.
    if (over && (code == service::Code::kDone || next)) {
      if (soaks || code == service::Code::kDone) {
        EXPECT_GE(took.wall - took.cpu, took.wall - (deadline + kOver)) << session.message();
      }
      ++share->waited;
    }
    if (code == service::Code::kDone) {
      EXPECT_FALSE(said_late) << session.message();
      EXPECT_NE(session.output("linuxcnc"), nullptr);
      ++share->in_time;
    } else if (code == service::Code::kLate) {
      EXPECT_TRUE(said_late) << session.message();
      EXPECT_GT(took.wall, deadline);
      EXPECT_NE(session.output("linuxcnc"), nullptr);
      ++share->late;
    } else {
      EXPECT_EQ(code, service::Code::kImpossible) << session.message();
      EXPECT_EQ(session.output("linuxcnc"), nullptr);
      ++share->refused;
    }
  }
  for (const Share& s : shares)
    std::printf(
        "%s %4d ms: %d binds, %d in time (%.1f %%), %d late, %d refused, %d waited for the processor\n",
        &s == &shares.back() ? "single steps, deadline of" : "deadline up to", s.most_ms, s.binds, s.in_time,
        s.binds == 0 ? 0.0 : 100.0 * s.in_time / s.binds, s.late, s.refused, s.waited);
}

TEST(LateMemorySeed, DoesNotGrowWithTheNumberOfBinds) {
  constexpr std::size_t kTables = 6;  // by turns: what is remembered of them is remembered after two rounds
  constexpr std::size_t kGrowth = 256000;  // bytes; a plan of the pocket has more
  const char* const seconds = std::getenv("CAPSTAN_SOAK_SECONDS");
  const std::chrono::seconds lasts(seconds != nullptr ? std::atoi(seconds) : 0);
  std::mt19937 random(static_cast<unsigned>(::testing::UnitTest::GetInstance()->random_seed()));
  const Brought early =
      brought(capstan::testing::source_dir() + "/examples/reference_pocket.p21", pipeline::Format::kJson);
  const std::string json = json::write_json(early.plan);
  std::vector<std::string> tables;
  for (std::size_t i = 0; i < kTables; ++i) tables.push_back(another(early.table, random));
  const std::string path = capstan::testing::scratch_file("late_memory.tbl");
  service::Session session;
  std::size_t binds = 0;
  const auto round = [&] {
    for (const std::string& table : tables) {
      std::ofstream(path) << table;
      ASSERT_EQ(session.set("tools", path), service::Code::kDone) << session.message();
      (void)session.bind(json, std::chrono::milliseconds(1));
      (void)session.bind_next(json, 1 + binds % early.plan.steps.size(), 1, std::chrono::milliseconds(1));
      binds += 2;
    }
  };
  const auto until = Clock::now() + lasts;
  // Each workingstep was asked for with each table.
  for (std::size_t i = 0; i < early.plan.steps.size() + 2; ++i) round();
  const std::size_t before = ::mallinfo2().uordblks, warm = binds;
  for (std::size_t i = 0; i < early.plan.steps.size() || Clock::now() < until; ++i) round();
  const std::size_t after = ::mallinfo2().uordblks;
  EXPECT_LE(after, before + kGrowth) << "in " << binds - warm << " binds";
  std::printf("%zu binds, then %zu more: %.3f MB before, %.3f MB after\n", warm, binds - warm,
              1e-6 * static_cast<double>(before), 1e-6 * static_cast<double>(after));
}

}  // namespace
}  // namespace capstan::late
