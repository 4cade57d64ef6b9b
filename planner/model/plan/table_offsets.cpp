#include "planner/model/plan/table_offsets.h"

namespace capstan::model {

TableReading reading_of(const std::vector<TableOffset>& table, std::optional<bool> stated) {
  TableReading out;
  bool negative = false, positive = false;
  for (const TableOffset& t : table) {
    negative = negative || t.z < 0.0;
    positive = positive || t.z > 0.0;
    if (t.z == 0.0 && t.diameter > 0.0) ++out.zeros;
  }
  out.against_reference = stated.value_or(negative && (out.zeros > 0 || !positive));
  return out;
}

int magazine_pocket(const Cutter& c) {
  if (!c.table_line) return c.pocket;
  for (const ToolTableWord& w : c.table_line->words) {
    if (w.letter == "P" && w.value >= 0.0 && w.value < 1e6) return static_cast<int>(w.value);
  }
  return c.pocket;
}

}  // namespace capstan::model
