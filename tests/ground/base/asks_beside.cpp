// A library in a folder of its own that asks where files of Capstan lie.

#include <algorithm>
#include <string>
#include <vector>

#include "planner/ground/base/loading/beside.h"

/// The first places, and how many there are.
extern "C" [[gnu::visibility("default")]] std::size_t capstan_asks_beside(const char* file,
                                                                          const char* (*places)[8]) {
  static std::vector<std::string> kept;
  kept = capstan::places_beside(file);
  for (std::size_t i = 0; i < std::min<std::size_t>(kept.size(), 8); ++i) (*places)[i] = kept[i].c_str();
  return kept.size();
}
