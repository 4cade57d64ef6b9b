#include "tooling/library/formats/table_line.h"

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "planner/ground/base/number.h"
#include "planner/model/plan/cutter/table_offsets.h"
#include "tooling/library/cutters/complete.h"
#include "tooling/library/formats/format.h"

namespace capstan::tooling {
namespace {

double offset_of(const MachineEntry& e, char letter) {
  for (const auto& [l, value] : e.offsets) {
    if (l == letter) return value;
  }
  return 0.0;
}

}  // namespace

TableLines::TableLines(const ToolLibrary& library, std::optional<bool> against_reference) : l_(library) {
  std::vector<model::TableOffset> offsets;
  for (const MachineEntry& e : l_.entries) offsets.push_back({offset_of(e, 'Z'), offset_of(e, 'D')});
  const auto reading = model::reading_of(offsets, against_reference);
  against_reference_ = reading.against_reference;
  zeros_ = reading.zeros;
}

void TableLines::give(const MachineEntry& entry, double mm_per_unit, model::Cutter& c, Job& job) {
  if (entry.offsets.empty()) return;
  model::ToolTableLine line;
  line.against_reference = against_reference_;
  line.untouched = against_reference_ && zeros_ > 1 && offset_of(entry, 'Z') == 0.0;
  if (entry.pocket) line.words.push_back({"P", static_cast<double>(*entry.pocket)});
  constexpr std::string_view kLengths = "XYZUVWD";
  for (const auto& [letter, value] : entry.offsets) {
    const bool length = kLengths.find(letter) != std::string_view::npos;
    line.words.push_back({std::string(1, letter), length ? value * mm_per_unit : value});
  }
  const std::string* source = source_of(c, "functional_length_mm");
  if (source != nullptr && source->starts_with("stated")) {
    c.table_line = std::move(line);
    return;
  }
  model::take_table_line(c, line);
  if (const std::string fault = model::offset_fault(c); !fault.empty()) {
    if (++doubted_ > kEntriesShown) return;
    const std::string more = doubted_ == kEntriesShown ? "; more like it are not listed" : "";
    job.report({.code = "TOOL-OFFSET",
                .severity = Severity::kWarning,
                .message = fault + "; the length of " + trimmed(c.functional_length_mm, 4) +
                           " mm that planning uses is assumed" + more,
                .file = l_.source,
                .path = c.id == "T" + std::to_string(c.pocket) ? "" : c.id,  // the text names it so
                .hint =
                    "measure it; where offsets count from a reference tool, say length_offsets: reference "
                    "under the machine's control"});
  } else if (against_reference_ && !told_) {
    told_ = true;
    job.report({.code = "TOOL-OFFSET",
                .severity = Severity::kWarning,
                .message =
                    "the Z of the tool table count from a reference and are no lengths: they are kept as "
                    "they are, lengths and stick-outs are assumed",
                .file = l_.source,
                .hint = "a tool list that states stick_out and functional_length has them checked"});
  }
}

}  // namespace capstan::tooling
