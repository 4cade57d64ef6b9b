#include "tests/examples/linuxcnc/scenarios.h"

#include <sys/wait.h>

#include <cstdlib>
#include <sstream>
#include <tuple>
#include <utility>

#include "planner/ground/base/number.h"
#include "tests/support/corpus.h"

namespace capstan::linuxcnc {
namespace {

constexpr int kAbsent = 77;  // simulated.py

/// The exit status; what was said goes into the file.
int exit_of(const std::string& command, const std::string& said) {
  const int status = std::system((command + " > '" + said + "' 2>&1 < /dev/null").c_str());
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

std::map<std::string, Outcome> read_outcomes(const std::string& text) {
  std::map<std::string, Outcome> out;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    const auto first = line.find('\t'), second = line.find('\t', first + 1);
    Outcome& o = out[line.substr(0, first)];
    const std::string what = line.substr(first + 1, second - first - 1), value = line.substr(second + 1);
    const double number = parse_double(value).value_or(0.0);
    if (what == "said") o.said.push_back(value);
    if (what == "bound") o.bound.push_back(static_cast<int>(number));
    if (what == "cut") o.cut.push_back(static_cast<int>(number));
    if (what == "bound_id") o.bound_ids.push_back(value);
    if (what == "bound_tool") o.bound_tools.push_back(static_cast<int>(number));
    if (what == "diameter") o.diameter_mm = number;
    if (what == "decided") o.decided.push_back(value);
    if (what == "cannot") o.cannot = value;
    if (what == "mark") o.mark = static_cast<int>(number);
    if (what == "tool") o.tool = static_cast<int>(number);
    if (what == "rpm") o.rpm = number;
    if (what == "x") o.x_mm = number;
    if (what == "y") o.y_mm = number;
    if (what == "z") o.z_mm = number;
  }
  return out;
}

Scenarios run_all() {
  const testing::ScratchFolder folder;
  const std::string root = capstan::testing::source_dir(), said = folder.file("said.txt");
  const std::string machine = "'" + root + "/examples/reference_pocket_machine.yaml'";
  Scenarios out;
  // Tools and paths' strategy are chosen at the desk, speeds and feeds at the machine.
  const std::string mill = root + "/examples/reference_pocket_tools.yaml",
                    magazine = root + "/examples/bracket_magazine.tbl";
  for (const auto& [part, tools, plan] :
       {std::tuple(std::string("reference_pocket.p21"), mill, "plan.json"),
        std::tuple(std::string("linuxcnc/spring_pass.p21"), mill, "while_plan.json"),
        std::tuple(std::string("bracket.p21"), magazine, "bracket_plan.json")}) {
    if (exit_of("'" CAPSTAN_COMMAND "' plan '" + root + "/examples/" + part + "' --bind tools --machine " +
                    machine + " --tools '" + tools + "' -o '" + folder.file(plan) + "'",
                said) != 0) {
      out.failed = testing::slurp(said);
      return out;
    }
  }
  const int code =
      exit_of("/usr/bin/python3 '" + root +
                  "/tests/examples/linuxcnc/scenarios.py' --library '" CAPSTAN_LATE_LIBRARY
                  "' --clock '" CAPSTAN_FAST_CLOCK "' --machine " +
                  machine + " --plan '" + folder.file("plan.json") + "' --while-plan '" +
                  folder.file("while_plan.json") + "' --bracket-plan '" + folder.file("bracket_plan.json") +
                  "' --bracket-tools '" + magazine + "' --out '" + folder.path() + "'",
              said);
  if (code != 0) {
    (code == kAbsent || code == 127 ? out.absent : out.failed) = testing::slurp(said);
    return out;
  }
  out.outcomes = read_outcomes(testing::slurp(folder.file("outcomes.txt")));
  // What was cut becomes cases, as the example's README says it.
  const std::string log = "'" + folder.file("log.csv") + "'", base = "'" + folder.file("shop.db") + "'",
                    plan = "'" + folder.file("all_there.json") + "'";
  out.cases_failed =
      exit_of("{ /usr/bin/python3 -B '" + root + "/examples/linuxcnc/cases.py' '" +
                  folder.file("all_there.txt") + "' '" + folder.file("all_there.jsonl") + "' > " + log +
                  " && '" CAPSTAN_COMMAND "' cases import " + base + " csv " + log + " --plan " + plan +
                  " && '" CAPSTAN_COMMAND "' cases trace " + base + " " + plan + "; }",
              said) != 0;
  out.cases = testing::slurp(said);
  exit_of("/usr/bin/python3 -B '" + root + "/examples/linuxcnc/cases.py' '" + folder.file("power_lost.txt") +
              "' '" + folder.file("power_lost.jsonl") + "'",
          said);
  out.cases_of_power_lost = testing::slurp(said);
  out.broadcast = testing::slurp(folder.file("broadcast.jsonl"));
  out.failed = read_samples(testing::slurp(folder.file("samples.txt")), out.record);
  if (out.failed.empty()) out.failed = read_samples(testing::slurp(folder.file("all_there.txt")), out.first);
  return out;
}

}  // namespace

void add_sample(const Record& from, std::size_t sample, Record& to) {
  to.x_mm.push_back(from.x_mm[sample]);
  to.y_mm.push_back(from.y_mm[sample]);
  to.z_mm.push_back(from.z_mm[sample]);
  to.speed_mm_s.push_back(from.speed_mm_s[sample]);
  to.line.push_back(from.line[sample]);
  to.rpm.push_back(from.rpm[sample]);
  to.tool.push_back(from.tool[sample]);
  to.mark.push_back(from.mark[sample]);
  to.lag_mm.push_back(from.lag_mm[sample]);
  to.kind.push_back(from.kind[sample]);
}

std::vector<Record> workingsteps(const Record& record, int mark) {
  std::vector<Record> out;
  Record now;
  bool turned = false;
  for (std::size_t s = 0; s < record.size(); ++s) {
    if (record.mark[s] != mark) continue;
    add_sample(record, s, now);
    turned |= record.rpm[s] != 0.0;
    if (record.rpm[s] != 0.0 || record.z_mm[s] < kRetracted - 1e-6) continue;
    if (turned) out.push_back(std::move(now));
    now = {};
    turned = false;
  }
  return out;
}

const Scenarios& scenarios() {
  static const Scenarios kAll = run_all();
  return kAll;
}

}  // namespace capstan::linuxcnc
