#include "planner/door/service/state/axis_limits.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "planner/controls/controls.h"
#include "planner/proof/verify/axis_places.h"

namespace capstan::service {
namespace {

Diagnostic fault(const model::Plan& plan, std::string message) {
  return {.code = "LATE-PLACE",
          .message = std::move(message),
          .file = plan.file_name,
          .hint = "retract and stop; nothing may be cut from this plan as the machine stands"};
}

}  // namespace

bool is_of_other_control(const Format& format, const model::Plan& plan) {
  return format.control != controls::find_dialect(plan.machine.control.dialect);
}

Diagnostic not_held(const Format& format, const model::Plan& plan) {
  return fault(plan, "a program as '" + std::string(format.name) +
                         "' is not that of the machine's own control, which alone is held against the limits "
                         "of the axes");
}

std::optional<Diagnostic> leaves_limits(const MachineState& state, const model::Plan& plan,
                                        const std::string& program, const std::string& table) {
  if (state.axis_limits.empty()) return std::nullopt;
  verify::AxisPlaces places;
  for (const AxisLimit& l : state.axis_limits) {
    const auto& axes = plan.machine.axes;
    const auto axis = std::find_if(axes.begin(), axes.end(), [&](const auto& a) { return a.name == l.axis; });
    if (axis == axes.end())
      return fault(plan, "machine '" + plan.machine.id + "' has no axis '" + l.axis + "'; it has " +
                             axes[0].name + ", " + axes[1].name + " and " + axes[2].name);
    places.ranges.push_back({static_cast<std::size_t>(axis - axes.begin()), l.least_mm, l.most_mm});
  }
  for (const WorkOffset& o : state.work_offsets) places.offsets.push_back({o.name, o.at_mm});
  if (program.empty() && !plan.steps.empty())
    return fault(plan, "there is no program whose places could be held against the limits of the axes");
  const auto found =
      verify::check_axis_places({"program", program, table}, &plan, plan.machine, plan.cutters, places);
  if (found.empty()) return std::nullopt;
  const model::Finding& first = found.front();
  Diagnostic out = fault(plan, (first.step.empty() ? "" : "step '" + first.step + "': ") + first.message);
  out.path = first.step;
  return out;
}

}  // namespace capstan::service
