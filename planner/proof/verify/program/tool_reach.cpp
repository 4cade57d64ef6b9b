#include <algorithm>
#include <map>
#include <optional>

#include "planner/model/plan/cutter/table_offsets.h"
#include "planner/proof/verify/program/program_checks.h"
#include "planner/proof/verify/reader_options.h"

// Lengths against the program itself. A tool is fed down from a height to which a rapid took it, just above
// the work; whatever holds it is above its gage line. A tool that is shorter than the way from there to its
// deepest cut takes the spindle down to where it began to feed. It is a warning, for a program may begin to
// feed high in the air. Where nothing but the program's header tells a length, one that no tool can have is
// found there: read as a tool table is read.

namespace capstan::verify {
namespace {

struct Heights {
  std::optional<double> from, to;  ///< the highest beginning of a feed downwards, the deepest end of a feed
  Findings::Where where;           ///< of the deepest
};

/// By tool and work offset. A rapid begins an approach; a peck of a cycle begins none.
std::map<std::pair<int, int>, Heights> heights_of(const ProgramCase& c) {
  std::map<std::pair<int, int>, Heights> out;
  bool by_rapid = false;
  for (const Block& b : c.program.blocks) {
    if (b.kind != Block::Kind::kMove) continue;
    const bool rapid = b.move == model::MoveKind::kRapid;
    if (!rapid && !b.in_machine && b.tool > 0 && b.length_offset == b.tool && b.known_to[2]) {
      Heights& h = out[{b.tool, b.work_offset}];
      if (by_rapid && b.known_from[2] && b.to.z < b.from.z)
        h.from = std::max(h.from.value_or(b.from.z), b.from.z);
      if (!h.to || b.to.z < *h.to) {
        h.to = b.to.z;
        h.where = c.where(b);
      }
    }
    by_rapid = rapid;
  }
  return out;
}

/// Lengths that the header tells and no tool can have.
void check_header_lengths(const ProgramCase& c, Findings& findings) {
  if (touches_off(c.machine)) return;  // no block takes them
  std::vector<model::TableOffset> offsets;
  for (const HeaderTool& h : c.program.tools)
    offsets.push_back({h.length_mm.value_or(0.0), h.diameter_mm.value_or(0.0)});
  const auto reading = model::reading_of(offsets, c.machine.control.offsets_against_reference);
  for (const HeaderTool& h : c.program.tools) {
    const model::Cutter* known = c.cutter(h.tool);
    if (!h.length_mm || *h.length_mm > 0.0) continue;
    if (known != nullptr && (known->table_line || known->functional_length_mm > 0.0)) continue;
    if (reading.against_reference && (*h.length_mm != 0.0 || reading.zeros < 2)) continue;
    findings.error(6, "CHK-TOOL-OFFSET", {1, "", h.line},
                   "the program's header gives T" + std::to_string(h.tool) + " a length of " +
                       mm(*h.length_mm) + ": it is not measured; " + std::string(c.reader.words.length) +
                       " with T" + std::to_string(h.tool) +
                       " would take that for a length: measure the tool, and check with the tool table");
  }
}

}  // namespace

std::optional<double> length_of_tool(const ProgramCase& c, const ToolTable& table, int tool) {
  const model::Cutter* known = c.cutter(tool);
  if (known != nullptr && known->table_line && known->table_line->against_reference) return std::nullopt;
  std::vector<model::TableOffset> offsets;
  for (const ToolTableEntry& e : table.entries) offsets.push_back({e.length_mm, e.diameter_mm});
  const bool reference =
      model::reading_of(offsets, c.machine.control.offsets_against_reference).against_reference;
  for (const ToolTableEntry& e : table.entries) {
    if (e.tool == tool && e.has_length)
      return reference && (known == nullptr || !known->table_line) ? std::nullopt
                                                                   : std::optional(e.length_mm);
  }
  if (c.has_table) return std::nullopt;
  if (known != nullptr && known->functional_length_mm > 0.0) return model::length_offset_mm(*known);
  for (const HeaderTool& h : c.program.tools) {
    if (h.tool == tool) return h.length_mm;
  }
  return std::nullopt;
}

void check_reach(const ProgramCase& c, const ToolTable& table, Findings& findings) {
  if (!c.has_table && c.plan == nullptr) check_header_lengths(c, findings);
  for (const auto& [at, h] : heights_of(c)) {
    const auto length = length_of_tool(c, table, at.first);
    // One of 0 or less is an error already.
    if (!length || !(*length > 0.0) || !h.from || *h.from - *h.to <= *length) continue;
    findings.warn(6, "CHK-TOOL-REACH", h.where,
                  "T" + std::to_string(at.first) + " is " + mm(*length) +
                      " long from the gage line, and is fed down by " + mm(*h.from - *h.to) + ", from Z" +
                      plain(*h.from) + " to Z" + plain(*h.to) +
                      ": the spindle would come below where the feed begins; measure the tool, or load a "
                      "longer one",
                  *h.from - *h.to);
  }
}

}  // namespace capstan::verify
