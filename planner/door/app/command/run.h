#pragma once

namespace capstan::app {

/// What the command ends with.
enum ExitCode : int {
  kDone = 0,
  kFindings = 1,    ///< done, but with findings: an unplanned feature, a violation, a difference
  kUsage = 2,       ///< wrong usage, or something that is not supported yet
  kUnreadable = 3,  ///< an input cannot be read
  kImpossible = 4,  ///< no tool, no machine can; or an output cannot be made or written
  kLate = 5,        ///< bind: done, but after the deadline
  kOurFault = 70,   ///< a fault of the program itself
};

/// The whole program: reads the command line, does the command, prints, and gives the exit code.
/// Nothing is thrown.
[[nodiscard]] int run(int argc, const char* const* argv);

}  // namespace capstan::app
