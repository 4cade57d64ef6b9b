#include <optional>

#include "planner/ground/base/stopping.h"
#include "planner/proof/verify/plan/plan_checks.h"
#include "planner/proof/verify/program/program_checks.h"
#include "planner/proof/verify/program/readers.h"
#include "planner/proof/verify/stopped.h"
#include "planner/proof/verify/sweep/sweep.h"
#include "planner/proof/verify/sweep/target/target.h"
#include "planner/proof/verify/told/raw_piece.h"
#include "planner/proof/verify/touches/macros.h"
#include "planner/proof/verify/touches/probed.h"
#include "planner/proof/verify/verify.h"

namespace capstan::verify {
namespace {

/// The program, and what is told apart of it: the touches of the piece that it makes.
struct ReadText {
  WithoutMacros macros;
  Program program;
  std::vector<Probed> probed;
};

/// What the text says and does, the removal of stock left out but for that of a program alone, where asked
/// for (`sweeps`). Gives the moves by step.
std::vector<StepMoves> judge_text(const DialectReader& reader, const ReadText& read, const ProgramText& text,
                                  const model::Plan* plan, const model::Machine& machine,
                                  const std::vector<model::Cutter>& cutters, bool sweeps,
                                  Findings& findings) {
  const Program& program = read.program;
  ProgramCase c = make_case(reader, program, plan, machine, cutters);
  for (const MacroTouch& t : read.macros.touches) c.probe_calls.push_back(t.first);
  for (const Probed& p : read.probed) c.probe_calls.push_back(p.blocks.front().line);
  c.has_table = !text.tool_table.empty() && reader.tool_table != nullptr;
  for (const ReaderFault& f : program.faults) {
    std::size_t order = 1;
    std::string id;
    for (std::size_t m = 0; m < program.markers.size() && program.markers[m].line <= f.line; ++m) {
      order = m + 2;
      id = program.markers[m].id;
    }
    // A program of this plan has nothing in it that cannot be followed.
    if (f.undecided && plan == nullptr) {
      findings.unproved(Severity::kWarning, f.property, f.code, {order, id, f.line}, f.message);
    } else {
      findings.error(f.property, f.code, {order, id, f.line}, f.message);
    }
  }
  check_state(c, findings);
  check_compensation(c, findings);
  check_program_coolant(c, findings);
  check_setups(c, findings);
  check_told(c, findings);
  ToolTable table;
  if (c.has_table) {
    table = reader.tool_table(text.tool_table);
    check_tool_table(c, table, findings);
  } else {
    check_table_lines(c, findings);
  }
  check_header_tools(c, table, findings);
  check_reach(c, table, findings);
  check_abilities(c, findings);
  say_unjudged(c, sweeps, findings);
  check_machine_moves(c, findings);
  const std::vector<StepMoves> steps = moves_of(c);
  Extents extents(machine);
  for (const StepMoves& s : steps) {
    check_moves(s, machine, kRadiusGapMm, findings);
    extents.add(s, findings);
  }
  check_life(steps, findings);
  if (const auto raw = told_raw(program); raw && sweeps && plan == nullptr)
    check_told_raw(c, *raw, steps, findings);
  if (plan != nullptr && program.markers.empty() && !plan->steps.empty()) {
    findings.error(33, "CHK-TEXT-MARKERS", {0, "", -1},
                   "no comment (CAPSTAN STEP ...) says which step begins where, so the text cannot be held "
                   "against the plan; write the program anew from the plan, or check it without");
  } else if (plan != nullptr) {
    compare(c, findings);
    check_between(c, findings);
    check_macros(c, read.macros.touches, findings);
  }
  check_probed(c, read.probed, table, findings);
  return steps;
}

/// Readers get the text without the macros of the shop that a plan's touches are made by; moves that touch
/// are taken out of what they read.
ReadText read_text(const DialectReader& reader, const ProgramText& text, const model::Plan* plan,
                   const model::Machine& machine, const std::vector<model::Cutter>& cutters) {
  ReadText out;
  out.macros = plan != nullptr ? without_macros(text.text, *plan) : WithoutMacros{std::string(text.text), {}};
  out.program = reader.program(out.macros.text, machine);
  out.probed = take_probed(out.program, plan, cutters);
  return out;
}

/// The reader for the machine's control. Without one nothing of the program is proved, which is a finding.
const DialectReader* reader_for(const model::Machine& machine, Findings& findings) {
  const DialectReader* reader = reader_of(machine.control.dialect);
  if (reader == nullptr)
    findings.error(33, "CHK-TEXT-DIALECT", {0, "", -1},
                   "programs of the control '" + machine.control.dialect + "' of machine '" + machine.id +
                       "' cannot be read back, so that nothing of this one is proved; name a machine with "
                       "another control");
  return reader;
}

}  // namespace

std::vector<model::Finding> check_program_text(const ProgramText& text, const model::Plan* plan,
                                               const model::Machine& machine,
                                               const std::vector<model::Cutter>& cutters) {
  Findings findings;
  const DialectReader* reader = reader_for(machine, findings);
  if (reader == nullptr) return findings.take();
  const ReadText read = read_text(*reader, text, plan, machine, cutters);
  const bool none = plan == nullptr && cutters.empty() && text.tool_table.empty();
  (void)judge_text(*reader, read, text, plan, machine, none ? tools_of_header(read.program) : cutters, false,
                   findings);
  return findings.take();
}

std::vector<model::Finding> check_program(const ProgramText& text, const model::Plan* plan,
                                          const model::Machine& machine,
                                          const std::vector<model::Cutter>& cutters, Job& job,
                                          memo::Memo* known, const CutBefore* before, const ReadPart* part) {
  Findings findings;
  const DialectReader* reader = reader_for(machine, findings);
  if (reader == nullptr) return findings.take();
  check_to_its_end(job, findings, [&] {
    const ReadText read = read_text(*reader, text, plan, machine, cutters);
    poll();
    // Moves refer to the cutters.
    const bool none = plan == nullptr && cutters.empty() && text.tool_table.empty();
    const std::vector<model::Cutter> tools = none ? tools_of_header(read.program) : cutters;
    const std::vector<StepMoves> steps =
        judge_text(*reader, read, text, plan, machine, tools, true, findings);
    poll();
    if (plan != nullptr) {
      std::optional<ReadPart> here;
      if (part == nullptr) part = &here.emplace(read_part(*plan, known != nullptr));
      poll();
      if (!check_removal(*plan, *part, steps, findings, job, nullptr, known, before)) return false;
    }
    job.progress("check", 1.0);
    return true;
  });
  return findings.take();
}

}  // namespace capstan::verify
