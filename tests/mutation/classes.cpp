#include "tests/mutation/classes.h"

#include <algorithm>
#include <set>
#include <string>

namespace capstan::mutation {

std::uint64_t Random::next() {
  state_ ^= state_ >> 12U;
  state_ ^= state_ << 25U;
  state_ ^= state_ >> 27U;
  return state_ * 0x2545f4914f6cdd1dU >> 11U;
}

double Random::between(double lo, double hi) {
  const auto steps = static_cast<std::size_t>((hi - lo) * 100.0);
  return lo + static_cast<double>(below(std::max<std::size_t>(steps, 1))) / 100.0;
}

const std::vector<Class>& classes() {
  static const std::vector<Class> kAll = [] {
    std::vector<Class> all = dangerous_in_any();
    for (const auto& more : {dangerous_by_plan(), not_dangerous(), told_otherwise()})
      all.insert(all.end(), more.begin(), more.end());
    return all;
  }();
  return kAll;
}

std::vector<Class> classes_of(const std::string& dialect) {
  if (dialect == "linuxcnc") return classes();
  if (dialect == "heidenhain") return classes_in_heidenhain();
  // What their programs have not: tool tables, G33.1, a tolerance of G64; what is theirs alone: an F that a
  // mode forgets, small letters.
  static const std::set<std::string> kOthers = {"wider path tolerance", "tap without step", "another pitch",
                                                "feed mode stated anew", "small letters"};
  std::vector<Class> out;
  for (const Class& c : classes()) {
    const std::string name = c.name;
    // Of Grbl's retracts one stands before the first change, where nothing has moved: dangerous_in_grbl.
    if (dialect == "grbl" && name == "retract removed") continue;
    const bool theirs = kOthers.contains(name) && !(dialect == "siemens" && name == "small letters");
    if (c.kind != Kind::kUnknown && !name.starts_with("table: ") && !theirs) out.push_back(c);
  }
  const auto own = dialect == "siemens" ? dangerous_in_siemens()
                   : dialect == "grbl"  ? dangerous_in_grbl()
                   : dialect == "mach3" ? dangerous_in_mach3()
                                        : dangerous_in_fanuc();
  out.insert(out.end(), own.begin(), own.end());
  return out;
}

}  // namespace capstan::mutation
