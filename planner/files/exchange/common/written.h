#pragma once

#include <string>
#include <vector>

namespace capstan::exchange {

/// A written file, and its losses.
struct Written {
  std::string bytes;
  std::vector<std::string> losses;  ///< sentences; empty when the file holds all of the plan
};

}  // namespace capstan::exchange
