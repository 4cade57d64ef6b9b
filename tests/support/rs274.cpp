#include "tests/support/rs274.h"

#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <sstream>

#include "planner/ground/base/file.h"
#include "planner/ground/base/number.h"
#include "tests/support/corpus.h"

namespace capstan::testing {
namespace {

constexpr const char* kInterpreter = "/usr/bin/rs274";

// "   12 N..... NAME(arguments)"; where the block has a number, "   12 N10    NAME(arguments)"
void parse_call(const std::string& line, std::vector<CanonCall>& out) {
  const auto n = line.find_first_not_of(" 0123456789");
  const auto open = line.find('(');
  const auto close = line.rfind(')');
  if (n == std::string::npos || line[n] != 'N' || open == std::string::npos || close == std::string::npos ||
      open < n + 7)
    return;
  CanonCall call;
  call.name = line.substr(n + 7, open - n - 7);
  call.text = line.substr(open + 1, close - open - 1);
  std::string arguments = call.text;
  std::replace(arguments.begin(), arguments.end(), ',', ' ');
  std::istringstream words(arguments);
  for (std::string word; words >> word;) {
    if (const auto v = parse_double(word)) call.numbers.push_back(*v);
  }
  out.push_back(std::move(call));
}

}  // namespace

std::vector<CanonCall> Rs274Run::only(const std::vector<std::string>& names) const {
  std::vector<CanonCall> out;
  for (const CanonCall& c : calls) {
    if (std::find(names.begin(), names.end(), c.name) != names.end()) out.push_back(c);
  }
  return out;
}

bool rs274_available() { return ::access(kInterpreter, X_OK) == 0; }

Rs274Run run_rs274(const std::string& tool_table, const std::string& program) {
  const ScratchFolder folder;
  Rs274Run run;
  EXPECT_TRUE(write_file(folder.file("out.tbl"), tool_table));
  EXPECT_TRUE(write_file(folder.file("out.ngc"), program));
  // It writes its parameters into the working directory, and shares its tool table with others of the same
  // HOME.
  const std::string command = "cd '" + folder.path() + "' && HOME='" + folder.path() + "' '" + kInterpreter +
                              "' -t out.tbl -g out.ngc > out.txt 2>&1 < /dev/null";
  const int status = std::system(command.c_str());
  run.status = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  run.output = slurp(folder.file("out.txt"));
  std::istringstream lines(run.output);
  for (std::string line; std::getline(lines, line);) parse_call(line, run.calls);
  return run;
}

}  // namespace capstan::testing
