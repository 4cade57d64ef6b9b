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
  constexpr double kMost = 1e6;
  const auto p = table_word(c, "P");
  return p && *p >= 0.0 && *p < kMost ? static_cast<int>(*p) : c.pocket;
}

}  // namespace capstan::model
