#include "tests/kept/table.h"

#include <algorithm>
#include <fstream>
#include <sstream>

#include "planner/ground/base/number.h"

namespace capstan::kept {

namespace {
constexpr std::string_view kProcessor = "# processor: ", kCounter = "# counted by: ";

/// What stands behind `key` on its line; empty where the text has no such line.
std::string behind(std::string_view text, std::string_view key) {
  const auto at = text.find(key);
  if (at == text.npos) return {};
  const auto from = at + key.size();
  return std::string(text.substr(from, text.find('\n', from) - from));
}

bool comparable(const Cost& a, const Cost& b) {
  return (a.instructions_1e6 && b.instructions_1e6) || (a.time && b.time);
}

std::string cell(const std::optional<double>& value) { return value ? trimmed(*value, 4) : "-"; }

/// A cell's value: a number above 0, or "-" for nothing. False: neither.
bool read_cell(const std::string& text, std::optional<double>& value) {
  if (text == "-") return true;
  const auto number = parse_double(text);
  if (!number || !(*number > 0.0)) return false;
  value = *number;
  return true;
}

}  // namespace

std::string processor() {
  std::ifstream info("/proc/cpuinfo");
  for (std::string line; std::getline(info, line);) {
    if (line.starts_with("model name") && line.find(": ") != line.npos)
      return line.substr(line.find(": ") + 2);
  }
  return "unknown";
}

std::string write(const Table& table) {
  std::string out =
      "# What pieces of work cost (tests/kept/README.md): CPU time in units of the reference\n"
      "# kernel of the same run, and millions of instructions.\n"
      "# Written by ./dev bench --take; held by ./dev bench --check and ./dev test.\n";
  out += std::string(kProcessor) + table.processor + "\n" + std::string(kCounter) + table.counter +
         "\n# row                     time        instructions\n";
  for (const Cost& c : table.costs) {
    std::string line = c.row;
    line.resize(std::max<std::size_t>(line.size() + 1, 26), ' ');
    line += cell(c.time);
    line.resize(std::max<std::size_t>(line.size() + 1, 38), ' ');
    out += line + cell(c.instructions_1e6) + "\n";
  }
  return out;
}

Result<Table> read(std::string_view text, const std::string& name) {
  Table out{behind(text, kProcessor), behind(text, kCounter), {}};
  std::istringstream lines{std::string(text)};
  std::string line;
  for (std::uint64_t n = 1; std::getline(lines, line); ++n) {
    line = line.substr(0, line.find('#'));
    std::istringstream words(line);
    std::string row, time, instructions, more;
    if (!(words >> row)) continue;
    words >> time >> instructions;
    Cost cost{row, std::nullopt, std::nullopt};
    if (!read_cell(time, cost.time) || !read_cell(instructions, cost.instructions_1e6) || words >> more)
      return fail({.code = "KEPT-TABLE",
                   .message = "this line is no row of the table",
                   .file = name,
                   .line = n,
                   .expected = "a name, a time and instructions, each above 0 or '-'"});
    out.costs.push_back(std::move(cost));
  }
  return out;
}

std::optional<std::string> fault(const Cost& measured, const std::vector<Cost>& table) {
  const auto at =
      std::find_if(table.begin(), table.end(), [&](const Cost& c) { return c.row == measured.row; });
  const std::string renew = "`./dev bench --take` writes the table anew";
  if (at == table.end()) return measured.row + ": the table has no such row; " + renew;
  if (!comparable(measured, *at)) return std::nullopt;
  const bool counted = measured.instructions_1e6 && at->instructions_1e6;
  const double now = counted ? *measured.instructions_1e6 : *measured.time;
  const double then = counted ? *at->instructions_1e6 : *at->time;
  const double limit = counted ? kInstructionLimit : kTimeLimit;
  if (now <= then * (1.0 + limit)) return std::nullopt;
  return measured.row + ": " + trimmed(now, 4) +
         (counted ? " million instructions" : " times the reference kernel's time") + ", the table has " +
         trimmed(then, 4) + " (" + trimmed(100.0 * (now / then - 1.0), 0) + " % more; the limit is " +
         trimmed(100.0 * limit, 0) + " %). Find what made it slower; if it is meant to be, " + renew;
}

std::vector<std::string> not_judged(const std::vector<Cost>& measured, const std::vector<Cost>& table) {
  std::vector<std::string> out;
  for (const Cost& m : measured) {
    const auto same = [&](const Cost& t) { return t.row == m.row && !comparable(m, t); };
    if (std::any_of(table.begin(), table.end(), same)) out.push_back(m.row);
  }
  return out;
}

}  // namespace capstan::kept
