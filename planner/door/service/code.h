#pragma once

namespace capstan::service {

/// Result of a call: the exit code of the command, the code of the C interface.
enum class Code : int {
  kDone = 0,
  kFindings = 1,
  kUsage = 2,
  kUnreadable = 3,
  kImpossible = 4,
  kLate = 5,
  kFault = 70,
};

}  // namespace capstan::service
