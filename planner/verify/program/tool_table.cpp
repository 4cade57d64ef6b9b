#include "planner/verify/program/tool_table.h"

#include "planner/verify/program/words.h"

namespace capstan::verify {

namespace {
int whole(double v) { return v >= 0.0 && v < 1e9 ? static_cast<int>(v) : 1000000000; }
}  // namespace

ToolTable read_tool_table(std::string_view text) {
  constexpr std::size_t kMostEntries = 100000;
  ToolTable out;
  Line line;
  long number = 0;
  while (!text.empty() && out.entries.size() < kMostEntries) {
    const std::size_t end = text.find('\n');
    split_line(text.substr(0, end), line);
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
    ++number;
    if (!line.fault.empty()) out.faults.push_back("line " + std::to_string(number) + ": " + line.fault);
    if (line.words.empty()) continue;
    ToolTableEntry e;
    e.line = number;
    bool tool = false;
    for (const Word& w : line.words) {
      if (w.letter == 'T') {
        tool = true;
        e.tool = whole(w.value);
      } else if (w.letter == 'P') {
        e.pocket = whole(w.value);
      } else if (w.letter == 'Z') {
        e.length_mm = w.value;
        e.has_length = true;
      } else if (w.letter == 'D') {
        e.diameter_mm = w.value;
        e.has_diameter = true;
      }
    }
    if (tool) {
      out.entries.push_back(e);
    } else {
      out.faults.push_back("line " + std::to_string(number) + ": no T word");
    }
  }
  return out;
}

}  // namespace capstan::verify
