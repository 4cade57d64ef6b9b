#include "planner/proof/verify/program/fanuc/subprograms.h"

#include <gtest/gtest.h>

#include <string>

namespace capstan::verify::fanuc {
namespace {

constexpr std::size_t kMany = 1000;

/// "3 G0 Z2." for each line that is run and is not empty.
std::string run(const std::string& text, std::size_t most = kMany) {
  std::string out;
  for (const RunLine& l : run_lines(text, most)) {
    if (!l.text.empty()) out += std::to_string(l.number) + " " + std::string(l.text) + "\n";
  }
  return out;
}

// 13.3: M98 P7001 runs the blocks of O7001 to its M99, and goes on behind the call.
TEST(FanucSubprograms, ACallRunsItsBlocksWithTheNumberOfTheCall) {
  EXPECT_EQ(run("%\nO1\nM98 P7001\nN20 M98 P7001\nM30\nO7001\nG0 Z2.\nG1 Z-3.\nM99\n%\n"),
            "1 %\n2 O1\n3 G0 Z2.\n3 G1 Z-3.\n4 G0 Z2.\n4 G1 Z-3.\n5 M30\n10 %\n");
  EXPECT_EQ(run("%\nO1\nG0 X1.\nM30\n%\n"), "1 %\n2 O1\n3 G0 X1.\n4 M30\n5 %\n");
}

TEST(FanucSubprograms, WhatIsNotFollowedStaysForTheReaderToSay) {
  const std::string end = "M30\nO7001\nG0 Z2.\nM99\n%\n";
  for (const char* call : {"M98 P7002", "M98 P7001 L2", "G90 M98 P7001", "M98 P37001"})
    EXPECT_NE(run("%\nO1\n" + std::string(call) + "\n" + end).find(std::string("3 ") + call),
              std::string::npos);
  for (const char* subs :
       {"O7001\nG0 Z2.\n%\n", "O7001\nM98 P7001\nM99\n%\n", "O7001\nG0 Z2.\nM99\nO7001\nM99\n%\n"})
    EXPECT_NE(run("%\nO1\nM98 P7001\nM30\n" + std::string(subs)).find("3 M98 P7001"), std::string::npos)
        << subs;
  // The program itself has that number, or another one in it: which of them is called?
  for (const char* name : {"O7001", "O7001 (PLATE)", "O 07001", "(PLATE O2) O7001", "N1 O7001", "O1\nO7001"})
    EXPECT_NE(run("%\n" + std::string(name) + "\nM98 P7001\n" + end).find(" M98 P7001"), std::string::npos)
        << name;
  EXPECT_EQ(run("%\nO1 (AS O7001)\nM98 P7001\n" + end).find("M98"), std::string::npos);
  // More lines than may come of it.
  EXPECT_NE(run("%\nO1\nM98 P7001\nM98 P7001\n" + end, 3).find("3 M98 P7001"), std::string::npos);
}

}  // namespace
}  // namespace capstan::verify::fanuc
