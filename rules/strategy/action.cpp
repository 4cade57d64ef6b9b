#include "rules/strategy/action.h"

#include <algorithm>
#include <numbers>
#include <stdexcept>

#include "planner/ground/base/number.h"

namespace capstan::rules {

const Action* find_action(std::string_view name) {
  static const std::vector<Action> kActions = [] {
    std::vector<Action> all;
    for (const std::vector<Action>& family : families()) all.insert(all.end(), family.begin(), family.end());
    return all;
  }();
  const auto it =
      std::find_if(kActions.begin(), kActions.end(), [&](const Action& a) { return a.name == name; });
  return it == kActions.end() ? nullptr : &*it;
}

double Making::number(std::string_view parameter) const {
  if (const auto given = find(spec.parameters, parameter)) return *given;
  for (const ActionParameter& p : find_action(spec.action)->parameters) {
    if (p.name == parameter) return p.standard;
  }
  throw std::logic_error(spec.action + " has no parameter " + std::string(parameter));
}

}  // namespace capstan::rules
