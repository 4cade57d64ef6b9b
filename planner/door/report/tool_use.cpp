#include "planner/door/report/tool_use.h"

#include <algorithm>

namespace capstan::report {

ToolUse use_of(const model::Plan& plan, const model::Cutter& cutter) {
  ToolUse out{.used_before_min = cutter.life_used_min, .life_min = cutter.life_min};
  for (const model::StepResult& s : plan.steps) {
    if (s.cutter_id != cutter.id) continue;
    if (s.loads.tool_life_min > 0.0)
      out.life_min =
          out.life_min > 0.0 ? std::min(out.life_min, s.loads.tool_life_min) : s.loads.tool_life_min;
    if (s.path == nullptr || s.path->size() == 0) continue;
    const double z = model::bounds(*s.path).lo.z;
    out.least_z_mm = out.least_z_mm ? std::min(*out.least_z_mm, z) : z;
    out.used_min += s.cutting_s / 60.0;
  }
  return out;
}

std::string_view coolant_text(const model::StepResult& s) {
  return s.through ? "through" : s.flood ? "flood" : s.mist ? "mist" : "dry";
}

}  // namespace capstan::report
