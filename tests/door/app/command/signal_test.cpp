#include <fcntl.h>
#include <gmock/gmock.h>
#include <signal.h>
#include <spawn.h>
#include <unistd.h>

#include <cstdint>
#include <string>
#include <thread>

#include "tests/door/app/command/command.h"
#include "tests/door/app/programs.h"

// Ctrl-C while the command works: it says so, ends with the code of stopped work, and leaves nothing.

namespace capstan::app {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// Whether the process catches this signal (SigCgt of proc(5)).
bool catches(pid_t pid, int signal) {
  std::ifstream status("/proc/" + std::to_string(pid) + "/status");
  for (std::string line; std::getline(status, line);) {
    if (line.rfind("SigCgt:", 0) != 0) continue;
    return (std::stoull(line.substr(7), nullptr, 16) >> (static_cast<unsigned>(signal) - 1U) & 1U) != 0;
  }
  return false;
}

class Interrupted : public CommandTest, public ::testing::WithParamInterface<int> {
 protected:
  /// Plans a part that takes seconds, and sends the signal as soon as the command catches it.
  [[nodiscard]] Ran interrupted(int signal) const {
    const std::string err = (folder_ / "stderr.txt").string();
    const std::string part = ::capstan::testing::source_dir() + "/examples/surface.stl";
    std::vector<std::string> words = {command_file(),
                                      "plan",
                                      part,
                                      "-o",
                                      (folder_ / "s.json").string(),
                                      "-o",
                                      (folder_ / "s.ngc").string()};
    std::vector<char*> arguments;
    for (std::string& w : words) arguments.push_back(w.data());
    arguments.push_back(nullptr);
    posix_spawn_file_actions_t files;
    posix_spawn_file_actions_init(&files);
    posix_spawn_file_actions_addopen(&files, STDERR_FILENO, err.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
    pid_t pid = 0;
    const int failed = ::posix_spawn(&pid, command_file().c_str(), &files, nullptr, arguments.data(), environ);
    posix_spawn_file_actions_destroy(&files);
    if (failed != 0) return {};
    int status = 0;
    pid_t ended = 0;
    while (!catches(pid, signal) && (ended = ::waitpid(pid, &status, WNOHANG)) == 0)
      std::this_thread::yield();
    if (ended == 0) {
      ::kill(pid, signal);
      ::waitpid(pid, &status, 0);
    } else {
      ADD_FAILURE() << "the command ended before the signal";
    }
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, {}, slurp(err)};
  }
};
INSTANTIATE_TEST_SUITE_P(By, Interrupted, ::testing::Values(SIGINT, SIGTERM),
                         [](const auto& i) { return std::string(i.param == SIGINT ? "CtrlC" : "Kill"); });

TEST_P(Interrupted, EndsAsStoppedWorkAndWritesNothing) {
  const Ran ran = interrupted(GetParam());
  EXPECT_EQ(ran.code, 4) << ran.err;
  EXPECT_THAT(ran.err, HasSubstr("-STOPPED]"));
  EXPECT_THAT(files(), IsEmpty());
}

}  // namespace
}  // namespace capstan::app
