#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "planner/model/plan/plan.h"

namespace capstan::testing {

/// What findings say, in a fixed order, each number in their messages as #: what is found of a plan's step
/// and holds for its program has the plan's decimals.
inline std::vector<std::string> subjects(const std::vector<model::Finding>& findings) {
  std::vector<std::string> out;
  for (const model::Finding& f : findings) {
    std::string said;
    for (const char c : f.message) {
      const bool number = (c >= '0' && c <= '9') || (c == '.' && !said.empty() && said.back() == '#');
      if (!number) said += c;
      if (number && (said.empty() || said.back() != '#')) said += '#';
    }
    out.push_back(std::string(to_text(f.severity)) + " " + std::to_string(f.property) + " " + f.code +
                  " of " + f.step + ": " + said);
  }
  std::sort(out.begin(), out.end());
  return out;
}

}  // namespace capstan::testing
