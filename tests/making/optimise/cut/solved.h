#pragma once

#include <gtest/gtest.h>

#include "planner/making/optimise/cut.h"
#include "tests/making/optimise/cut/questions.h"

namespace capstan::optimise::questions {

/// Tests that ask the solver that the build has; where it has none they are skipped.
class Solved : public ::testing::Test {
 protected:
  void SetUp() override {
    Job job;
    const auto a = cut(roughing(), {}, job);
    if (!a && a.error().code == "OPT-BACKEND-ABSENT") GTEST_SKIP() << a.error().message;
  }

  static CutAnswer answered(const CutQuestion& q) {
    Job job;
    auto a = cut(q, {}, job);
    EXPECT_TRUE(a) << (a ? "" : to_text(a.error()));
    return a ? *a : CutAnswer{};
  }
};

}  // namespace capstan::optimise::questions
