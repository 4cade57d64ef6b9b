#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace capstan::testing {

/// One canonical call of LinuxCNC's stand-alone interpreter, e.g. STRAIGHT_FEED(1.0000, 2.0000, ...).
struct CanonCall {
  std::string name;
  std::string text;             ///< between the parentheses
  std::vector<double> numbers;  ///< those of its arguments that are numbers
};

struct Rs274Run {
  int status = -1;
  std::string output;  ///< standard output and error
  std::vector<CanonCall> calls;
  /// The calls of these names, in order.
  [[nodiscard]] std::vector<CanonCall> only(const std::vector<std::string>& names) const;
};

[[nodiscard]] bool rs274_available();

/// Runs `rs274 -t TABLE -g PROGRAM` in a scratch folder. Note: the stand-alone interpreter takes the table's
/// numbers as inches, so that Z words in machine coordinates come out shifted by 25.4 times the length.
[[nodiscard]] Rs274Run run_rs274(const std::string& tool_table, const std::string& program);

}  // namespace capstan::testing

/// Skips the test visibly where LinuxCNC's interpreter is not installed.
#define CAPSTAN_NEEDS_RS274() \
  if (!::capstan::testing::rs274_available()) GTEST_SKIP() << "rs274 (package linuxcnc-uspace) is absent"
