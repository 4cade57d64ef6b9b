// capstan_rival_times FOLDER: runs the roughing of the pockets that FreeCAD is compared with on the machine
// that LinuxCNC simulates, ours and the fastest of FreeCAD's paths with our feeds and with one feed, and
// writes freecad.csv into FOLDER. Status 77 where LinuxCNC is absent.

#include <iostream>
#include <string>
#include <vector>

#include "planner/ground/base/file.h"
#include "tests/linuxcnc/simulator.h"
#include "tests/linuxcnc/times.h"
#include "tests/support/corpus.h"
#include "tests/support/shop.h"
#include "tests/validation/freecad/simulated.h"

namespace {

using namespace capstan;
using validation::Match;
using validation::Rival;

/// Seconds of the step on the machine; below nothing for a run that failed, and what it said.
double simulated(const model::Plan& plan, std::size_t step, std::string& said, bool& absent) {
  Job job;
  const auto program = pipeline::write_plan(plan, pipeline::Format::kLinuxCnc, job);
  const auto tools = pipeline::write_plan(plan, pipeline::Format::kToolTable, job);
  if (!program || !tools) {
    said = to_text(program ? tools.error() : program.error());
    return -1.0;
  }
  const auto record =
      linuxcnc::run({.program = *program, .tools = *tools, .offsets = linuxcnc::offsets_for(plan)});
  absent = !record.absent.empty();
  said = record.absent + record.failed;
  if (!said.empty()) return -1.0;
  const auto steps = linuxcnc::measured(*program, record);
  if (steps.size() != plan.steps.size()) {
    said = "of " + std::to_string(plan.steps.size()) + " steps " + std::to_string(steps.size()) +
           " were recorded";
  } else if (!(steps.at(step).path_s > 0.0)) {
    said = "step " + std::to_string(step + 1) + " was recorded without a move";
  } else {
    return steps.at(step).path_s;
  }
  return -1.0;
}

/// The faster of FreeCAD's two operations.
const Rival* faster(const Match& m, bool constant) {
  const Rival* a = fastest(m, false, constant);
  const Rival* b = fastest(m, true, constant);
  if (a == nullptr || b == nullptr) return a == nullptr ? b : a;
  return (constant ? a->constant_s < b->constant_s : a->scheduled_s < b->scheduled_s) ? a : b;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) {
    std::cerr << "usage: capstan_rival_times FOLDER\n";
    return 2;
  }
  std::vector<validation::SimulatedRoughing> out;
  for (const auto& c : validation::rival_cases()) {
    const auto m =
        validation::match(c, capstan::testing::source_dir() + "/examples/reference_pocket_machine.yaml");
    if (!m) return std::cerr << to_text(m.error()) << "\n", 1;
    struct Run {
      std::string name;
      const model::Plan* plan;
      double predicted_s;
    };
    std::vector<Run> runs{{validation::kOurs, &m->ours, m->ours_s}};
    if (const Rival* r = faster(*m, false))
      runs.push_back({r->name + ", our feeds", &r->scheduled, r->scheduled_s});
    if (const Rival* r = faster(*m, true))
      runs.push_back({r->name + ", one feed", &r->constant, r->constant_s});
    for (const Run& run : runs) {
      std::string said;
      bool absent = false;
      const double time_s = simulated(*run.plan, m->step, said, absent);
      if (absent) return std::cerr << said << "\n", 77;
      if (time_s < 0.0)
        return std::cerr << validation::part_name(c) << ", " << run.name << ": " << said << "\n", 1;
      out.push_back({validation::part_name(c), c.material, run.name, time_s, run.predicted_s});
      std::cerr << out.back().part << ", " << out.back().material << ", " << run.name << ": " << time_s
                << " s\n";
    }
  }
  return write_file(std::string(argv[1]) + "/freecad.csv", validation::text_of(out)) ? 0 : 1;
}
