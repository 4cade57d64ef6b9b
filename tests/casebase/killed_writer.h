#pragma once

#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <random>
#include <string>

#include "tests/casebase/sample.h"

namespace capstan::casebase {

/// Kills writers of batches of five, 25 of them, each at another moment: every batch is there whole or not at
/// all, and none goes. `warnings`: what each opening says. Gives how many cases are there then.
inline std::size_t expect_whole_after_killed_writers(const std::string& uri, std::size_t warnings) {
  constexpr std::size_t kBatch = 5;
  std::mt19937 random(51);
  std::size_t before = 0;
  for (unsigned round = 0; round < 25 && !testing::Test::HasFailure(); ++round) {
    const pid_t writer = fork();
    if (writer == 0) {
      Job job;
      auto base = CaseBase::open(uri, job);
      for (unsigned i = 0; base; ++i) {
        if (!base->add(random_cases(kBatch, 1000 + 100 * round + i))) _exit(1);
      }
      _exit(2);
    }
    // On a busy machine a writer may be killed before it begins: it is given longer until one has written.
    const unsigned most_us = 60'000 * (before == 0 ? round + 1 : 1);
    usleep(static_cast<unsigned>(1000 + random() % most_us));
    kill(writer, SIGKILL);
    int status = 0;
    waitpid(writer, &status, 0);
    EXPECT_TRUE(WIFSIGNALED(status)) << WEXITSTATUS(status);
    Job job;
    const auto base = CaseBase::open(uri, job);
    if (!base) {
      ADD_FAILURE() << to_text(base.error());
      break;
    }
    EXPECT_EQ(job.count(Severity::kWarning), warnings);
    EXPECT_GE(base->size(), before);
    EXPECT_EQ(base->size() % kBatch, 0u);
    before = base->size();
  }
  EXPECT_GT(before, 0u);
  return before;
}

}  // namespace capstan::casebase
