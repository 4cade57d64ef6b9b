#pragma once

#include <optional>
#include <vector>

#include "planner/model/plan/plan.h"
#include "planner/proof/verify/findings.h"
#include "planner/proof/verify/moves.h"
#include "planner/proof/verify/plan/plan_checks.h"
#include "planner/proof/verify/program/program.h"
#include "planner/proof/verify/program/readers.h"
#include "planner/proof/verify/verify.h"

namespace capstan::verify {

/// What a program's checks look at together.
struct ProgramCase {
  const DialectReader& reader;
  const Program& program;
  const model::Plan* plan;  ///< may be null
  const model::Machine& machine;
  const std::vector<model::Cutter>& cutters;
  [[nodiscard]] const model::Cutter* cutter(int tool) const;
  /// The step a marker belongs to: position among the plan's steps, or the marker's own number.
  [[nodiscard]] Findings::Where where(const Block& b) const;
  /// Index into plan->steps for each marker; -1 unknown.
  std::vector<long> step_of_marker;
  bool has_table = false;  ///< a tool table is at hand
  /// Lines at which a probe comes into the spindle, by its call or by a macro (touches/).
  std::vector<long> probe_calls = {};
};
[[nodiscard]] ProgramCase make_case(const DialectReader& reader, const Program& program,
                                    const model::Plan* plan, const model::Machine& machine,
                                    const std::vector<model::Cutter>& cutters);

/// Whether a program writes this id so: one that is too long for a line as its hash.
[[nodiscard]] bool is_id(const std::string& written, const std::string& id);

/// The top of Z in machine coordinates.
[[nodiscard]] double top_of(const model::Machine& machine);
/// Whether the tool stands at the top of Z after the block: proven by G53, nothing moved Z since.
[[nodiscard]] bool at_top(const Block& b, const model::Machine& machine);
/// Whether a block is a rapid across in machine coordinates within the travels, with the tool at the top of Z
/// and the spindle off: as the table comes to where the piece is taken out.
[[nodiscard]] bool parks(const Block& b, const model::Machine& machine);

/// Offsets, tools, changes, compensation, restart, end: 3, 4, 5, 7, 8, 26, 27, 32.
void check_state(const ProgramCase& c, Findings& findings);
/// Cutter compensation: 25. Concave corners between lines are the control's to find; arcs are looked at here.
void check_compensation(const ProgramCase& c, Findings& findings);
/// Coolant in the text as each step wants it: 29. Through the spindle LinuxCNC has no code of its own: either
/// of M7 and M8 will do.
void check_program_coolant(const ProgramCase& c, Findings& findings);
/// The tool table against the cutters: 4, 5, 6.
void check_tool_table(const ProgramCase& c, const ToolTable& table, Findings& findings);
/// The length of a tool from the gage line, as the table has it, else the library, else the program's header;
/// nothing where nobody says it, or where offsets count from a reference.
[[nodiscard]] std::optional<double> length_of_tool(const ProgramCase& c, const ToolTable& table, int tool);
/// Lengths against what the program does with the tools, and those that its header alone tells: 6.
void check_reach(const ProgramCase& c, const ToolTable& table, Findings& findings);
/// Where no table is at hand: what a library took from one: 6.
void check_table_lines(const ProgramCase& c, Findings& findings);
/// The tools as the program's header has them, against table (may be empty) and cutters: 6.
void check_header_tools(const ProgramCase& c, const ToolTable& table, Findings& findings);
/// The tools that the program's header names, for a check with neither plan, table nor library.
[[nodiscard]] std::vector<model::Cutter> tools_of_header(const Program& program);
/// What the text asks of the machine: tapping in step with the spindle (22), room for its tools (4, 6).
void check_abilities(const ProgramCase& c, Findings& findings);
/// The work offset of each step against the plan's, or the header's: 3. A stop before each other set-up, with
/// the tool away, spindle and coolant off: 31.
void check_setups(const ProgramCase& c, Findings& findings);
/// What the program tells whoever clamps the piece and loads the tools, against the plan: 3, 4, 33
/// (told/told.cpp).
void check_told(const ProgramCase& c, Findings& findings);
/// Notes what a program alone cannot be held against. `sweeps`: moves cut the raw piece that its header says.
void say_unjudged(const ProgramCase& c, bool sweeps, Findings& findings);
/// Machine coordinates against the travel: 22.
void check_machine_moves(const ProgramCase& c, Findings& findings);
/// The text against the plan: moves, dwells, feeds, speeds, state and tool of each step, in its order: 33,
/// 4, 5.
void compare(const ProgramCase& c, Findings& findings);
/// What the text does between two steps, against the plan: changes of tools, stops, other codes: 4, 31, 33.
void check_between(const ProgramCase& c, Findings& findings);
/// `check_program` without what the moves remove: a few milliseconds.
[[nodiscard]] std::vector<model::Finding> check_program_text(const ProgramText& text, const model::Plan* plan,
                                                             const model::Machine& machine,
                                                             const std::vector<model::Cutter>& cutters);
/// The program's moves by step, in the set-up's frame; heights that are not known are taken as clear.
[[nodiscard]] std::vector<StepMoves> moves_of(const ProgramCase& c);

}  // namespace capstan::verify
