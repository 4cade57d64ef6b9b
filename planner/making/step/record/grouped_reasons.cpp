#include "planner/making/step/record/grouped_reasons.h"

namespace capstan::step {

void GroupedReasons::add(const std::string& cutter, const std::string& why) {
  for (Group& g : groups_) {
    if (g.why != why) continue;
    ++g.more;
    return;
  }
  groups_.push_back({cutter, why});
}

std::string GroupedReasons::text() const {
  std::string out;
  for (const Group& g : groups_) {
    out += (out.empty() ? "" : "; ") + g.first + ": " + g.why;
    if (g.more > 0)
      out += ", the same for " + std::to_string(g.more) + " more " + (g.more == 1 ? "cutter" : "cutters");
  }
  return out;
}

}  // namespace capstan::step
