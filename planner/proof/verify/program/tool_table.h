#pragma once

#include <string>
#include <vector>

namespace capstan::verify {

/// A line of a tool table, whatever control it is for.
struct ToolTableEntry {
  int tool = 0, pocket = 0;
  double length_mm = 0.0, diameter_mm = 0.0;
  bool has_length = false, has_diameter = false, has_tool = false, has_pocket = false;
  std::string others;  ///< offsets in other directions that are not zero, as written
  long line = 0;
};
struct ToolTable {
  std::vector<ToolTableEntry> entries;  ///< in the file's order
  std::vector<std::string> faults;
};

}  // namespace capstan::verify
