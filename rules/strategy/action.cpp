#include "rules/strategy/action.h"

#include <algorithm>
#include <numbers>
#include <stdexcept>

#include "planner/ground/base/number.h"

namespace capstan::rules {

const Action* find_action(std::string_view name) {
  static const std::vector<Action> kActions = [] {
    std::vector<Action> all = hole_actions();
    for (auto&& family : {cone_actions(), area_actions(), form_actions(), section_actions(),
                          undercut_actions(), back_actions()})
      all.insert(all.end(), family.begin(), family.end());
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

std::string words_of(const model::ToolRequirement& t) {
  const auto mm = [](double v) { return trimmed(v, 3) + " mm"; };
  std::string out = "a ";
  if (t.diameter_exact_mm > 0.0) {
    out += mm(t.diameter_exact_mm) + " ";
  } else if (t.diameter_max_mm > 0.0 && t.diameter_min_mm > 0.0) {
    out += trimmed(t.diameter_min_mm, 3) + " to " + mm(t.diameter_max_mm) + " ";
  } else if (t.diameter_max_mm > 0.0) {
    out += "(at most " + mm(t.diameter_max_mm) + ") ";
  } else if (t.diameter_min_mm > 0.0) {
    out += "(at least " + mm(t.diameter_min_mm) + ") ";
  }
  for (std::size_t i = 0; i < t.classes.size(); ++i) {
    std::string name(model::to_text(t.classes[i]));
    std::replace(name.begin(), name.end(), '_', ' ');
    out += (i == 0 ? "" : " or ") + name;
  }
  if (t.point_angle_rad > 0.0)
    out += " of " + trimmed(t.point_angle_rad * 180.0 / std::numbers::pi, 1) + " degrees";
  if (t.corner_radius_exact_mm >= 0.0) out += ", corner radius " + mm(t.corner_radius_exact_mm);
  if (t.thread_pitch_mm > 0.0) out += ", pitch " + mm(t.thread_pitch_mm);
  if (t.reach_mm > 0.0) out += " with " + mm(t.reach_mm) + " reach";
  return out;
}

}  // namespace capstan::rules
