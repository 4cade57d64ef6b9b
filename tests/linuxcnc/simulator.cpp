#include "tests/linuxcnc/simulator.h"

#include <sys/wait.h>

#include <cstdlib>
#include <string_view>

#include "planner/ground/base/file.h"
#include "planner/ground/base/number.h"
#include "tests/support/corpus.h"

namespace capstan::linuxcnc {
namespace {

constexpr int kAbsent = 77;

std::string quoted(const std::string& path) { return "'" + path + "'"; }

// The next word of the text, and what follows it.
std::string_view word(std::string_view& text) {
  const auto from = std::min(text.find_first_not_of(' '), text.size());
  const auto to = std::min(text.find(' ', from), text.size());
  const std::string_view out = text.substr(from, to - from);
  text.remove_prefix(to);
  return out;
}

}  // namespace

// "number x y z speed line rpm tool mark" per row. A gap in the numbers is time that nobody saw.
std::string read_samples(std::string_view text, Record& out) {
  double expected = -1.0;
  while (!text.empty()) {
    const auto end = std::min(text.find('\n'), text.size());
    std::string_view row = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    double values[11] = {};
    for (double& v : values) {
      const auto number = parse_double(word(row));
      if (!number) return "samples were lost";
      v = *number;
    }
    if (expected >= 0.0 && values[0] != expected) return "samples were lost";
    expected = values[0] + 1.0;
    out.x_mm.push_back(values[1]);
    out.y_mm.push_back(values[2]);
    out.z_mm.push_back(values[3]);
    out.speed_mm_s.push_back(values[4]);
    out.line.push_back(static_cast<int>(values[5]));
    out.rpm.push_back(values[6]);
    out.tool.push_back(static_cast<int>(values[7]));
    out.mark.push_back(static_cast<int>(values[8]));
    out.lag_mm.push_back(values[9]);
    out.kind.push_back(static_cast<int>(values[10]));
  }
  return out.size() == 0 ? "there are no samples" : "";
}

Record run(const Order& order) {
  const testing::ScratchFolder folder;
  Record out;
  if (!write_file(folder.file("program.ngc"), order.program) ||
      !write_file(folder.file("tools.tbl"), order.tools)) {
    out.failed = "cannot write into " + folder.path();
    return out;
  }
  // The system's own Python: LinuxCNC's module is built for that one.
  std::string command = "/usr/bin/python3 " + capstan::testing::source_dir() +
                        "/tests/linuxcnc/run.py --clock " CAPSTAN_FAST_CLOCK " --program " +
                        quoted(folder.file("program.ngc")) + " --tools " + quoted(folder.file("tools.tbl")) +
                        " --samples " + quoted(folder.file("samples.txt")) + " --rate " +
                        trimmed(order.rate, 3);
  for (const std::string& o : order.offsets) command += " --offset " + quoted(o);
  command += " > " + quoted(folder.file("said.txt")) + " 2>&1 < /dev/null";
  const int status = std::system(command.c_str());
  const int code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  if (code != 0) {
    (code == kAbsent || code == 127 ? out.absent : out.failed) = testing::slurp(folder.file("said.txt"));
    return out;
  }
  std::string samples = testing::slurp(folder.file("samples.txt"));
  out.failed = read_samples(samples, out);
  if (order.keep_samples) out.samples = std::move(samples);
  return out;
}

}  // namespace capstan::linuxcnc
