#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
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

#include "planner/door/service/session.h"
#include "planner/files/json/json.h"
#include "tests/door/late/brought.h"

// Binds at deadlines from 1 ms to 1 s while two other processes keep the processor busy. What the code says
// must be so; how many binds come in time is told, not asserted, for it is the machine's.

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

/// Binds with a deadline up to so many ms.
struct Share {
  int most_ms = 0, binds = 0, in_time = 0, late = 0, refused = 0;
  int overran = 0;  ///< OK by its own clock, and more than 2 ms over by the caller's: the scheduler's
};

TEST(LateDeadlineSeed, WhatIsCalledInTimeIsAndEveryAnswerIsCheckedOrLate) {
  using Clock = std::chrono::steady_clock;
  const bool soaks = std::getenv("CAPSTAN_SOAK") != nullptr;
  const int binds = soaks ? 200 : 8;  // 50 repetitions of a soak: 10,000
  std::mt19937 random(static_cast<unsigned>(::testing::UnitTest::GetInstance()->random_seed()));
  const Brought early =
      brought(capstan::testing::source_dir() + "/examples/bracket.p21", pipeline::Format::kJson);
  const std::string json = json::write_json(early.plan);
  const std::string path = ::testing::TempDir() + "late_deadline.tbl";
  std::array<Share, 4> shares = {Share{10}, Share{100}, Share{200}, Share{1000}};
  service::Session session;
  const Busy busy;
  for (int i = 0; i < binds; ++i) {
    const int tool = 1 + static_cast<int>(random() % static_cast<unsigned>(tools(early)));
    const double by = 0.01 * static_cast<double>(random() % 50);
    const bool worn = random() % 8 == 0;
    std::ofstream(path) << (worn ? with(early.table, tool, "D", -0.02) : with(early.table, tool, "Z", by));
    ASSERT_EQ(session.set("tools", path), service::Code::kDone) << session.message();
    const auto deadline = std::chrono::milliseconds(
        static_cast<int>(std::pow(10.0, 3.0 * static_cast<double>(random() % 1001) / 1000.0)));
    const auto began = Clock::now();
    const service::Code code = session.bind(json, deadline);
    const auto took = Clock::now() - began;
    Share* share = shares.data();
    while (share->most_ms < deadline.count()) ++share;
    ++share->binds;
    const bool said_late = session.message().find("[LATE-DEADLINE]") != std::string::npos;
    if (code == service::Code::kDone) {
      EXPECT_FALSE(said_late) << session.message();
      EXPECT_NE(session.output("linuxcnc"), nullptr);
      ++share->in_time;
      share->overran += took > deadline + std::chrono::milliseconds(2) ? 1 : 0;
    } else if (code == service::Code::kLate) {
      EXPECT_TRUE(said_late) << session.message();
      EXPECT_GT(took, deadline);
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
        "deadline up to %4d ms: %d binds, %d in time, %d late, %d refused, %d overran by the scheduler\n",
        s.most_ms, s.binds, s.in_time, s.late, s.refused, s.overran);
}

}  // namespace
}  // namespace capstan::late
