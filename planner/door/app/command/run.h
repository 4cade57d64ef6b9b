#pragma once

#include <array>

#include "planner/door/service/code.h"

namespace capstan::app {

/// Exit codes of the command; `kExitTexts` has their meaning.
enum ExitCode : int {
  kDone = static_cast<int>(service::Code::kDone),
  kFindings = static_cast<int>(service::Code::kFindings),
  kUsage = static_cast<int>(service::Code::kUsage),
  kUnreadable = static_cast<int>(service::Code::kUnreadable),
  kImpossible = static_cast<int>(service::Code::kImpossible),
  kLate = static_cast<int>(service::Code::kLate),
  kOurFault = static_cast<int>(service::Code::kFault),
};

struct ExitText {
  ExitCode code;
  const char* meaning;
};
/// For the manual pages; README's table says the same at more length.
inline constexpr std::array kExitTexts{
    ExitText{kDone, "done"},
    ExitText{
        kFindings,
        "done, with findings: an unplanned feature, a violation, a difference, an export of cases some of "
        "which are lost; no program is "
        "written of a plan that the check condemns"},
    ExitText{kUsage,
             "wrong usage; a material, machine, fixture or tool that nobody knows; an output that cannot "
             "be written"},
    ExitText{kUnreadable, "an input cannot be read"},
    ExitText{kImpossible, "impossible: no tool, no machine can; or stopped before the end"},
    ExitText{kLate, "bind: done, but after the deadline"},
    ExitText{kOurFault, "a fault of the program itself"},
};

/// The whole program: reads the command line, does the command, prints, and gives the exit code.
/// Nothing is thrown.
[[nodiscard]] int run(int argc, const char* const* argv);

}  // namespace capstan::app
