#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "planner/model/plan/cutter/table_offsets.h"
#include "planner/proof/verify/program/program_checks.h"

// The tool table against the program, and against the tools as plan or library have them. That a table and a
// program's header say the same of a length proves nothing of either: a tool whose offset cannot be a length
// is found whoever else says so.

namespace capstan::verify {
namespace {

/// A holder's flange stands between the gage line and all that it holds: no tool in a taper is shorter than
/// the thinnest. Default, unsourced.
constexpr double kThinnestFlangeMm = 10.0;

/// Tools are held in a taper's holder; a spindle with a collet of its own has none.
bool has_taper(const model::Machine& m) {
  const std::string& t = m.spindle.taper;
  return !t.empty() && t != "none" && !t.starts_with("ER");
}

void tell_lengths(const std::string& faults, const std::string& acting, Findings& findings) {
  if (faults.empty()) return;
  findings.error(
      6, "CHK-TOOL-OFFSET", {0, "", -1},
      faults + "; " + acting +
          " would take that for a length: measure the tool and enter its length; where offsets "
          "count from a reference tool, say length_offsets: reference under the machine's control");
}

std::set<int> tools_in_use(const ProgramCase& c) {
  std::set<int> out;
  for (const Block& b : c.program.blocks) {
    if (b.kind == Block::Kind::kToolChange && b.tool > 0) out.insert(b.tool);
  }
  return out;
}

/// Lengths that the tools in use cannot have.
void check_lengths(const ProgramCase& c, const ToolTable& table, const std::set<int>& used,
                   Findings& findings) {
  std::vector<model::TableOffset> offsets;
  for (const ToolTableEntry& e : table.entries) offsets.push_back({e.length_mm, e.diameter_mm});
  const auto reading = model::reading_of(offsets, c.machine.control.offsets_against_reference);
  std::string faults, acting;  // of all tools, for findings of the whole program are folded into one
  for (const ToolTableEntry& e : table.entries) {
    if (!used.contains(e.tool) || !e.has_length) continue;
    const model::Cutter* known = c.cutter(e.tool);
    model::Cutter tool = known != nullptr ? *known : model::Cutter{};
    tool.pocket = e.tool;
    // A plan keeps how its table was to be read: what is written of it has not all of the lines.
    model::ToolTableLine line;
    line.against_reference = tool.table_line ? tool.table_line->against_reference : reading.against_reference;
    line.untouched = line.against_reference && reading.zeros > 1 && e.length_mm == 0.0;
    line.words.push_back({"Z", e.length_mm});
    tool.table_line = line;
    std::string fault = model::offset_fault(tool);
    if (fault.empty() && !line.against_reference && has_taper(c.machine) && e.length_mm < kThinnestFlangeMm)
      fault = "T" + std::to_string(e.tool) + " has Z" + plain(e.length_mm) +
              " in the tool table: no length from the gage line, for the flange of a holder alone is " +
              plain(kThinnestFlangeMm) + " mm thick at least";
    if (fault.empty()) continue;
    faults += (faults.empty() ? "" : "; ") + fault;
    acting += (acting.empty() ? "" : ", ") + length_of(c.reader.words, e.tool);
  }
  tell_lengths(faults, acting, findings);
}

}  // namespace

void check_table_lines(const ProgramCase& c, Findings& findings) {
  std::string faults, acting;
  for (const int t : tools_in_use(c)) {
    const model::Cutter* tool = c.cutter(t);
    const std::string fault = tool != nullptr ? model::offset_fault(*tool) : std::string();
    if (fault.empty()) continue;
    faults += (faults.empty() ? "" : "; ") + fault;
    acting += (acting.empty() ? "" : ", ") + length_of(c.reader.words, t);
  }
  tell_lengths(faults, acting, findings);
}

void check_tool_table(const ProgramCase& c, const ToolTable& table, Findings& findings) {
  const Findings::Where whole{0, "", -1};
  for (const std::string& f : table.faults)
    findings.error(6, "CHK-TABLE", whole, "the tool table is not understood: " + f);
  const std::set<int> used = tools_in_use(c);
  for (const int t : used) {
    const auto count =
        std::count_if(table.entries.begin(), table.entries.end(), [&](const auto& e) { return e.tool == t; });
    if (count == 0)
      findings.error(4, "CHK-TABLE-TOOL", whole, "T" + std::to_string(t) + " is not in the tool table");
    if (count > 1)
      findings.error(
          5, "CHK-TABLE-TWICE", whole,
          "T" + std::to_string(t) + " stands " + std::to_string(count) + " times in the tool table");
  }
  check_lengths(c, table, used, findings);
  std::map<int, const ToolTableEntry*> pockets;
  for (const ToolTableEntry& e : table.entries) {
    const std::string name = "T" + std::to_string(e.tool) + " (line " + std::to_string(e.line) + ")";
    const bool loaded = used.contains(e.tool);
    if (e.has_pocket && e.pocket > 0) {
      const auto [other, fresh] = pockets.emplace(e.pocket, &e);
      if (!fresh && other->second->tool != e.tool)
        findings.error(5, "CHK-TABLE-POCKET", whole,
                       name + " and T" + std::to_string(other->second->tool) + " have the pocket P" +
                           std::to_string(e.pocket) + "; " + std::string(c.reader.name) +
                           " keeps one of them");
    }
    if (loaded && !e.has_length)
      findings.error(6, "CHK-TABLE-LENGTH", whole,
                     name + " has no length (Z) in the tool table: its offset is none");
    if (!e.others.empty())
      findings.error(6, "CHK-TABLE-OFFSET", whole,
                     name + " has " + e.others + " in the tool table: " + std::string(c.reader.words.length) +
                         " shifts the work by it");
    const model::Cutter* t = c.cutter(e.tool);
    if (c.plan == nullptr || t == nullptr) continue;
    if (!e.has_diameter)
      findings.error(
          6, "CHK-TABLE-DIAMETER", whole,
          name + " has no diameter (D) in the tool table; the plan's is " + mm(t->cutting_diameter_mm));
    // The carousel's place is the table's to say; where it said none, the number of the tool is taken.
    const int place = static_cast<int>(model::table_word(*t, "P").value_or(t->pocket));
    if (!e.has_pocket || e.pocket != place)
      findings.error(4, "CHK-TABLE-POCKET", whole,
                     name + " has " +
                         (e.has_pocket ? "the pocket P" + std::to_string(e.pocket) : "no pocket") +
                         " in the tool table; the plan has P" + std::to_string(place));
  }
  for (const ToolTableEntry& e : table.entries) {
    const model::Cutter* t = c.cutter(e.tool);
    if (t == nullptr) continue;
    const std::string name = "T" + std::to_string(e.tool);
    const Findings::Where at{0, "", -1};
    const double offset = model::length_offset_mm(*t);
    if (e.has_length && (t->table_line || offset != 0.0) && std::abs(e.length_mm - offset) > 0.01) {
      const double ratio = e.length_mm / offset;
      const bool inch = std::abs(ratio - 25.4) < 0.1 || std::abs(ratio * 25.4 - 1.0) < 0.005;
      findings.error(6, "CHK-TABLE-LENGTH", at,
                     name + " has a length offset of " + plain(e.length_mm) + " in the tool table (line " +
                         std::to_string(e.line) + "); the tool's is " + mm(offset) +
                         (inch ? ": the unit is another one" : ""),
                     std::abs(e.length_mm - offset));
    }
    if (e.has_diameter && std::abs(e.diameter_mm - t->cutting_diameter_mm) > 0.01) {
      findings.error(6, "CHK-TABLE-DIAMETER", at,
                     name + " has a diameter of " + plain(e.diameter_mm) + " in the tool table (line " +
                         std::to_string(e.line) + "); the tool's is " + mm(t->cutting_diameter_mm));
    }
  }
}

}  // namespace capstan::verify
