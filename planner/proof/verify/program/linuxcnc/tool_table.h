#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace capstan::verify {

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

/// LinuxCNC's tool table as LinuxCNC reads it: a line per tool of words T, P, Z, D and others, a comment
/// after `;`. Units   as written, taken as mm. Source  LinuxCNC 2.9 manual, "Tool table format".
[[nodiscard]] ToolTable read_tool_table(std::string_view text);

}  // namespace capstan::verify
