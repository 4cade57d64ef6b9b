#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "planner/door/service/planning.h"
#include "tests/support/corpus.h"
#include "tests/support/plate.h"

// A program that was checked with its plan and tool table is not swept once more for being written without
// the table, or with another: what is found is what a whole check finds.

namespace capstan::service {
namespace {

struct Judged {
  std::string findings;
  bool swept = false;
};

Judged judged(const Planned& planned, std::vector<Output> outputs) {
  Judged out;
  Job job;
  job.set_progress([&](std::string_view stage, double) { out.swept = out.swept || stage == "check"; });
  const auto verdict = judge({}, planned, outputs, job);
  EXPECT_TRUE(verdict);
  if (!verdict) return out;
  for (const FileFinding& f : verdict->findings)
    out.findings += f.file + " " + f.finding.code + " " + f.finding.step + " " +
                    std::to_string(f.finding.move) + " " + f.finding.message + "\n";
  return out;
}

class JudgeOfACheckedProgram : public ::testing::Test {
 protected:
  void SetUp() override {
    Job job;
    auto made = plan({}, {capstan::testing::source_dir() + "/examples/reference_pocket.p21"}, job);
    ASSERT_TRUE(made);
    anew_ = *std::move(made);
    auto outputs = outputs_of({"p.ngc", "p.tbl"});
    ASSERT_TRUE(outputs);
    outputs_ = *std::move(outputs);
    ASSERT_TRUE(make(anew_.plan, outputs_, job));
    known_ = anew_;
    known_.program = {outputs_[0].bytes, outputs_[1].bytes, {}};
    ASSERT_EQ(judged(anew_, outputs_).findings, "");  // so that nothing was found of it
  }

  void expect_same_without_a_sweep(const std::vector<Output>& outputs) const {
    const Judged whole = judged(anew_, outputs), once = judged(known_, outputs);
    EXPECT_EQ(once.findings, whole.findings);
    EXPECT_TRUE(whole.swept);
    EXPECT_FALSE(once.swept);
  }

  Planned anew_, known_;
  std::vector<Output> outputs_;  ///< the program, the table
};

TEST_F(JudgeOfACheckedProgram, SweepsNothingForTheSameTable) { expect_same_without_a_sweep(outputs_); }

TEST_F(JudgeOfACheckedProgram, SweepsNothingWithoutATable) { expect_same_without_a_sweep({outputs_[0]}); }

TEST_F(JudgeOfACheckedProgram, FindsWhatAnotherTableSays) {
  std::vector<Output> outputs = outputs_;
  outputs[1].bytes = capstan::testing::with_tool_changed(outputs[1].bytes, "T1 ", "D", -1.0);
  ASSERT_NE(outputs[1].bytes, outputs_[1].bytes);
  expect_same_without_a_sweep(outputs);
  EXPECT_NE(judged(known_, outputs).findings, "");
}

TEST_F(JudgeOfACheckedProgram, SweepsAProgramThatIsNotTheSame) {
  std::vector<Output> outputs = outputs_;
  outputs[0].bytes += "(edited)\n";
  EXPECT_TRUE(judged(known_, outputs).swept);
}

}  // namespace
}  // namespace capstan::service
