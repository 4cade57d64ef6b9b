#include <algorithm>
#include <cmath>
#include <set>

#include "planner/proof/verify/program/program_checks.h"

// The tools that a program names in its own header, against the tool table, the library and the machine.

namespace capstan::verify {
namespace {

/// Two statements of one size; also the rounding of a program in inches. Default, unsourced.
constexpr double kSameMm = 0.01;

bool differ(double a, double b) { return std::abs(a - b) > kSameMm; }

struct Size {
  int tool;
  const char* code;
  const char* what;  ///< "a length"
  std::optional<double> said;
  std::optional<double> table, library;
};

void check_size(const Size& s, const HeaderTool& h, Findings& findings) {
  if (!s.said) return;
  // What the table has against the library's tool is said where those two are compared.
  const bool told = s.table && s.library && differ(*s.table, *s.library);
  const bool by_table = s.table && differ(*s.said, *s.table) && !told;
  const bool by_library = s.library && differ(*s.said, *s.library);
  if (!by_table && !by_library) return;
  const double other = by_table ? *s.table : *s.library;
  findings.error(6, s.code, {1, "", h.line},
                 "the program is written for T" + std::to_string(s.tool) + " with " + s.what + " of " +
                     mm(*s.said) + "; the " + (by_table ? "tool table" : "tool library") + " has " +
                     mm(other),
                 std::abs(*s.said - other));
}

}  // namespace

void check_header_tools(const ProgramCase& c, const ToolTable& table, Findings& findings) {
  for (const HeaderTool& h : c.program.tools) {
    Size length{h.tool, "CHK-HEADER-LENGTH", "a length", h.length_mm, {}, {}};
    Size diameter{h.tool, "CHK-HEADER-DIAMETER", "a diameter", h.diameter_mm, {}, {}};
    for (const ToolTableEntry& e : table.entries) {
      if (e.tool != h.tool) continue;
      if (e.has_length) length.table = e.length_mm;
      if (e.has_diameter) diameter.table = e.diameter_mm;
      break;
    }
    if (const model::Cutter* t = c.cutter(h.tool); t != nullptr) {
      if (const double z = model::length_offset_mm(*t); t->table_line || z != 0.0) length.library = z;
      if (t->cutting_diameter_mm > 0.0) diameter.library = t->cutting_diameter_mm;
    }
    check_size(length, h, findings);
    check_size(diameter, h, findings);
  }
}

std::vector<model::Cutter> tools_of_header(const Program& program) {
  std::vector<model::Cutter> out;
  for (const HeaderTool& h : program.tools) {
    model::Cutter c;
    c.id = h.id;
    c.pocket = h.tool;
    c.cutter_class = model::cutter_class_from_text(h.kind).value_or(c.cutter_class);
    c.functional_length_mm = h.length_mm.value_or(0.0);
    c.cutting_diameter_mm = h.diameter_mm.value_or(0.0);
    out.push_back(std::move(c));
  }
  return out;
}

void check_abilities(const ProgramCase& c, Findings& findings) {
  const model::Machine& m = c.machine;
  std::set<int> seen;
  for (const Block& b : c.program.blocks) {
    if (b.synchronised && !m.abilities.rigid_tapping)
      findings.error(22, "CHK-MACHINE-TAPPING", c.where(b),
                     "the spindle and the feed must run in step here; the machine '" + m.id +
                         "' does not synchronise them");
    if (b.kind != Block::Kind::kToolChange || b.tool <= 0 || !seen.insert(b.tool).second) continue;
    double length = 0.0, diameter = 0.0;
    if (const model::Cutter* t = c.cutter(b.tool); t != nullptr) {
      length = t->functional_length_mm;
      diameter = t->cutting_diameter_mm;
    }
    for (const HeaderTool& h : c.program.tools) {
      if (h.tool != b.tool) continue;
      length = std::max(length, h.length_mm.value_or(0.0));
      diameter = std::max(diameter, h.diameter_mm.value_or(0.0));
    }
    check_tool_size({"T" + std::to_string(b.tool), length, diameter}, m, c.where(b), findings);
  }
}

}  // namespace capstan::verify
