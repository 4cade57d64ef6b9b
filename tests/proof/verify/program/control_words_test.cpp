#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "planner/proof/verify/program/readers.h"
#include "planner/proof/verify/verify.h"
#include "tests/proof/verify/plans.h"

// What the check says of a control's words is that control's own.

namespace capstan::verify {
namespace {

/// What a check says of the first tool's length, which its table has as 0.
std::string said_of_no_length(const char* dialect, std::vector<model::ControlOption> options = {}) {
  model::Plan plan = testing::good_plan().plan;
  plan.machine.control.dialect = dialect;
  plan.machine.control_options = model::ControlOptions{std::move(options)};
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
    const bool grbl = std::string_view(dialect) == "grbl";
    const std::string said =
        grbl ? said_of_no_length(dialect, {{"tool_length", "g43.1"}}) : said_of_no_length(dialect);
    EXPECT_NE(said.find(", and " + word + " would take that"), std::string::npos) << dialect << ": " << said;
    if (word.find("G43 H") == std::string::npos) {
      EXPECT_EQ(said.find("G43 H"), std::string::npos) << dialect << ": " << said;
    }
  }
}

// The zero of Z is set with the tool itself: what the table has of it, no block takes.
TEST(ControlWords, ALengthThatNoBlockTakesIsNotFoundWhereToolsAreTouchedOff) {
  EXPECT_EQ(said_of_no_length("grbl"), "");
  EXPECT_EQ(said_of_no_length("grbl", {{"tool_length", "touch_off"}}), "");
}

TEST(ControlWords, NorIsOneInTheHeaderOfAProgramAlone) {
  const std::string text =
      "(CAPSTAN PROGRAM version=1)\n(CAPSTAN TOOL T2 H2 length=0 diameter=8 id=\"d\" twist_drill)\n"
      "G21 G17 G90 G94 G40 G80\nG53 G0 Z0\nG54\nT2 M6\nG53 G0 Z0\nS1500 M3\nG0 X15 Y15\nG0 Z5\nG1 Z-2 F100\n"
      "M5\nG53 G0 Z0\nM2\n";
  for (const auto& [length, said] : {std::pair("touch_off", 0), std::pair("g43.1", 1)}) {
    model::Machine machine = testing::good_plan().plan.machine;
    machine.control.dialect = "grbl";
    machine.control_options = model::ControlOptions{{{"tool_length", length}}};
    Job job;
    const auto findings = check_program({"part.gcode", text, {}}, nullptr, machine, {}, job);
    EXPECT_EQ(std::count_if(findings.begin(), findings.end(),
                            [](const auto& f) { return f.code == "CHK-TOOL-OFFSET"; }),
              said)
        << length;
  }
}

}  // namespace
}  // namespace capstan::verify
