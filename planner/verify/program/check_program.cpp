#include <map>

#include "planner/verify/plan/plan_checks.h"
#include "planner/verify/program/program_checks.h"
#include "planner/verify/sweep/sweep.h"
#include "planner/verify/verify.h"

namespace capstan::verify {
namespace {

/// Extents of the program's moves in one work offset: 22.
void check_extents(const ProgramCase& c, const std::vector<StepMoves>& steps, Findings& findings) {
  std::map<std::size_t, geometry::Box3> boxes;
  for (const StepMoves& s : steps) {
    for (const Move& m : s.moves) {
      const geometry::Box3 b = box_of(m);
      if (b.hi.z > 9e4) continue;
      boxes[s.setup].add(b.lo);
      boxes[s.setup].add(b.hi);
    }
  }
  for (const auto& [setup, box] : boxes) {
    const geometry::Vec3 size = box.size();
    const double lengths[3] = {size.x, size.y, size.z};
    for (std::size_t a = 0; a < 3; ++a) {
      const model::LinearAxis& axis = c.machine.axes[a];
      const double travel = axis.travel_max_mm - axis.travel_min_mm;
      if (travel > 0.0 && lengths[a] > travel + 1e-6) {
        findings.error(22, "CHK-TRAVEL-" + axis.name, {0, "", -1},
                       "the moves span " + mm(lengths[a]) + " in " + axis.name +
                           ", arcs included; the axis travels " + mm(travel));
      }
    }
  }
}

}  // namespace

std::vector<model::Finding> check_program(const ProgramText& text, const model::Plan* plan,
                                          const model::Machine& machine,
                                          const std::vector<model::Cutter>& cutters, Job& job) {
  Findings findings;
  const Program program = read_program(text.text);
  const ProgramCase c = make_case(program, plan, machine, cutters);
  for (const ReaderFault& f : program.faults) {
    std::size_t order = 1;
    std::string id;
    for (std::size_t m = 0; m < program.markers.size() && program.markers[m].line <= f.line; ++m) {
      order = m + 2;
      id = program.markers[m].id;
    }
    if (f.undecided) {
      findings.warn(f.property, f.code, {order, id, f.line}, f.message);
    } else {
      findings.error(f.property, f.code, {order, id, f.line}, f.message);
    }
  }
  check_state(c, findings);
  if (!text.tool_table.empty()) check_tool_table(c, read_tool_table(text.tool_table), findings);
  check_machine_moves(c, findings);
  const std::vector<StepMoves> steps = moves_of(c);
  for (const StepMoves& s : steps) check_moves(s, machine, kRadiusGapMm, findings);
  check_extents(c, steps, findings);
  if (plan != nullptr) {
    compare(c, findings);
    check_removal(*plan, steps, findings, job);
  }
  job.progress("check", 1.0);
  return findings.take();
}

}  // namespace capstan::verify
