#include "planner/files/json/summary.h"

#include <algorithm>
#include <cmath>

#include "planner/physics/motion/time.h"

namespace capstan::json {

std::vector<std::pair<std::string, double>> summary_of(const model::Plan& plan) {
  double cutting = 0.0;
  double rapid = 0.0;
  for (const auto& s : plan.steps) {
    cutting += s.cutting_s;
    rapid += s.rapid_s;
  }
  std::vector<std::pair<std::string, double>> out = {
      {"steps", static_cast<double>(plan.steps.size())}, {"cutting_s", cutting}, {"rapid_s", rapid}};
  // Times between the steps, from their paths; unknown without paths.
  if (const auto t = motion::time_of(plan); t && t->total_s() > 0.0 && std::isfinite(t->total_s())) {
    out.insert(out.end(), {{"link_s", t->link_s},
                           {"tool_changes", static_cast<double>(t->tool_changes)},
                           {"tool_change_s", t->tool_change_s},
                           {"spindle_s", t->spin_up_s},
                           {"total_s", t->total_s()}});
  }
  return out;
}

bool has_magazine(const model::Plan& plan) {
  return std::any_of(plan.cutters.begin(), plan.cutters.end(),
                     [](const model::Cutter& c) { return c.loaded; });
}

std::vector<std::string> to_load(const model::Plan& plan) {
  std::vector<std::string> out;
  if (!has_magazine(plan)) return out;
  for (const model::Cutter& c : plan.cutters) {
    if (!c.loaded) out.push_back(c.id);
  }
  return out;
}

}  // namespace capstan::json
