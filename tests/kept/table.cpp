#include "tests/kept/table.h"

#include <algorithm>
#include <fstream>
#include <sstream>

#include "planner/ground/base/number.h"

namespace capstan::kept {

namespace {
constexpr std::string_view kProcessor = "# processor: ";
}

std::string processor() {
  std::ifstream info("/proc/cpuinfo");
  for (std::string line; std::getline(info, line);) {
    if (line.starts_with("model name") && line.find(": ") != line.npos)
      return line.substr(line.find(": ") + 2);
  }
  return "unknown";
}

std::string processor_of(std::string_view text) {
  const auto at = text.find(kProcessor);
  if (at == text.npos) return {};
  const auto from = at + kProcessor.size();
  return std::string(text.substr(from, text.find('\n', from) - from));
}

std::string write(const std::vector<Cost>& costs) {
  std::string out = std::string(
                        "# What pieces of work cost, in units of the reference kernel of the same run "
                        "(tests/kept/README.md).\n"
                        "# Written by ./dev bench --take; held by ./dev bench --check.\n") +
                    std::string(kProcessor) + processor() +
                    "\n# row                     time        instructions\n";
  for (const Cost& c : costs) {
    std::string line = c.row;
    line.resize(std::max<std::size_t>(line.size() + 1, 26), ' ');
    line += trimmed(c.time, 4);
    line.resize(std::max<std::size_t>(line.size() + 1, 38), ' ');
    out += line + (c.instructions ? trimmed(*c.instructions, 4) : "-") + "\n";
  }
  return out;
}

Result<std::vector<Cost>> read(std::string_view text, const std::string& name) {
  std::vector<Cost> out;
  std::istringstream lines{std::string(text)};
  std::string line;
  for (std::uint64_t n = 1; std::getline(lines, line); ++n) {
    line = line.substr(0, line.find('#'));
    std::istringstream words(line);
    std::string row, time, instructions, more;
    if (!(words >> row)) continue;
    words >> time >> instructions;
    const auto t = parse_double(time);
    const auto i = parse_double(instructions);
    const bool counted = instructions != "-";
    if (!t || !(*t > 0.0) || (counted && (!i || !(*i > 0.0))) || words >> more)
      return fail({.code = "KEPT-TABLE",
                   .message = "this line is no row of the table",
                   .file = name,
                   .line = n,
                   .expected = "a name, a time above 0, and instructions above 0 or '-'"});
    out.push_back({row, *t, counted ? std::optional<double>(*i) : std::nullopt});
  }
  return out;
}

std::optional<std::string> fault(const Cost& measured, const std::vector<Cost>& table, double limit) {
  const auto at =
      std::find_if(table.begin(), table.end(), [&](const Cost& c) { return c.row == measured.row; });
  const std::string renew = "`./dev bench --take` writes the table anew";
  if (at == table.end()) return measured.row + ": the table has no such row; " + renew;
  const bool counted = measured.instructions && at->instructions;
  const double now = counted ? *measured.instructions : measured.time;
  const double then = counted ? *at->instructions : at->time;
  if (now <= then * (1.0 + limit)) return std::nullopt;
  return measured.row + ": " + trimmed(now, 4) + " times the reference kernel's " +
         (counted ? "instructions" : "time") + ", the table has " + trimmed(then, 4) + " (" +
         trimmed(100.0 * (now / then - 1.0), 0) + " % more; the limit is " + trimmed(100.0 * limit, 0) +
         " %). Find what made it slower; if it is meant to be, " + renew;
}

}  // namespace capstan::kept
