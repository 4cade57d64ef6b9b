#include "tests/validation/freecad/simulated.h"

#include <sstream>

#include "planner/ground/base/number.h"

namespace capstan::validation {

std::string part_name(const RivalCase& c) {
  return (c.boss_mm > 0 ? "with boss, " : "pocket, ") + std::to_string(c.depth_mm) + " mm";
}

std::vector<SimulatedRoughing> simulated_of(const std::string& text) {
  std::vector<SimulatedRoughing> out;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    std::vector<std::string> cells(1);
    for (const char c : line) {
      if (c == ';')
        cells.emplace_back();
      else
        cells.back() += c;
    }
    const auto measured = cells.size() == 5 ? parse_double(cells[3]) : std::nullopt;
    if (measured && *measured > 0.0)
      out.push_back({cells[0], cells[1], cells[2], *measured, parse_double(cells[4]).value_or(0.0)});
  }
  return out;
}

std::string text_of(const std::vector<SimulatedRoughing>& record) {
  std::string out = "part;material;path;measured_s;predicted_s\n";
  for (const SimulatedRoughing& s : record)
    out += s.part + ";" + s.material + ";" + s.path + ";" + fixed(s.measured_s, 3) + ";" +
           fixed(s.predicted_s, 3) + "\n";
  return out;
}

}  // namespace capstan::validation
