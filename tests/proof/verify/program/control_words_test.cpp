#include <gtest/gtest.h>

#include <string>

#include "planner/proof/verify/program/readers.h"
#include "planner/proof/verify/verify.h"
#include "tests/proof/verify/plans.h"

// What the check says of a control's words is that control's own.

namespace capstan::verify {
namespace {

/// What a check says of the first tool's length, which its table has as 0.
std::string said_of_no_length(const char* dialect) {
  model::Plan plan = testing::good_plan().plan;
  plan.machine.control.dialect = dialect;
  model::ToolTableLine line;
  line.words.push_back({"Z", 0.0});
  plan.cutters.front().table_line = line;
  Job job;
  std::string out;
  for (const auto& f : check_plan(plan, job)) {
    if (f.code == "CHK-TOOL-OFFSET") out += f.message;
  }
  return out;
}

TEST(ControlWords, WhatMakesALengthActIsNamedAsTheControlNamesIt) {
  const std::string t = std::to_string(testing::good_plan().plan.cutters.front().pocket);
  for (const auto& [dialect, word] : {std::pair<const char*, std::string>{"linuxcnc", "G43 H" + t},
                                      {"fanuc", "G43 H" + t},
                                      {"siemens", "T" + t + " D1"},
                                      {"heidenhain", "TOOL CALL " + t},
                                      {"grbl", "G43.1 Z of T" + t}}) {
    const std::string said = said_of_no_length(dialect);
    EXPECT_NE(said.find(", and " + word + " would take that"), std::string::npos) << dialect << ": " << said;
    if (word.find("G43 H") == std::string::npos) {
      EXPECT_EQ(said.find("G43 H"), std::string::npos) << dialect << ": " << said;
    }
  }
}

}  // namespace
}  // namespace capstan::verify
