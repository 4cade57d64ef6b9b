#pragma once

#include <cstddef>
#include <fstream>
#include <string>

namespace capstan::testing {

/// Children of this process that live or wait to be looked at.
inline std::size_t children() {
  std::ifstream list("/proc/thread-self/children");
  std::size_t n = 0;
  for (std::string pid; list >> pid;) ++n;
  return n;
}

}  // namespace capstan::testing
