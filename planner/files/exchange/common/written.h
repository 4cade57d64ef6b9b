#pragma once

#include <string>
#include <vector>

namespace capstan::exchange {

/// What was written, and what could not be.
struct Written {
  std::string bytes;
  std::vector<std::string> losses;  ///< sentences; empty when the file holds all of the plan
};

}  // namespace capstan::exchange
