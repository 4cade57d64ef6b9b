#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "planner/model/plan/plan.h"

namespace capstan::testing {

/// What findings are of, in a fixed order, without the numbers in their messages: what is found of a plan's step
/// and holds for its program has the plan's decimals.
inline std::vector<std::string> subjects(const std::vector<model::Finding>& findings) {
  std::vector<std::string> out;
  for (const model::Finding& f : findings)
    out.push_back(std::string(to_text(f.severity)) + " " + f.code + " of " + f.step);
  std::sort(out.begin(), out.end());
  return out;
}

}  // namespace capstan::testing
