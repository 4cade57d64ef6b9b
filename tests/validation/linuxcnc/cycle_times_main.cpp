// capstan_cycle_times FOLDER [DATA]: plans parts with the built command, runs the programs on the machine
// that LinuxCNC simulates, and writes cycle_times.csv (program, step, measured_s, predicted_s; the step "all"
// is the whole program with the ways between steps; predicted 0: it is not) into FOLDER, and what the
// reference pocket did into DATA. Status 77 where LinuxCNC is absent.

#include <iostream>
#include <string>
#include <vector>

#include "planner/ground/base/file.h"
#include "planner/ground/base/number.h"
#include "tests/linuxcnc/reference.h"

namespace {

using namespace capstan;
using namespace capstan::linuxcnc;

struct Program {
  const char* name;
  std::vector<std::string> arguments;
};

void add(const std::string& name, const std::vector<StepSeconds>& steps, const Predicted& foreseen,
         const Comparison& all, std::string& out) {
  const auto row = [&](const std::string& step, double measured_s, double predicted_s) {
    out += name + "," + step + "," + fixed(measured_s, 3) + "," + fixed(predicted_s, 3) + "\n";
  };
  for (std::size_t i = 0; i < std::min(steps.size(), foreseen.steps.size()); ++i) {
    row(foreseen.steps[i].id, steps[i].path_s, foreseen.steps[i].path_s);
  }
  row("all", all.measured_s, all.predicted_s);
}

/// 0, 1, or 77 where LinuxCNC is absent.
int add_program(const Program& program, std::string& out) {
  const Planned p = plan(program.arguments);
  if (!p.failed.empty()) return std::cerr << p.failed << "\n", 1;
  const Record r = run({.program = p.program, .tools = p.tools, .offsets = offsets_for(p.plan)});
  if (!r.absent.empty()) return std::cerr << r.absent << "\n", 77;
  if (!r.failed.empty()) return std::cerr << r.failed << "\n", 1;
  const auto foreseen = predicted(p.plan);
  if (!foreseen) return std::cerr << to_text(foreseen.error()) << "\n", 1;
  const auto steps = measured(p.program, r);
  for (std::size_t i = 0; i < std::min(steps.size(), foreseen->steps.size()); ++i) {
    if (steps[i].path_s > 0.0 || !(foreseen->steps[i].path_s > 0.0)) continue;
    return std::cerr << program.name << ": step '" << foreseen->steps[i].id << "' did not move\n", 1;
  }
  add(program.name, steps, *foreseen, compare(steps, *foreseen), out);
  return 0;
}

int add_reference(const std::string& data, std::string& out) {
  const Reference r = reference();
  if (!r.failed().empty()) return std::cerr << r.failed() << "\n", 1;
  if (!r.absent().empty()) return std::cerr << r.absent() << "\n", 77;
  for (const auto& [name, run] :
       {std::pair<const char*, const ReferenceRun&>{"pocket-scheduled", r.scheduled},
        std::pair<const char*, const ReferenceRun&>{"pocket-constant", r.constant}}) {
    const auto foreseen = predicted(run.planned.plan);
    if (!foreseen) return std::cerr << to_text(foreseen.error()) << "\n", 1;
    add(name, run.measured, *foreseen, run.time, out);
  }
  // Not planned so, hence not predicted.
  out += "pocket-one-feed,feed_mm_min," + fixed(r.one_feed_mm_min, 1) + ",0\n";
  out += "pocket-one-feed,all," + fixed(r.one_feed.time.measured_s, 3) + ",0\n";
  for (const auto& [name, content] : tables(r)) {
    if (!data.empty() && !write_file(data + "/" + name, content)) return 1;
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) {
    std::cerr << "usage: capstan_cycle_times FOLDER [DATA]\n";
    return 2;
  }
  std::string out = "program,step,measured_s,predicted_s\n";
  const Program programs[] = {
      {"bracket", {"examples/bracket.p21", "--machine", "linuxcnc_axis_mm"}},
      {"surface", {"examples/surface.stl", "--material", "EN AW-6061", "--machine", "linuxcnc_axis_mm"}}};
  for (const Program& p : programs) {
    if (const int status = add_program(p, out); status != 0) return status;
  }
  if (const int status = add_reference(argc > 2 ? argv[2] : "", out); status != 0) return status;
  return write_file(std::string(argv[1]) + "/cycle_times.csv", out) ? 0 : 1;
}
