#include "tests/linuxcnc/planned.h"

#include <sys/wait.h>

#include <cstdlib>

#include "planner/files/json/json.h"
#include "planner/ground/base/job.h"
#include "tests/support/corpus.h"

namespace capstan::linuxcnc {

Planned plan(const std::vector<std::string>& arguments) {
  const testing::ScratchFolder folder;
  Planned out;
  std::string command = "cd '" + capstan::testing::source_dir() + "' && '" CAPSTAN_COMMAND "' plan";
  for (const std::string& a : arguments) command += " '" + a + "'";
  for (const char* kind : {"json", "ngc", "tbl"}) command += " -o '" + folder.file("out.") + kind + "'";
  command += " > '" + folder.file("said.txt") + "' 2>&1 < /dev/null";
  const int status = std::system(command.c_str());
  // 1: done, with findings
  if (!WIFEXITED(status) || WEXITSTATUS(status) > 1) {
    out.failed = command + "\n" + testing::slurp(folder.file("said.txt"));
    return out;
  }
  Job job;
  auto read = json::read_json(testing::slurp(folder.file("out.json")), "out.json", job);
  if (!read) {
    out.failed = to_text(read.error());
    return out;
  }
  out.plan = *std::move(read);
  out.program = testing::slurp(folder.file("out.ngc"));
  out.tools = testing::slurp(folder.file("out.tbl"));
  return out;
}

}  // namespace capstan::linuxcnc
