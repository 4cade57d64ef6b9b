#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "planner/proof/verify/verify.h"
#include "tests/proof/verify/plans.h"

/// What the check says of a plan.
namespace capstan::verify::testing {

inline std::string told(const std::vector<model::Finding>& findings) {
  std::string out;
  for (const auto& f : findings)
    out += std::to_string(f.property) + " " + f.code + " [" + f.step + " " + std::to_string(f.move) + "] " +
           f.message + "\n";
  return out;
}

inline std::vector<model::Finding> check(const model::Plan& plan) {
  Job job;
  return check_plan(plan, job);
}

inline const model::Finding* found(const std::vector<model::Finding>& all, const std::string& code,
                                   const std::string& step) {
  const auto it = std::find_if(all.begin(), all.end(), [&](const auto& f) {
    return f.code == code && f.step == step && f.severity == Severity::kError;
  });
  return it == all.end() ? nullptr : &*it;
}

/// A rapid to above a place, and from there down to z as a drill.
inline model::CutterPath down_to(double x, double y, double z) {
  model::CutterPath p;
  p.start({x, y, 10});
  p.rapid({x, y, 2});
  p.line({x, y, z}, MoveRole::kDrill);
  p.rapid({x, y, 10}, MoveRole::kRetract);
  return p;
}

/// Of the findings those with this code.
inline std::vector<model::Finding> of(const PlanMaker& k, const std::string& code) {
  Job job;
  auto all = check_plan(k.plan, job);
  std::erase_if(all, [&](const model::Finding& f) { return f.code != code; });
  return all;
}

}  // namespace capstan::verify::testing
