#include "planner/ground/base/loading/process.h"

#include <gtest/gtest.h>

#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <thread>

#include "tests/support/corpus.h"
#include "tests/support/processes/children.h"

namespace capstan {
namespace {

using namespace std::chrono_literals;
using testing::children;
using Kind = ProcessEnd::Kind;

ProcessEnd run(const std::string& text, const ProcessLimits& limits = {}, const std::string& input = {}) {
  const Job job;
  auto end = run_process("/bin/sh", {"-c", text}, input, limits, job);
  EXPECT_TRUE(end) << (end ? "" : to_text(end.error()));
  EXPECT_EQ(children(), 0U);
  return end ? *end : ProcessEnd{};
}

TEST(Process, GivesInputOutputErrorsAndStatus) {
  const auto end = run("cat; echo wrong >&2; exit 3", {}, std::string("a\0b", 3));
  EXPECT_EQ(end.kind, Kind::kExited);
  EXPECT_EQ(end.status, 3);
  EXPECT_EQ(end.out, std::string("a\0b", 3));
  EXPECT_EQ(end.error, "wrong\n");
}

TEST(Process, OutputOfManyMegabytesArrivesWhole) {
  const std::string input(std::size_t{20} << 20, 'x');
  EXPECT_EQ(run("cat", {}, input).out, input);
}

TEST(Process, ASignalIsTold) {
  const auto end = run("kill -SEGV $$");
  EXPECT_EQ(end.kind, Kind::kSignal);
  EXPECT_EQ(end.status, SIGSEGV);
}

TEST(Process, AMissingProgramEndsAsInAShell) {
  const Job job;
  const auto end = run_process("/nonexistent/program", {}, {}, {}, job);
  ASSERT_TRUE(end);
  EXPECT_EQ(end->kind, Kind::kExited);
  EXPECT_EQ(end->status, 127);
  EXPECT_NE(end->error.find("No such file"), std::string::npos) << end->error;
}

TEST(Process, WhatBurnsProcessorTimeIsEnded) {
  EXPECT_EQ(run("while :; do :; done", {.processor_s = 1}).kind, Kind::kProcessor);
}

TEST(Process, WhatHangsIsEndedAfterItsTime) {
  const auto start = std::chrono::steady_clock::now();
  EXPECT_EQ(run("exec sleep 60", {.wall = 100ms}).kind, Kind::kWall);
  EXPECT_LT(std::chrono::steady_clock::now() - start, 30s);
}

TEST(Process, WhatWritesTooMuchIsEnded) {
  EXPECT_EQ(run("exec yes", {.wall = 60s, .output_bytes = 100'000}).kind, Kind::kOutput);
}

TEST(Process, MemoryIsLimited) {
  // A shell's variable that doubles: 2^27 bytes do not fit into 64 MiB.
  const auto end =
      run("x=aaaaaaaa; for i in 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 16 17 18 19 20 21 22 23 24; do "
          "x=$x$x; done; echo done",
          {.wall = 60s, .memory_bytes = std::uint64_t{64} << 20});
  EXPECT_EQ(end.out.find("done"), std::string::npos);
}

TEST(Process, AStoppedJobEndsIt) {
  Job job;
  std::thread stopper([&job] {
    std::this_thread::sleep_for(50ms);
    job.request_stop();
  });
  const auto end = run_process("/bin/sh", {"-c", "exec sleep 60"}, {}, {}, job);
  stopper.join();
  ASSERT_TRUE(end);
  EXPECT_EQ(end->kind, Kind::kStopped);
  EXPECT_EQ(children(), 0U);
}

TEST(Process, ADeadlineEndsIt) {
  Job job;
  job.set_deadline(std::chrono::steady_clock::now() + 50ms);
  const auto end = run_process("/bin/sh", {"-c", "exec sleep 60"}, {}, {}, job);
  ASSERT_TRUE(end);
  EXPECT_EQ(end->kind, Kind::kStopped);
}

TEST(Process, AnInterruptAtTheTerminalIsLeftToTheCaller) {
  EXPECT_EQ(run("kill -INT $$; echo alive").out, "alive\n");
}

// It must die with a caller that is killed: no orphan.
TEST(Process, DiesWithItsCaller) {
  const capstan::testing::ScratchFolder folder;
  const std::string file = folder.file("pid");
  const pid_t caller = ::fork();
  ASSERT_GE(caller, 0);
  if (caller == 0) {
    const Job job;
    (void)run_process("/bin/sh",
                      {"-c", "echo $$ > " + file + ".new; mv " + file + ".new " + file + "; exec sleep 60"},
                      {}, {}, job);
    ::_exit(0);
  }
  for (int i = 0; i < 2000 && !std::filesystem::exists(file); ++i) std::this_thread::sleep_for(5ms);
  pid_t child = 0;
  std::ifstream(file) >> child;
  ::kill(caller, SIGKILL);
  ::waitpid(caller, nullptr, 0);
  ASSERT_GT(child, 0);
  bool gone = false;
  for (int i = 0; i < 2000 && !gone; ++i) {
    // Whoever takes orphans over may be slow to look at it: a zombie is as good as gone.
    std::ifstream status("/proc/" + std::to_string(child) + "/stat");
    std::string pid, name, state;
    gone = !(status >> pid >> name >> state) || state == "Z";
    if (!gone) std::this_thread::sleep_for(5ms);
  }
  EXPECT_TRUE(gone);
}

}  // namespace
}  // namespace capstan
