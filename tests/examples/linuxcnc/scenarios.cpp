#include "tests/examples/linuxcnc/scenarios.h"

#include <sys/wait.h>

#include <cstdlib>
#include <sstream>

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
  if (exit_of("'" CAPSTAN_COMMAND "' plan '" + root +
                  "/examples/reference_pocket.p21' --bind tools --machine " + machine + " --tools '" + root +
                  "/examples/reference_pocket_tools.yaml' -o '" + folder.file("plan.json") + "'",
              said) != 0) {
    out.failed = testing::slurp(said);
    return out;
  }
  const int code =
      exit_of("/usr/bin/python3 '" + root +
                  "/tests/examples/linuxcnc/scenarios.py' --library '" CAPSTAN_LATE_LIBRARY
                  "' --clock '" CAPSTAN_FAST_CLOCK "' --machine " +
                  machine + " --plan '" + folder.file("plan.json") + "' --out '" + folder.path() + "'",
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
  out.failed = read_samples(testing::slurp(folder.file("samples.txt")), out.record);
  return out;
}

}  // namespace

const Scenarios& scenarios() {
  static const Scenarios kAll = run_all();
  return kAll;
}

}  // namespace capstan::linuxcnc
