#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "planner/ground/base/file.h"
#include "planner/ground/base/number.h"
#include "tests/validation/studies.h"

namespace capstan::validation {
namespace {

/// A case of bind_times_main.cpp, in words, and what is asked of its time.
struct Kind {
  const char* name;
  const char* words;
  const char* asked;
  double p50_ms = 0.0, p99_ms = 0.0;  ///< 0: nothing is asked
};
constexpr std::array<Kind, 5> kKinds = {{
    {"length", "a drill set anew in a bound plan, all of it checked", "p50 ≤ 15, p99 ≤ 50", 15.0, 50.0},
    {"diameter", "a mill worn in a bound plan, its paths made anew", "p50 ≤ 15, p99 ≤ 50", 15.0, 50.0},
    {"next", "the next workingstep, everything open", "p99 ≤ 100", 0.0, 100.0},
    {"bracket", "the bracket, everything open", "≤ 1000", 0.0, 1000.0},
    {"first", "the first workingstep of a large plan, everything open", "≤ 200", 0.0, 200.0},
}};

struct Times {
  std::string steps;
  std::vector<double> wall_ms, cpu_ms, points;
};

/// The smallest of the sorted values that so large a share does not exceed.
double at(std::vector<double> values, double share) {
  std::sort(values.begin(), values.end());
  const auto rank = static_cast<std::size_t>(std::ceil(share * static_cast<double>(values.size())));
  return values[std::max<std::size_t>(1, rank) - 1];
}

}  // namespace

Comparison bind_times(const std::string& file) {
  Comparison out{.name = "bind-times"};
  const auto text = read_file(file);
  if (!text) {
    out.skipped = "no record of late bindings: " + text.error().message;
    return out;
  }
  const auto rows = cells_of(*text);
  std::map<std::string, Times> times;
  for (const auto& row : rows) {
    if (row.size() != 5) continue;
    Times& t = times[row[0]];
    t.steps = row[1];
    t.points.push_back(parse_double(row[2]).value_or(0.0));
    t.wall_ms.push_back(parse_double(row[3]).value_or(0.0));
    t.cpu_ms.push_back(parse_double(row[4]).value_or(0.0));
  }
  Table table{{"binding", "steps of the plan", "points bound", "turns", "CPU p50, ms", "CPU p99, ms",
               "clock p50, ms", "clock p99, ms", "asked of the clock"},
              {}};
  // Eight bins of each power of two.
  Table data{{"case", "cpu_ms", "share"}, {}};
  int kept = 0, asked = 0;
  for (std::size_t k = 0; k < kKinds.size(); ++k) {
    const Kind& kind = kKinds[k];
    const auto found = times.find(kind.name);
    if (found == times.end()) continue;
    const Times& t = found->second;
    table.rows.push_back({kind.words, t.steps, fixed(at(t.points, 0.5), 0), std::to_string(t.wall_ms.size()),
                          fixed(at(t.cpu_ms, 0.5), 1), fixed(at(t.cpu_ms, 0.99), 1),
                          fixed(at(t.wall_ms, 0.5), 1), fixed(at(t.wall_ms, 0.99), 1), kind.asked});
    for (const auto& [bound, share] : {std::pair(kind.p50_ms, 0.5), std::pair(kind.p99_ms, 0.99)}) {
      if (bound == 0.0) continue;
      ++asked;
      kept += at(t.cpu_ms, share) <= bound ? 1 : 0;
    }
    std::map<int, double> bins;
    for (const double ms : t.cpu_ms) bins[static_cast<int>(std::floor(8.0 * std::log2(ms)))] += 1.0;
    for (const auto& [bin, count] : bins)
      data.rows.push_back({std::to_string(k), fixed(std::exp2((bin + 0.5) / 8.0), 3),
                           fixed(count / static_cast<double>(t.cpu_ms.size()), 4)});
  }
  const std::string machine = rows.empty() || rows[0].size() != 2 ? "an unknown processor" : rows[0][0];
  const std::string cores = rows.empty() || rows[0].size() != 2 ? "?" : rows[0][1];
  out.headline = std::to_string(kept) + " of " + std::to_string(asked) +
                 " bounds on a binding kept in CPU time (" + machine + ")";
  out.text =
      "Machine: " + machine + ", " + cores + " processors, others at work on it.\n\n" + markdown(table);
  out.data.emplace_back("bind_times.dat", columns(data));
  return out;
}

}  // namespace capstan::validation
